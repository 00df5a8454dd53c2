#include "mesh/plastic_material.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/lanes.hpp"
#include "core/tolerances/dynamics.hpp"
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

namespace {

/// Of a power that is a finite number, far above any strain.
constexpr double kMostExponent = 500;

double ofTriaxiality(const FailureLaw& law, double triaxiality) {
  const double most = std::min(triaxiality, tolerance::kMostTriaxiality);
  return law.d1 + law.d2 * expOf(std::min(law.d3 * most, kMostExponent));
}

/// Of the formula, whose failure strain must be positive at any state.
std::string wrongFormula(const FailureLaw& law, bool heats) {
  using M = FailureLaw;
  const auto refuse = [&](double M::*member, const char* right) {
    return failureConstants().wrong(law, member, right);
  };
  if (!(law.d2 >= 0)) return refuse(&M::d2, "0 or positive");
  if (!(law.d3 <= 0))
    return refuse(&M::d3, "0 or negative, since tension reduces the failure strain");
  const double least = ofTriaxiality(law, tolerance::kMostTriaxiality);
  if (!(least > 0) && !(law.strain < FailureLaw::kNone))
    return fmt::format(
        "failureD1, failureD2 and failureD3 give the failure strain {:g} where the mean stress is "
        "1.5 times von Mises' stress; it must be positive there, or failureStrain given as the "
        "least one.",
        least);
  if (!(1 + law.d4 * std::log(tolerance::kMostRate) > 0))
    return refuse(&M::d4, "at least -0.04, for a positive failure strain at any rate");
  if (!(law.d5 > -1))
    return refuse(&M::d5, "above -1, for a positive failure strain up to melting");
  if (law.d5 != 0 && !heats) return refuse(&M::d5, "0, or meltTemperature above startTemperature");
  return {};
}

}  // namespace

std::string FailureLaw::wrong(bool heats) const {
  using M = FailureLaw;
  const Constants<M> all = failureConstants();
  if (std::string sentence = all.wrong(*this); !sentence.empty()) return sentence;
  if (energy > 0 && !isOn())
    return all.wrong(*this, &M::energy,
                     "0 unless failureStrain, failureD1, failureD2 or spallStress is given");
  if (energy == 0 && spallStress < kNone)
    return all.wrong(*this, &M::energy,
                     "positive if spallStress is given, as a spall must take energy");
  if (hasFormula()) return wrongFormula(*this, heats);
  for (double M::*const d : {&M::d3, &M::d4, &M::d5})
    if (this->*d != 0) return all.wrong(*this, d, "0 unless failureD1 or failureD2 is given");
  return {};
}

double failureStrain(const FailureLaw& law, const FlowState& at) {
  if (!law.hasFormula()) return law.strain;
  double strain = ofTriaxiality(law, at.triaxiality);
  if (at.relativeRate > 1) strain *= 1 + law.d4 * logOf(at.relativeRate);
  strain *= 1 + law.d5 * at.heat;
  const double least = law.strain < FailureLaw::kNone ? law.strain : 0;
  return std::max({strain, least, tolerance::kLeastFailureStrain});
}

}  // namespace yadefrag
