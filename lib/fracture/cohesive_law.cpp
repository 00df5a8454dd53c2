#include "fracture/cohesive_law.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include "core/tolerances/fracture.hpp"

namespace yadefrag {
namespace {

/// (m) The common denominator D of the tractions T(δmax)·(oₙ, (β²/κ)oₛ)/D at the end of the step:
/// D = δmax on the unloading line, D = δ(o) where the opening grows. With o = o* − C·T,
///   Tₙ = T(δmax) oₙ*/(D + Cₙ T(δmax)),  Tₛ = T(δmax) (β²/κ)oₛ*/(D + Cₛ (β²/κ)T(δmax)),
/// the condition δ(o) = D is an equation with one unknown, |f(D)| = 1. 1/|f| is nearly linear: one
/// Newton step is exact if both directions have the same coefficients; otherwise a few are needed.
double denominator(const CohesiveHold& hold, AcrossAlong trial) {
  const double beta = hold.shearFactor, weight = hold.shearRatio / beta;  // β/κ
  const double normal = std::max(0., trial.normal), shear = weight * trial.shear;
  const double stiffNormal = hold.compliance.normal * hold.most;
  const double stiffShear = hold.compliance.shear * hold.shearRatio * hold.most;
  double d = hold.largest;
  for (int i = 0; i < tolerance::kMostOpeningSteps; ++i) {
    const double below = d + stiffNormal, aside = d + stiffShear;
    if ((normal > 0 && below <= 0) || (shear != 0 && aside <= 0)) return std::hypot(normal, shear);
    const double a = normal > 0 ? normal / below : 0, b = shear != 0 ? shear / aside : 0;
    const double squared = a * a + b * b;
    if (squared <= 1) return d;
    // Newton's method for 1/√squared − 1 = 0.
    const double fall = (a > 0 ? a * a / below : 0) + (b != 0 ? b * b / aside : 0);
    const double change = (std::sqrt(squared) - 1) * squared / fall;
    d += change;
    if (change <= tolerance::kOpeningStep * (d + std::max(stiffNormal, stiffShear))) return d;
  }
  return d;
}

/// Tractions without friction, for faces that are not pressed together.
FaceTractions cohesive(const CohesiveHold& hold, AcrossAlong trial) {
  if (hold.most <= 0) return {};
  const double d = denominator(hold, trial);
  const auto along = [&](double opening, double factor, double compliance) {
    const double stiff = factor * hold.most, whole = d + compliance * stiff;
    return whole > 0 ? stiff * opening / whole : 0;
  };
  return {along(std::max(0., trial.normal), 1, hold.compliance.normal),
          along(trial.shear, hold.shearRatio, hold.compliance.shear), 0};
}

/// (Pa) Shear of the law at the slip at the begin of the step, for closed faces. `all`: Pa, the
/// shear that would keep this slip. An edge that has not opened takes as much of it as possible.
double shearAt(const CohesiveHold& hold, double slid, double all) {
  const double most = hold.shearFactor * hold.most;
  if (hold.largest <= 0) return std::clamp(all, -most, most);
  return std::clamp(hold.shearRatio * hold.most * slid / hold.largest, -most, most);
}

}  // namespace

double envelope(const TensionLaw& law, double opening) {
  if (opening >= law.criticalOpening) return 0;  // also with δc = 0
  const std::vector<SofteningPoint>& points = law.curve.points();
  std::size_t i = 1;
  while (i + 1 < points.size() && opening >= points[i].opening * law.criticalOpening) ++i;
  const double begin = points[i - 1].opening * law.criticalOpening;
  const double end = points[i].opening * law.criticalOpening;
  return law.strength *
         (points[i - 1].traction * (end - opening) + points[i].traction * (opening - begin)) /
         (end - begin);
}

double spentEnergy(const TensionLaw& law, double largestOpening) {
  const double last = std::min(largestOpening, law.criticalOpening);
  const double held = envelope(law, last) / law.strength;
  // Twice the area between the axis and the line to the origin, by the polygon's vertices.
  double sum = 0, opening = 0, traction = 1;
  for (const SofteningPoint& point : law.curve.points()) {
    const double next = point.opening * law.criticalOpening;
    if (next >= last) break;
    sum += traction * next - point.traction * opening;
    opening = next, traction = point.traction;
  }
  sum += traction * last - held * opening;
  return law.strength * sum / 2;
}

double countedOpening(double own, double other, double criticalOpening) {
  const double apart = other - own;
  if (std::abs(apart) >= criticalOpening) return own + apart / 2;
  const double part = apart / criticalOpening;
  return own + part * part * apart / 2;
}

double effectiveOpening(AcrossAlong opening, double shearFactor, double shearRatio) {
  return std::hypot(std::max(0., opening.normal), shearRatio / shearFactor * opening.shear);
}

FaceTractions faceTractions(const CohesiveHold& hold, AcrossAlong trial, double slid) {
  if (trial.normal >= 0 || hold.compliance.normal <= 0) return cohesive(hold, trial);
  const double push = trial.normal / hold.compliance.normal;
  const double bound = -hold.friction * push;
  const double compliance = hold.compliance.shear;
  FaceTractions result;
  if (bound <= 0 || compliance <= 0) {
    result = cohesive(hold, {0, trial.shear});
  } else {
    // Law and friction both increase with the slip: exactly one slip satisfies both and the motion.
    const double all = (trial.shear - slid) / compliance;
    const double stuck = shearAt(hold, slid, all);
    if (std::abs(all - stuck) <= bound) {
      result.shear = stuck, result.friction = all - stuck;
    } else {
      const double friction = std::copysign(bound, all - stuck);
      result = cohesive(hold, {0, trial.shear - compliance * friction});
      result.friction = friction;
    }
  }
  result.normal = push;
  return result;
}

}  // namespace yadefrag
