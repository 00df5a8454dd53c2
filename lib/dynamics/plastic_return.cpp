#include "dynamics/plastic_return.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/lane_math.hpp"
#include "core/tolerances/plasticity.hpp"

namespace yadefrag {
namespace {

/// (Pa) Y(p + Δp, Δp/Δt, T) and its derivative with respect to Δp.
Hardening flowStress(const PlasticMaterial& m, double strain, double step, double dt,
                     double thermal) {
  const Hardening slow = staticStress(m, strain + step);
  double factor = 1, slope = 0;
  if (m.rateFactor > 0 && dt > 0 && step > m.referenceRate * dt) {
    factor += m.rateFactor * logOf(step / (m.referenceRate * dt));
    slope = m.rateFactor / step;
  }
  return {slow.stress * factor * thermal, (slow.slope * factor + slow.stress * slope) * thermal};
}

/// Fₑ exp(−Δεₚ), where Δεₚ is 1 − `kept` of the trial's deviator, and a volume strain.
void flow(const ElasticTrial& t, double kept, double volumeStrain, YieldPoint& point,
          double& thickness) {
  const double gone = 1 - kept;
  const double across = gone * t.across / 3;
  const double size = gone * std::sqrt(t.squared) / 2;
  // exp of a symmetric matrix: x → e^h (cosh x − sinh/|ℓ| ℓ x̄), ℓ = gone · part · u
  const double squared = size * size;
  double cosh = 1 + squared / 2 * (1 + squared / 12 * (1 + squared / 30));
  double sinhFactor = 1 + squared / 6 * (1 + squared / 20 * (1 + squared / 42));
  if (size > tolerance::kTinyFlow) {
    const double up = expOf(size), down = 1 / up;
    cosh = (up + down) / 2, sinhFactor = (up - down) / (2 * size);
  }
  const double grown = expOfSmall(across / 2 - volumeStrain / 3);
  const double diagonal = grown * cosh;
  const double by = grown * sinhFactor * gone * t.part / 2 * t.inverseZ;
  const double real = by * (t.wx * t.zx + t.wy * t.zy),
               imaginary = by * (t.wy * t.zx - t.wx * t.zy);
  const double xx = diagonal - real, yy = diagonal + real, xy = -imaginary;
  const auto e = point.edges;
  point.edges = {e[0] * xx + e[1] * xy, e[0] * xy + e[1] * yy,  //
                 e[2] * xx + e[3] * xy, e[2] * xy + e[3] * yy};
  thickness *= expOfSmall(-across - volumeStrain / 3);
}

/// e:e' of two deviators in the same frame.
double product(const ElasticTrial& a, const ElasticTrial& b) {
  // u = w z̄/|z|²
  const double ax = a.wx * a.zx + a.wy * a.zy, ay = a.wy * a.zx - a.wx * a.zy;
  const double bx = b.wx * b.zx + b.wy * b.zy, by = b.wy * b.zx - b.wx * b.zy;
  return a.across * b.across / 6 +
         a.part * a.inverseZ * b.part * b.inverseZ * (ax * bx + ay * by) / 2;
}

}  // namespace

double yieldStress(const PlasticMaterial& m, double strain, double temperature) {
  if (m.isFrictional()) return std::numbers::sqrt3 * Cone(m).strength;
  return staticStress(m, strain).stress * thermalFactor(m, temperature);
}

double plasticStep(const YieldConstants& c, const YieldPoint& point, double slow, double trial,
                   double dt) {
  const double stiffness = 3 * c.moduli.shear;
  const double thermal = thermalFactor(c.plastic, point.temperature);
  double low = 0, high = trial / stiffness;
  double step = (trial - slow) / stiffness;
  for (int i = 0; i < tolerance::kReturns; ++i) {
    const Hardening y = flowStress(c.plastic, point.strain, step, dt, thermal);
    const double left = trial - stiffness * step - y.stress;
    if (std::abs(left) <= tolerance::kReturned * trial) break;
    (left > 0 ? low : high) = step;
    const double next = step + left / (stiffness + y.slope);
    step = next > low && next < high ? next : (low + high) / 2;
  }
  return step;
}

double freeThickness(const Matrix2& f, double guess, double kept, const SolidModuli& moduli) {
  double thickness = guess;
  for (int i = 0; i < tolerance::kThicknesses; ++i) {
    const ElasticTrial t(f, thickness);
    const double stress =
        meanStress(t.volume, moduli.bulk) + 2 * moduli.shear * kept * t.across / 3;
    const double slope = moduli.bulk * t.volume * t.volume + 4. / 3 * moduli.shear * kept;
    thickness *= expOfSmall(-stress / slope);
    if (std::abs(stress) <= tolerance::kNoStress * moduli.bulk) break;
  }
  return thickness;
}

ElasticTrial trialOf(const YieldConstants& c, const YieldPoint& point, const TriangleEdges& now,
                     double& thickness) {
  const Matrix2 f = now.gradient(point.edges);
  thickness = c.planeStress ? freeThickness(f, point.thickness, 1, c.moduli) : point.thickness;
  return ElasticTrial::ofAnySize(f, thickness);
}

namespace {

/// Flow on the cone; `formerMean` (Pa): mean of τ at the last step.
void returnToCone(const YieldConstants& c, const ElasticTrial& former, double formerMean,
                  double size, const NodalPressure* pressure, Returned& result) {
  const auto [bulk, shear] = c.moduli;
  const double volume = result.trial.volume;
  const ConeTrial trial{shear * std::sqrt(result.trial.squaredMises() / 3), result.mean,
                        bulk * volume * volume, size};
  ConeFlow flowed{};
  if (pressure == nullptr) {
    flowed = coneFlow<false>(c.cone, shear, trial);
    result.mean = meanAfter<false>(trial, flowed.opening);
  } else {
    result.mean *= expOfSmall(-pressure->opening);
    flowed = {pressure->opening, goneBy(fallAt(c.cone, trial, result.mean), trial.distortion)};
  }
  const double opening = flowed.opening;
  if (!(opening > 0 || flowed.gone > 0)) return;
  const double squared = product(result.trial, result.trial);
  const double paired = product(result.trial, former);
  const double pull = opening * (formerMean + result.mean) / (2 * shear);
  const double gone = goneWithoutGain(flowed.gone, squared, paired, pull);
  result.kept = 1 - gone;
  result.opening = opening;
  const double work = shear * coneWork(gone, squared, paired, pull);
  result.dissipation = pressure == nullptr ? std::max(0., work) : work;
  flow(result.trial, result.kept, opening, result.point, result.point.thickness);
  const double slip = trial.distortion * gone / (std::numbers::sqrt3 * shear);
  result.point.strain += std::sqrt(slip * slip + 2. / 9 * opening * opening);
}

/// In plane stress the thickness depends on the flow, and the flow on the thickness.
double settleThickness(const YieldConstants& c, const YieldPoint& point, const TriangleEdges& now,
                       double slow, double dt, double step, double& thickness, Returned& result) {
  const Matrix2 f = now.gradient(point.edges);
  for (int i = 0; i < tolerance::kThicknesses; ++i) {
    const double last = thickness;
    thickness = freeThickness(f, last, result.kept, c.moduli);
    result.trial = ElasticTrial(f, thickness);
    const double trial = c.moduli.shear * std::sqrt(result.trial.squaredMises());
    step = trial > slow ? plasticStep(c, point, slow, trial, dt) : 0;
    result.kept = 1 - 3 * c.moduli.shear * step / trial;
    if (std::abs(thickness - last) <= tolerance::kNoStress) break;
  }
  return step;
}

}  // namespace

Returned returnToYield(const YieldConstants& c, const YieldPoint& point,
                       const TriangleMotion& motion, double dt, const NodalPressure* pressure) {
  double thickness = 1, formerThickness = 1;
  Returned result{point, trialOf(c, point, motion.now, thickness)};
  const double volume = result.trial.volume;
  result.mean = pressure != nullptr ? pressure->now * volume : meanStress(volume, c.moduli.bulk);
  result.trialMean = result.mean;
  if (c.plastic.isFrictional()) {
    const ElasticTrial former = trialOf(c, point, motion.before, formerThickness);
    const double mean = pressure != nullptr ? pressure->before * former.volume
                                            : meanStress(former.volume, c.moduli.bulk);
    returnToCone(c, former, mean, motion.size, pressure, result);
    return result;
  }
  const double slow = yieldStress(c.plastic, point.strain, point.temperature);
  const double trial = c.moduli.shear * std::sqrt(result.trial.squaredMises());
  if (!(trial > slow)) return result;
  double step = plasticStep(c, point, slow, trial, dt);
  result.kept = 1 - 3 * c.moduli.shear * step / trial;
  if (c.planeStress) {
    step = settleThickness(c, point, motion.now, slow, dt, step, thickness, result);
    result.mean = meanStress(result.trial.volume, c.moduli.bulk);
  }
  result.kept = std::max(0., result.kept);
  const ElasticTrial former = trialOf(c, point, motion.before, formerThickness);
  result.dissipation =
      c.moduli.shear * (1 - result.kept) *
      (product(result.trial, former) + result.kept * product(result.trial, result.trial));
  flow(result.trial, result.kept, 0, result.point, thickness);
  result.point.thickness = thickness;
  result.point.strain += step;
  result.point.temperature += c.heating * std::max(0., result.dissipation);
  return result;
}

double nodalOpening(const YieldConstants& c, const ElasticTrial& trial, double size,
                    double pressure) {
  const auto [bulk, shear] = c.moduli;
  const ConeTrial at{shear * std::sqrt(trial.squaredMises() / 3), pressure * trial.volume,
                     nodalStiffness(pressure, trial.volume, bulk), size};
  return coneFlow<false>(c.cone, shear, at).opening;
}

double squaredGradient(const std::array<double, 4>& e) {
  const Vec2 second{e[0], e[1]}, third{e[2], e[3]}, first = second + third;
  return std::max({dot(first, first), dot(second, second), dot(third, third)});
}

double Returned::volume() const { return trial.volume * expOfSmall(-opening); }

double deviatorEnergy(const ElasticTrial& trial, double kept, double shear) {
  return shear * kept * kept * product(trial, trial);
}

double volumeEnergy(double volume, double bulk) {
  return bulk / 2 * ((volume * volume - 1) / 2 - logOf(volume));
}

}  // namespace yadefrag
