#pragma once
// The return of the lanes of a metal in plane strain, in vector loops; the formulas are those of
// plastic_return.cpp. Lanes for which a short series or a fixed number of Newton steps is not
// enough are left to returnToYield.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

#include "core/lane_math.hpp"
#include "core/tolerances/plasticity.hpp"
#include "dynamics/lane_corners.hpp"
#include "dynamics/plastic_kernel.hpp"

namespace yadefrag {

/// State before the flow that only lanes that flow need, and values between the loops.
struct alignas(64) FlowLanes {
  double strain[kLanes], temperature[kLanes], yield[kLanes], thermal[kLanes];
  double over[kLanes];          ///< above 0 if the lane flows
  double mises[kLanes];         ///< Pa, of the trial
  double former[kLanes];        ///< Pa, equivalent stress of the last step
  double formerVolume[kLanes];  ///< J at the last step
  double paired[kLanes];        ///< e:e' of the trial and of the last step
  double step[kLanes];          ///< Δp
  double gone[kLanes];          ///< part of the trial's deviator that flow takes away
  double flows[kLanes];         ///< above 0 if the vector loop returns the lane
  double change[kLanes];        ///< its last change, relative
  double estimate[kLanes];      ///< of Δp
  /// Pa, part of Y₀ that grows, and 1/(p₀ + p), at the estimate.
  double growing[kLanes], inverse[kLanes];
  double power[kLanes], heat[kLanes];  ///< arguments of powers, then their logarithms
  double logarithm[kLanes];            ///< of the estimate's rate over the reference rate
  double opening[kLanes];              ///< volume strain of the flow
  double size[kLanes];                 ///< det F
  double fails[kLanes];                ///< above 0 if the lane must be returned alone
};

/// Compares the trial with the last step, at the corners `b`; `kKind`: what needs which values.
template <YieldCurve::Kind kKind>
[[gnu::always_inline]] inline void lookBack(const Corners& b, const StateLanes& s,
                                            const TrialLanes& t, double shear, FlowLanes& w) {
#pragma omp simd
  for (std::size_t k = 0; k < kLanes; ++k) {
    const Matrix2 f = deformationGradient(
        b.x[1][k] - b.x[0][k], b.y[1][k] - b.y[0][k], b.x[2][k] - b.x[0][k], b.y[2][k] - b.y[0][k],
        s.edges[0][k], s.edges[1][k], s.edges[2][k], s.edges[3][k]);
    const ElasticTrial former(f, s.thickness[k]);
    const double ax = t.wx[k] * t.zx[k] + t.wy[k] * t.zy[k];
    const double ay = t.wy[k] * t.zx[k] - t.wx[k] * t.zy[k];
    const double bx = former.wx * former.zx + former.wy * former.zy;
    const double by = former.wy * former.zx - former.wx * former.zy;
    const double part = t.part[k] * t.inverseZ[k] * former.part * former.inverseZ;
    w.paired[k] = t.across[k] * former.across / 6 + part * (ax * bx + ay * by) / 2;
    w.mises[k] = shear * std::sqrt(t.squaredMises[k]);
    if constexpr (kKind == YieldCurve::Kind::kCurved)
      w.former[k] = shear * std::sqrt(former.squaredMises());
    if constexpr (kKind == YieldCurve::Kind::kCone) w.formerVolume[k] = former.volume;
  }
}

/// Δp of a straight curve without effects of rate and temperature.
[[gnu::always_inline]] inline void stepOnLine(const YieldCurve c, FlowLanes& w) {
  const double by = 1 / (c.stiffness + c.factor);
#pragma omp simd
  for (std::size_t k = 0; k < kLanes; ++k) {
    w.step[k] = (w.mises[k] - w.yield[k]) * by;
    w.fails[k] = 0;
  }
}

/// Y₀ at a first estimate of Δp, from the stress of the last step.
[[gnu::always_inline]] inline void estimateStep(const YieldCurve c, FlowLanes& w) {
#pragma omp simd
  for (std::size_t k = 0; k < kLanes; ++k) {
    const double thermal = w.thermal[k], trial = w.mises[k], yield = w.yield[k];
    const double start = std::max(w.former[k], yield);
    // The rate of the last step multiplies both.
    const double slope =
        (yield - thermal * c.base) * c.exponent * start / ((w.strain[k] + c.shift) * yield);
    const double likely = (trial - start) / (c.stiffness + slope);
    const double step = std::max(likely, (trial - yield) * c.leastStep);
    w.estimate[k] = step, w.step[k] = step;
    w.power[k] = c.begin + (w.strain[k] + step) / c.unit;
    w.logarithm[k] = step * c.perRate;
  }
}

[[gnu::always_inline]] inline void takeLogarithms(double (&x)[kLanes]) {
#pragma omp simd
  for (std::size_t k = 0; k < kLanes; ++k) x[k] = logOf(x[k]);  // NOLINT(modernize-loop-convert)
}

[[gnu::always_inline]] inline void estimateStress(const YieldCurve c, FlowLanes& w) {
#pragma omp simd
  for (std::size_t k = 0; k < kLanes; ++k) {
    w.growing[k] = c.factor * expOf(c.exponent * w.power[k]);
    w.inverse[k] = 1 / (w.strain[k] + w.estimate[k] + c.shift);
  }
}

/// One step of Chebyshev's method, which triples the correct digits; Y₀ and the logarithm of the
/// rate by series about the estimate. `kFirst`: at the estimate itself.
template <bool kFirst>
[[gnu::always_inline]] inline void improveStep(const YieldCurve c, FlowLanes& w) {
  const auto b = c.binomial;
#pragma omp simd
  for (std::size_t k = 0; k < kLanes; ++k) {
    const double thermal = w.thermal[k], step = w.step[k], estimate = w.estimate[k];
    const double inverse = w.inverse[k], part = w.growing[k];
    double power = 1, powerSlope = b[1], above = w.logarithm[k];
    if constexpr (!kFirst) {
      const double x = (step - estimate) * inverse, x2 = x * x;
      power += x * b[1] + (b[2] + x * b[3] + (b[4] + x * b[5]) * x2) * x2;
      powerSlope += 2 * x * b[2];
      const double y = (step - estimate) / (step + estimate), y2 = y * y, y4 = y2 * y2;
      const double series = 1 + y2 * (1. / 3) + (1. / 5 + y2 * (1. / 7)) * y4 +
                            (1. / 9 + y2 * (1. / 11) + 1. / 13 * y4) * (y4 * y4);
      above += 2 * y * series;
    }
    const double slow = thermal * (c.base + part * power);
    const double slope = thermal * part * inverse * powerSlope;
    const double rate = 1 + c.rateFactor * std::max(0., above);
    const double byRate = slow * (above > 0 ? c.rateFactor : 0);
    const double left = w.mises[k] - c.stiffness * step - slow * rate;
    const double unit = 1 / ((c.stiffness + slope * rate) * step + byRate);
    const double first = std::max(left * unit, -.9);
    const double change = first * (1 + byRate * unit * first / 2);
    w.step[k] = step + step * change;
    w.change[k] = std::abs(first);
  }
}

/// Ends the iteration.
[[gnu::always_inline]] inline void settleStep(const YieldCurve c, FlowLanes& w) {
  double most = 0;  // without NaN, for which a further step is of no use
  for (std::size_t k = 0; k < kLanes; ++k) most = std::max(most, w.over[k] > 0 ? w.change[k] : 0);
  if (most > tolerance::kLaneReturned) improveStep<false>(c, w);
#pragma omp simd
  for (std::size_t k = 0; k < kLanes; ++k) {
    // Each comparison is false for NaN.
    const double away = std::abs(w.step[k] - w.estimate[k]);
    const double x = away * w.inverse[k] * (1 / tolerance::kBinomial);
    const double y = away / w.estimate[k] * (1 / tolerance::kLogarithmic);
    const double ratio = w.step[k] * c.stiffness / w.mises[k];
    const double isClose = w.change[k] <= tolerance::kLaneReturned ? 1 : 0;
    const double isGood = std::max(x, y) <= 1 ? isClose : 0;
    w.fails[k] = ratio < 1 ? 1 - isGood : 1;
  }
}

/// Marks the lanes that flow, and those that fail.
[[gnu::always_inline]] inline void markLanes(const YieldCurve c, const TrialLanes& t,
                                             FlowLanes& w) {
  constexpr double kTinySquare = tolerance::kTinyFlow * tolerance::kTinyFlow;
#pragma omp simd
  for (std::size_t k = 0; k < kLanes; ++k) {
    const double gone = c.stiffness * w.step[k] / w.mises[k];
    const double squared = gone * gone * t.squaredMises[k] / 9, fails = w.fails[k];
    const double isWanted = w.over[k] > 0 ? 1 : 0;
    const double isTiny = squared < kTinySquare ? isWanted : 0;
    const double isGood = fails > 0 ? 0 : isTiny;
    w.gone[k] = gone;
    w.flows[k] = isGood;
    w.fails[k] = isWanted - isGood;
  }
}

/// State after the flow, of all lanes.
struct alignas(64) FlowedLanes {
  double edges[4][kLanes], thickness[kLanes], kept[kLanes];
  double strain[kLanes], temperature[kLanes], yield[kLanes], thermal[kLanes];
  double work[kLanes];   ///< J/m³
  double steep[kLanes];  ///< 1/m², largest |∇N|²
};

/// As `flow` in plastic_return.cpp. `kOpens`: the flow changes the volume.
template <bool kOpens>
[[gnu::always_inline]] inline void shapeLanes(const StateLanes& s, const TrialLanes& t,
                                              const FlowLanes& w, FlowedLanes& out) {
#pragma omp simd
  for (std::size_t k = 0; k < kLanes; ++k) {
    const double gone = w.gone[k], across = gone * t.across[k] / 3;
    const double squared = gone * gone * (t.squaredMises[k] - t.across[k] * t.across[k]) / 12;
    const double cosh = 1 + squared / 2 * (1 + squared / 12 * (1 + squared / 30));
    const double sinhFactor = 1 + squared / 6 * (1 + squared / 20 * (1 + squared / 42));
    double third = 0;
    if constexpr (kOpens) third = w.opening[k] * (1. / 3);
    const double grown = expOfTiny(kOpens ? across / 2 - third : across / 2);
    const double by = grown * sinhFactor * gone * t.part[k] / 2 * t.inverseZ[k];
    const double real = by * (t.wx[k] * t.zx[k] + t.wy[k] * t.zy[k]);
    const double xy = by * (t.wx[k] * t.zy[k] - t.wy[k] * t.zx[k]);
    const double xx = grown * cosh - real, yy = grown * cosh + real;
    const double e0 = s.edges[0][k], e1 = s.edges[1][k];
    const double e2 = s.edges[2][k], e3 = s.edges[3][k];
    const double n0 = e0 * xx + e1 * xy, n1 = e0 * xy + e1 * yy;
    const double n2 = e2 * xx + e3 * xy, n3 = e2 * xy + e3 * yy;
    const double sx = n0 + n2, sy = n1 + n3;
    const double first = sx * sx + sy * sy, second = n0 * n0 + n1 * n1;
    out.steep[k] = std::max(std::max(first, second), n2 * n2 + n3 * n3);
    out.edges[0][k] = n0, out.edges[1][k] = n1, out.edges[2][k] = n2, out.edges[3][k] = n3;
    out.thickness[k] = s.thickness[k] * expOfTiny(kOpens ? -across - third : -across);
  }
}

/// Strain and heat.
template <bool kCurved>
[[gnu::always_inline]] inline void hardenLanes(const YieldCurve c, const TrialLanes& t,
                                               FlowLanes& w, FlowedLanes& out) {
  const double shear = c.stiffness / 3;
#pragma omp simd
  for (std::size_t k = 0; k < kLanes; ++k) {
    const double gone = w.gone[k], kept = 1 - gone;
    const double work = shear * gone * (w.paired[k] + kept * t.squaredMises[k] * (1. / 6));
    const double strain = w.strain[k] + w.step[k];
    const double temperature = w.temperature[k] + c.heating * std::max(0., work);
    out.kept[k] = kept, out.work[k] = work;
    out.strain[k] = strain, out.temperature[k] = temperature;
    if constexpr (kCurved) {
      const double relative = (temperature - c.startTemperature) / c.range;
      w.power[k] = c.begin + strain / c.unit;
      w.heat[k] = std::min(std::max(relative, 0.), 1.);
      out.thermal[k] = w.heat[k];
    } else {
      out.yield[k] = c.base + c.factor * strain;
    }
  }
}

/// The yield stress that follows, as that of yieldStress, with the same bits.
[[gnu::always_inline]] inline void yieldOfLanes(const YieldCurve c, const FlowLanes& w,
                                                FlowedLanes& out) {
#pragma omp simd
  for (std::size_t k = 0; k < kLanes; ++k) {
    const double power = expOf(c.exponent * w.power[k]);
    const double weaker = expOf(c.thermalExponent * w.heat[k]);
    const double thermal = 1 - (out.thermal[k] > 0 ? weaker : 0);
    out.thermal[k] = thermal;
    out.yield[k] = (c.base + c.factor * power) * thermal;
  }
}

/// Replaces the values of lanes that flow.
[[gnu::always_inline]] inline void choose(const double (&flows)[kLanes],
                                          const double (&fresh)[kLanes], double (&values)[kLanes]) {
#pragma omp simd
  for (std::size_t k = 0; k < kLanes; ++k) {
    const double now = fresh[k], old = values[k];
    values[k] = flows[k] > 0 ? now : old;
  }
}

[[gnu::always_inline]] inline void addFlow(const FlowedLanes& fresh, const double* volume,
                                           const FlowLanes& w, FlowSums& sums) {
#pragma omp simd
  for (std::size_t k = 0; k < kLanes; ++k) {
    const double work = fresh.work[k] * volume[k], steep = fresh.steep[k];
    sums.dissipated[k] += w.flows[k] > 0 ? work : 0;
    sums.steepest[k] = std::max(sums.steepest[k], w.flows[k] > 0 ? steep : 0);
  }
}

/// Writes the state after the flow to `s`, `w` and `t`. A lane that fails stays as it was.
template <bool kCurved>
[[gnu::always_inline]] inline void takeFlow(const FlowedLanes& fresh, const double* volume,
                                            StateLanes& s, TrialLanes& t, FlowLanes& w,
                                            FlowSums& sums) {
  for (std::size_t i = 0; i < 4; ++i) choose(w.flows, fresh.edges[i], s.edges[i]);
  choose(w.flows, fresh.thickness, s.thickness);
  choose(w.flows, fresh.kept, t.kept);
  choose(w.flows, fresh.strain, w.strain);
  choose(w.flows, fresh.temperature, w.temperature);
  choose(w.flows, fresh.yield, w.yield);
  if constexpr (kCurved) choose(w.flows, fresh.thermal, w.thermal);
  addFlow(fresh, volume, w, sums);
}

}  // namespace yadefrag
