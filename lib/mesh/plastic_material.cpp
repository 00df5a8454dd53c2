#include "mesh/plastic_material.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/lane_math.hpp"
#include "mesh/material_constants.hpp"

namespace yadefrag {
namespace {

Hardening fromTable(const std::vector<HardeningPoint>& table, double strain) {
  std::size_t i = 1;
  while (i < table.size() && table[i].strain <= strain) ++i;
  if (i == table.size()) return {table.back().stress, 0};
  const HardeningPoint &a = table[i - 1], &b = table[i];
  const double slope = (b.stress - a.stress) / (b.strain - a.strain);
  return {a.stress + slope * (strain - a.strain), slope};
}

std::string wrongTable(const std::vector<HardeningPoint>& table) {
  for (std::size_t i = 0; i < table.size(); ++i) {
    const auto [strain, stress] = table[i];
    if (!(stress > 0 && std::isfinite(stress) && std::isfinite(strain)))
      return fmt::format(
          "hardeningTable has the point ({:g}, {:g}); stresses must be positive (Pa).", strain,
          stress);
    if (i == 0 ? strain != 0 : !(strain > table[i - 1].strain))
      return fmt::format(
          "hardeningTable has the plastic strain {:g} at point {}; strains must begin with 0 and "
          "increase.",
          strain, i);
    if (i > 0 && stress < table[i - 1].stress)
      return fmt::format(
          "hardeningTable has the stress {:g} Pa after {:g} Pa; stresses must not decrease.",
          stress, table[i - 1].stress);
  }
  return {};
}

std::string wrongCone(const PlasticMaterial& m) {
  using M = PlasticMaterial;
  const Constants<M> all = coneConstants();
  if (std::string sentence = all.wrong(m); !sentence.empty()) return sentence;
  if (m.dilation > m.internalFriction)
    return wrongValue("dilationAngle", std::atan(m.dilation), "",
                      "at least 0 and at most internalFriction");
  if (m.failure.energy > 0 && m.cohesion == 0)
    return all.wrong(m, &M::cohesion, "positive if fractureEnergy is given");
  if (m.failure.energy > 0 && !(m.failure.spallStress > 0))
    return all.wrong(m, &M::tensionLimit, "positive if fractureEnergy is given");
  if (m.failure.energy > 0 && !m.failure.isOn())
    return failureConstants().wrong(
        m.failure, &FailureLaw::energy,
        "0 unless failureStrain, tensionLimit or internalFriction is given");
  return m.failure.wrong(false);
}

std::string wrongMetal(const PlasticMaterial& m) {
  using M = PlasticMaterial;
  const Constants<M> all = metalConstants();
  if (std::string sentence = wrongTable(m.table); !sentence.empty()) return sentence;
  if (m.table.empty() && !(m.yieldStress > 0))
    return all.wrong(m, &M::yieldStress, "positive and finite");
  if (std::string sentence = all.wrong(m); !sentence.empty()) return sentence;
  if (m.offsetStrain > 0 && m.hardening > 0)
    return all.wrong(m, &M::hardening, "0 if there is an offsetStrain");
  const bool melts = m.meltTemperature > m.startTemperature && std::isfinite(m.meltTemperature);
  if (m.thermalExponent > 0 && !melts)
    return all.wrong(m, &M::meltTemperature, "above startTemperature, and finite");
  return m.failure.wrong(melts);
}

}  // namespace

Hardening staticStress(const PlasticMaterial& m, double strain) {
  if (!m.table.empty()) return fromTable(m.table, strain);
  if (m.offsetStrain > 0) {
    const double grown = 1 + strain / m.offsetStrain;
    const double stress = m.yieldStress * powerOf(grown, m.hardeningExponent);
    return {stress, stress * m.hardeningExponent / (m.offsetStrain + strain)};
  }
  if (m.hardening == 0) return {m.yieldStress, 0};
  if (m.isStraight()) return {m.yieldStress + m.hardening * strain, m.hardening};
  if (strain <= 0)
    return {m.yieldStress,
            m.hardeningExponent < 1 ? std::numeric_limits<double>::infinity() : m.hardening};
  const double part = m.hardening * powerOf(strain, m.hardeningExponent);
  return {m.yieldStress + part, part * m.hardeningExponent / strain};
}

double relativeHeat(const PlasticMaterial& m, double temperature) {
  if (!(m.meltTemperature > m.startTemperature)) return 0;
  const double relative =
      (temperature - m.startTemperature) / (m.meltTemperature - m.startTemperature);
  return std::clamp(relative, 0., 1.);
}

double thermalFactor(const PlasticMaterial& m, double temperature) {
  if (m.thermalExponent <= 0) return 1;
  const double relative = relativeHeat(m, temperature);
  return relative < 1 ? 1 - powerOf(relative, m.thermalExponent) : 0;
}

std::string PlasticMaterial::wrong() const {
  return cohesion != 0 || internalFriction != 0 ? wrongCone(*this) : wrongMetal(*this);
}

}  // namespace yadefrag
