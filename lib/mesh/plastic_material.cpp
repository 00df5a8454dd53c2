#include "mesh/plastic_material.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/lane_math.hpp"
#include "core/wrong_value.hpp"

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
  const auto isPositive = [](double v) { return v > 0 && std::isfinite(v); };
  const auto isNotNegative = [](double v) { return v >= 0 && std::isfinite(v); };
  if (cohesion != 0 || internalFriction != 0) {
    if (!isNotNegative(cohesion))
      return wrongValue("cohesion", cohesion, " Pa", "0 or positive, and finite");
    if (!isNotNegative(internalFriction))
      return wrongValue("internalFriction", std::atan(internalFriction), "",
                        "at least 0 and below π/2 (rad)");
    if (!(dilation >= 0 && dilation <= internalFriction))
      return wrongValue("dilationAngle", std::atan(dilation), "",
                        "at least 0 and at most internalFriction");
    if (!(tensionLimit >= 0))
      return wrongValue("tensionLimit", tensionLimit, " Pa", "0 or positive");
    if (failure.energy > 0 && cohesion == 0)
      return wrongValue("cohesion", cohesion, " Pa", "positive if fractureEnergy is given");
    if (failure.energy > 0 && !(failure.spallStress > 0))
      return wrongValue("tensionLimit", tensionLimit, " Pa", "positive if fractureEnergy is given");
    if (failure.energy > 0 && !failure.isOn())
      return wrongValue("fractureEnergy", failure.energy, " J/m²",
                        "0 unless failureStrain, tensionLimit or internalFriction is given");
    return failure.wrong(false);
  }
  if (std::string sentence = wrongTable(table); !sentence.empty()) return sentence;
  if (!(table.empty() ? isPositive(yieldStress) : isNotNegative(yieldStress)))
    return wrongValue("yieldStress", yieldStress, " Pa", "positive and finite");
  if (!isNotNegative(hardening))
    return wrongValue("hardening", hardening, " Pa", "0 or positive, and finite");
  if (!(hardeningExponent > 0 && hardeningExponent <= 1))
    return wrongValue("hardeningExponent", hardeningExponent, "", "above 0 and at most 1");
  if (!isNotNegative(offsetStrain))
    return wrongValue("offsetStrain", offsetStrain, "", "0 or positive, and finite");
  if (offsetStrain > 0 && hardening > 0)
    return wrongValue("hardening", hardening, " Pa", "0 if there is an offsetStrain");
  if (!isNotNegative(rateFactor))
    return wrongValue("rateFactor", rateFactor, "", "0 or positive, and finite");
  if (!isPositive(referenceRate))
    return wrongValue("referenceRate", referenceRate, " 1/s", "positive and finite");
  if (!isNotNegative(thermalExponent))
    return wrongValue("thermalExponent", thermalExponent, "", "0 or positive, and finite");
  if (!isNotNegative(startTemperature))
    return wrongValue("startTemperature", startTemperature, " K", "0 or positive, and finite");
  if (thermalExponent > 0 &&
      !(meltTemperature > startTemperature && std::isfinite(meltTemperature)))
    return wrongValue("meltTemperature", meltTemperature, " K",
                      "above startTemperature, and finite");
  if (!isNotNegative(heatCapacity))
    return wrongValue("heatCapacity", heatCapacity, " J/(kg K)", "0 or positive, and finite");
  if (!(heatShare >= 0 && heatShare <= 1))
    return wrongValue("heatShare", heatShare, "", "from 0 to 1");
  return failure.wrong(meltTemperature > startTemperature && std::isfinite(meltTemperature));
}

}  // namespace yadefrag
