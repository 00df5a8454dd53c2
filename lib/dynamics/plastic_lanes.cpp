#include "dynamics/plastic_lanes.hpp"

#include <limits>

namespace yadefrag {

YieldCurve::YieldCurve(const PlasticMaterial& m, double shear, double heatingByWork, double dt) {
  if (m.isFrictional()) kind = Kind::kCone;
  if (m.isFrictional() || !m.table.empty()) return;
  stiffness = 3 * shear;
  leastStep = .02 / stiffness;
  base = m.yieldStress, factor = m.hardening, exponent = m.hardeningExponent;
  heating = heatingByWork;
  if (m.isStraight()) {
    kind = Kind::kLine;
    return;
  }
  kind = Kind::kCurved;
  if (m.offsetStrain > 0)
    base = 0, factor = m.yieldStress, begin = 1, unit = shift = m.offsetStrain;
  if (dt > 0) rateFactor = m.rateFactor, perRate = 1 / (m.referenceRate * dt);
  startTemperature = std::numeric_limits<double>::infinity();
  if (m.thermalExponent > 0) {
    thermalExponent = m.thermalExponent, startTemperature = m.startTemperature;
    range = m.meltTemperature - m.startTemperature;
  }
  binomial[0] = 1;
  for (std::size_t i = 1; i < binomial.size(); ++i)
    binomial[i] =
        binomial[i - 1] * (exponent - static_cast<double>(i - 1)) / static_cast<double>(i);
}

}  // namespace yadefrag
