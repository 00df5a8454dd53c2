#include "elements/plastic_return.hpp"

#include <cmath>
#include <limits>
#include <numbers>

#include "elements/plastic_lanes.hpp"

namespace yadefrag {

YieldConstants::YieldConstants(const BodyMaterial& m)
    : plastic(m.plastic),
      moduli(m.material),
      cone(m.plastic),
      heating(m.plastic.isHeated()
                  ? m.plastic.heatShare / (m.material.density * m.plastic.heatCapacity)
                  : 0),
      planeStress(m.material.planeStress),
      kind(plastic.isStraight() ? Kind::kLine : Kind::kCurved),
      base(plastic.yieldStress),
      factor(plastic.hardening),
      exponent(plastic.hardeningExponent),
      bending(exponent - 1),
      accuracy(tolerance::kLaneReturned),
      startTemperature(std::numeric_limits<double>::infinity()) {
  if (plastic.isFrictional()) kind = Kind::kCone;
  if (!plastic.table.empty()) exponent = bending = 0, accuracy = 0;
  if (planeStress || !plastic.table.empty()) kind = Kind::kAny;
  if (plastic.offsetStrain > 0)
    base = 0, factor = plastic.yieldStress, begin = 1, unit = shift = plastic.offsetStrain;
  if (plastic.thermalExponent > 0) {
    thermalExponent = plastic.thermalExponent, startTemperature = plastic.startTemperature;
    range = plastic.meltTemperature - plastic.startTemperature;
  }
}

double yieldStress(const PlasticMaterial& m, double strain, double temperature) {
  if (m.isFrictional()) return std::numbers::sqrt3 * Cone(m).strength;
  return staticStress(m, strain).stress * thermalFactor(m, temperature);
}

double freeThickness(const Matrix2& f, double guess, double kept, const SolidModuli& moduli) {
  double thickness = guess;
  for (int i = 0; i < tolerance::kThicknesses; ++i) {
    const StressAcross across(ElasticTrial(f, thickness), kept, moduli);
    thickness *= expOfSmall(-across.step);
    if (std::abs(across.stress) <= tolerance::kNoStress * moduli.bulk) break;
  }
  return thickness;
}

ElasticTrial trialOf(const YieldConstants& c, const YieldPoint& point, const TriangleEdges& now,
                     double& thickness) {
  thickness = point.thickness * now.hoop;
  const Matrix2 f = now.gradient(point.edges);
  return c.planeStress ? trialAt<true, true>(f, c.moduli, thickness)
                       : trialAt<true, false>(f, c.moduli, thickness);
}

namespace {

Corners<1> cornersOf(const TriangleEdges& edges) {
  return {{{0}, {edges.first.x}, {edges.second.x}}, {{0}, {edges.first.y}, {edges.second.y}}};
}

template <YieldConstants::Kind kKind, bool kPlane, bool kNodal>
Returned returnOne(const YieldConstants& c, const YieldPoint& point, const TriangleMotion& motion,
                   double dt, const NodalPressure& pressure) {
  const Corners<1> now = cornersOf(motion.now), before = cornersOf(motion.before);
  const ReturnInput<1> in{c, dt, now, before};
  FlowLanes<1> w{};
  w.groups.add(0);
  for (std::size_t i = 0; i < 4; ++i) w.edges[i][0] = point.edges[i];
  w.thickness[0] = point.thickness * motion.now.hoop;
  w.formerThickness[0] = point.thickness * motion.before.hoop;
  w.strain[0] = point.strain, w.temperature[0] = point.temperature;
  w.yield[0] = yieldStress(c.plastic, point.strain, point.temperature);
  w.thermal[0] = thermalFactor(c.plastic, point.temperature);
  w.size[0] = motion.size;
  w.pressure[0] = pressure.now, w.formerPressure[0] = pressure.before;
  w.opening[0] = pressure.opening;
  tryLanes<kPlane, kNodal, kKind == YieldConstants::Kind::kCone>(in, w);
  const double trialMean = w.mean[0];
  if (w.over[0] > 0) returnLanes<kKind, kPlane, kNodal>(in, w);
  YieldPoint after = w.point(0);
  after.thickness = w.over[0] > 0 ? after.thickness / motion.now.hoop : point.thickness;
  return {after, w.trial[0], w.mean[0], trialMean, w.kept[0], w.opening[0], w.work[0]};
}

}  // namespace

Returned returnToYield(const YieldConstants& c, const YieldPoint& point,
                       const TriangleMotion& motion, double dt, const NodalPressure* pressure) {
  using enum YieldConstants::Kind;
  const NodalPressure own = pressure != nullptr ? *pressure : NodalPressure{0, 0};
  const auto run = [&](auto one) { return one(c, point, motion, dt, own); };
  if (c.planeStress) return run(returnOne<kAny, true, false>);
  if (c.kind == kCone)
    return run(pressure != nullptr ? returnOne<kCone, false, true>
                                   : returnOne<kCone, false, false>);
  return run(pressure != nullptr ? returnOne<kAny, false, true> : returnOne<kAny, false, false>);
}

double nodalOpening(const YieldConstants& c, const ElasticTrial& trial, double size,
                    double pressure) {
  const auto [bulk, shear] = c.moduli;
  const ConeTrial at{shear * std::sqrt(trial.squaredMises() / 3), pressure * trial.volume,
                     nodalStiffness(pressure, trial.volume, bulk), size};
  return coneFlow<false>(c.cone, shear, at).opening;
}

double Returned::volume() const { return trial.volume * expOfSmall(-opening); }

double deviatorEnergy(const ElasticTrial& trial, double kept, double shear) {
  return shear * kept * kept * product(trial, trial);
}

double volumeEnergy(double volume, double bulk) {
  return bulk / 2 * ((volume * volume - 1) / 2 - logOf(volume));
}

}  // namespace yadefrag
