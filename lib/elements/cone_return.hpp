#pragma once
// The return to Drucker and Prager's cone and to its limit of tension (de Souza Neto, Perić and
// Owen 2008, box 8.8), for single triangles and for the vector loops.
//
// The cone bounds the Cauchy stress τ/det F; det F does not change as a triangle flows. Flow by Δγ
// reduces √J₂ by μΔγ and opens the volume by θ = η̄Δγ, a logarithmic strain, so that J falls to
// J e^−θ and the mean of τ by s (1 − e^−2θ)/2, with s = κJ². In a return that is linear in θ the
// volume would open by more than η̄Δγ under pressure: that flow gains energy.

#include <algorithm>
#include <cmath>

#include "core/lanes.hpp"
#include "core/tolerances/dynamics.hpp"
#include "elements/yield_law.hpp"
#include "mesh/plastic_material.hpp"

namespace yadefrag {

/// A trial state, of τ.
struct ConeTrial {
  double distortion;  ///< Pa, √J₂
  double mean;        ///< Pa
  double stiffness;   ///< Pa, s
  double size;        ///< det F
};

struct ConeFlow {
  double opening;  ///< θ
  double gone;     ///< part of the deviator that flow takes away
};

/// exp x; `kTiny`: for |x| < tolerance::kTinyFlow.
template <bool kTiny>
[[gnu::always_inline]] inline double expOfAny(double x) {
  return kTiny ? expOfTiny(x) : expOfSmall(x);
}

/// (1 − e⁻ˣ)/x; `kTiny`: for x < 2 · tolerance::kTinyFlow.
template <bool kTiny>
[[gnu::always_inline]] inline double fallFactor(double x) {
  if (kTiny || x < 2 * tolerance::kTinyFlow)
    return 1 - x / 2 *
                   (1 - x * (1. / 3) *
                            (1 - x / 4 * (1 - x * (1. / 5) * (1 - x * (1. / 6) * (1 - x / 7)))));
  return (1 - expOf(-x)) / x;
}

/// (Pa) The mean of τ after the flow.
template <bool kTiny>
[[gnu::always_inline]] inline double meanAfter(const ConeTrial& t, double opening) {
  return t.mean - t.stiffness * opening * fallFactor<kTiny>(2 * opening);
}

/// (Pa) s of an element with this mean of U'(J) = κ (J − 1/J)/2 at its nodes.
[[gnu::always_inline]] inline double nodalStiffness(double pressure, double volume, double bulk) {
  const double p = pressure / bulk;
  return bulk * volume * (p + std::sqrt(p * p + 1));
}

/// Δγ on the cone from √J₂ + ησₘ − ξc = `over`: Newton's method, which comes from below.
template <bool kTiny>
[[gnu::always_inline]] inline double coneStep(const Cone& c, double shear, double over,
                                              double stiffness) {
  const double volumetric = c.slope * c.dilation * stiffness;
  const double by = 1 / (shear + volumetric), part = by * volumetric;
  const double first = over * by, unit = 2 * c.dilation;
  // What is left at `step`, and the slope.
  const auto improve = [&](double step, double& left) __attribute__((always_inline)) {
    const double x = unit * step, fall = fallFactor<kTiny>(x);
    left = first - step * (1 - part + part * fall);
    return step + left / (1 - part * x * fall);
  };
  double left = 0;
  if constexpr (kTiny) {
    const double start = unit * first;
    return improve(first + first * part * start / 2 * (1 + start * (part - 1. / 3)), left);
  }
  double step = first;
  for (int i = 0; i < tolerance::kReturns; ++i) {
    step = improve(step, left);
    if (left <= tolerance::kReturned * first) break;
  }
  return step;
}

/// (Pa) The fall of √J₂ to the cone if the mean of τ becomes `mean`.
[[gnu::always_inline]] inline double fallAt(const Cone& c, const ConeTrial& t, double mean) {
  return std::max(0., t.distortion - std::max(0., c.strength * t.size - c.slope * mean));
}

/// The part of the deviator that a fall of √J₂ takes away.
[[gnu::always_inline]] inline double goneBy(double fall, double distortion) {
  const double part = std::min(1., fall / distortion);
  return distortion > 0 ? part : 0;
}

template <bool kTiny>
[[gnu::always_inline]] inline ConeFlow coneFlow(const Cone& c, double shear, const ConeTrial& t) {
  const double limit = c.limit * t.size;
  const double over = std::max(0., t.distortion + c.slope * t.mean - c.strength * t.size);
  const double step = coneStep<kTiny>(c, shear, over, t.stiffness);
  const double sheared = c.dilation * step;
  const double above = t.stiffness - 2 * std::max(0., t.mean - limit);
  const double pulled = kTiny ? logRatio(t.stiffness, above) / 2 : logOf(t.stiffness / above) / 2;
  // At the limit of tension the state is at the edge of the cone, or inside. Both sides of each
  // choice are computed first, so that the loops over lanes have no branch.
  const double atCone = shear * step, atLimit = fallAt(c, t, std::min(t.mean, limit));
  const double fall = sheared >= pulled ? atCone : atLimit;
  return {std::max(sheared, pulled), goneBy(fall, t.distortion)};
}

/// The part of the deviator that flow takes away: at least so much that the work of the flow,
/// Δεₚ:½(τⁿ⁻¹ + τⁿ), is not negative, where less than a half is enough for that. Only then a step
/// across the edge of the cone does not gain energy. `squared`: e:e of the trial, `paired`: e:e' of
/// the trial and the last step, `pull`: θ times the sum of both means over 2μ.
[[gnu::always_inline]] inline double goneWithoutGain(double gone, double squared, double paired,
                                                     double pull) {
  // μg (e:e' + (1 − g) e:e) + μ·pull = 0
  const double sum = paired + squared;
  const double root = std::sqrt(std::max(0., sum * sum + 4 * squared * std::min(0., pull)));
  const double least = std::min(.5, (sum - root) / (2 * squared));
  return squared > 0 ? std::max(gone, least) : gone;
}

/// (1) That work over μ. What is left below 0 is an error of the step, no dissipation: with its own
/// volume a triangle then has dissipated nothing, and the error is seen in the sum of all energies.
/// With pressures of nodes only the sum over neighbours counts, which open each other's volumes.
[[gnu::always_inline]] inline double coneWork(double gone, double squared, double paired,
                                              double pull) {
  return gone * (paired + (1 - gone) * squared) + pull;
}

}  // namespace yadefrag
