#pragma once
// The return of trial stresses to the yield surface, of W triangles: groups of kLanes in the vector
// loops, or a single one. Radial return (Simo and Hughes 1998, box 3.1 and 9.1): the deviator of
// the elastic strain is multiplied by 1 − 3μΔp/q, with Δp from q − 3μΔp = Y(p + Δp, Δp/Δt, T).
//
// Stages are short loops over all groups that flow, so that the values of one need not wait for
// another's. Lanes in which a short series is not exact are rare: the same function with `kAnySize`
// computes them afterwards, one by one.

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

#include "core/lanes.hpp"
#include "core/tolerances/dynamics.hpp"
#include "elements/flow_lanes.hpp"
#include "elements/lane_corners.hpp"
#include "elements/plastic_return.hpp"

namespace yadefrag {

/// Constants and positions of a return.
template <std::size_t W>
struct ReturnInput {
  YieldConstants c;
  double dt;                      ///< s, 0: slow
  const Corners<W>&now, &before;  ///< m, of the corners, now and at the last step
};

/// Newton's method for the stretch across the plane at which the stress there is zero.
[[gnu::always_inline]] inline double elasticThickness(const Matrix2& f, double thickness,
                                                      const SolidModuli& m) {
  for (int i = 0; i < tolerance::kElasticThicknesses; ++i) {
    const double change = StressAcross(ElasticTrial(f, thickness), 1, m).step;
    thickness *= 1 - change + change * change / 2;
  }
  return thickness;
}

/// The trial at `f`; in plane stress with the thickness that is free to change.
template <bool kAnySize, bool kPlane>
[[gnu::always_inline]] inline ElasticTrial trialAt(const Matrix2& f, const SolidModuli& m,
                                                   double& thickness) {
  if constexpr (kPlane)
    thickness = kAnySize ? freeThickness(f, thickness, 1, m) : elasticThickness(f, thickness, m);
  return kAnySize ? ElasticTrial::ofAnySize(f, thickness) : ElasticTrial(f, thickness);
}

/// Of all lanes: the trial, and whether it is above the yield surface.
template <bool kPlane, bool kNodal, bool kCone, std::size_t W>
[[gnu::always_inline]] inline void tryLanes(const ReturnInput<W>& in, FlowLanes<W>& w) {
  const SolidModuli moduli = in.c.moduli;
  const double squaredShear = moduli.shear * moduli.shear;
  const double slope = std::numbers::sqrt3 * in.c.cone.slope, most = in.c.cone.limit;
  w.groups.forEach([&](std::size_t k) __attribute__((always_inline)) {
    double thickness = w.thickness[k];
    const ElasticTrial t = trialAt<W == 1, kPlane>(in.now.gradient(w.edges, k), moduli, thickness);
    double mean = 0;
    if constexpr (kNodal)
      mean = w.pressure[k] * t.volume;
    else
      mean = meanStress(t.volume, moduli.bulk);
    double yield = w.yield[k], limit = std::numeric_limits<double>::infinity();
    if constexpr (kCone)
      yield = std::max(0., yield * w.size[k] - slope * mean), limit = most * w.size[k];
    double over = squaredShear * t.squaredMises() - yield * yield;
    if constexpr (kCone) over = mean > limit ? 1 : over;
    if constexpr (kCone && kNodal) over = std::max(over, w.opening[k]);
    w.over[k] = t.volume > 0 ? over : 0;  // an inverted one is refused
    w.trial.set(k, t);
    w.stretch[k] = thickness, w.mean[k] = mean, w.kept[k] = 1;
  });
}

/// Compares the trial with the last step.
template <bool kPlane, bool kNodal, bool kCone, std::size_t W>
[[gnu::always_inline]] inline void compareWithLastStep(const ReturnInput<W>& in, FlowLanes<W>& w) {
  const SolidModuli m = in.c.moduli;
  w.forAnySize([&](std::size_t k, auto isAlone) __attribute__((always_inline)) {
    constexpr bool kAnySize = decltype(isAlone)::value, kFree = kPlane && kAnySize;
    double thickness = w.formerThickness[k];
    const ElasticTrial former =
        trialAt<kAnySize, kFree>(in.before.gradient(w.edges, k), m, thickness);
    ElasticTrial t = w.trial[k];
    if constexpr (kAnySize && W > 1) {
      thickness = w.thickness[k];
      t = trialAt<true, kPlane>(in.now.gradient(w.edges, k), m, thickness);
      w.trial.set(k, t), w.stretch[k] = thickness;
    }
    w.paired[k] = product(t, former);
    w.mises[k] = m.shear * std::sqrt(t.squaredMises());
    w.former[k] = m.shear * std::sqrt(former.squaredMises());
    if constexpr (kCone) {
      w.formerMean[k] =
          kNodal ? w.formerPressure[k] * former.volume : meanStress(former.volume, m.bulk);
    }
    const double isLarge =
        kPlane || !(std::max(t.squaredMises(), former.squaredMises()) < tolerance::kSeries) ? 1 : 0;
    w.rare[k] = w.over[k] > 0 ? isLarge : 0;
  });
}

/// A first estimate of Δp, from the stress of the last step.
template <std::size_t W>
[[gnu::always_inline]] inline void estimateStep(const YieldConstants c, FlowLanes<W>& w) {
  const double stiffness = 3 * c.moduli.shear;
  w.groups.forEach([&](std::size_t k) __attribute__((always_inline)) {
    const double trial = w.mises[k], yield = w.yield[k], start = std::max(w.former[k], yield);
    // The rate of the last step multiplies both.
    const double slope =
        (yield - w.thermal[k] * c.base) * c.exponent * start / ((w.strain[k] + c.shift) * yield);
    const double likely = (trial - start) / (stiffness + slope);
    const double least = .02 * (trial - yield) / stiffness;
    const double step = likely > least ? likely : least;  // without NaN
    const double isAbove = trial > yield ? 1 : 0, isOpen = w.over[k] > 0 ? isAbove : 0;
    w.step[k] = isOpen > 0 ? step : 0;
    w.low[k] = 0, w.high[k] = 2 * trial / stiffness;
    w.change[k] = isOpen;
  });
}

/// Y₀ at the estimate.
template <YieldConstants::Kind kKind, std::size_t W>
[[gnu::always_inline]] inline void hardenTo(const YieldConstants c, const LaneGroups<W>& groups,
                                            FlowLanes<W>& w) {
  groups.forEach([&](std::size_t k) __attribute__((always_inline)) {
    const double strain = w.strain[k] + w.step[k];
    if constexpr (kKind == YieldConstants::Kind::kAny) {
      const Hardening y = staticStress(c.plastic, strain);
      w.slow[k] = y.stress, w.slope[k] = y.slope;
    } else {
      const double growing = c.factor * expOf(c.exponent * logOf(c.begin + strain / c.unit));
      w.slow[k] = c.base + growing, w.slope[k] = growing * c.exponent / (c.shift + strain);
    }
  });
}

/// One step of Chebyshev's method, which triples the correct digits, within known bounds.
template <std::size_t W>
[[gnu::always_inline]] inline void improveStep(const YieldConstants c, double dt,
                                               const LaneGroups<W>& groups, FlowLanes<W>& w) {
  const double stiffness = 3 * c.moduli.shear, rateFactor = dt > 0 ? c.plastic.rateFactor : 0;
  const double perRate = dt > 0 ? 1 / (c.plastic.referenceRate * dt) : 0;
  groups.forEach([&](std::size_t k) __attribute__((always_inline)) {
    const double thermal = w.thermal[k], step = w.step[k], trial = w.mises[k];
    const double slow = thermal * w.slow[k], slope = thermal * w.slope[k];
    const double above = logOf(step * perRate);
    const double rate = 1 + rateFactor * std::max(0., above);
    const double slopeByRate = above > 0 ? rateFactor : 0, byRate = slow * slopeByRate;
    const double left = trial - stiffness * step - slow * rate;
    const double low = left > 0 ? step : w.low[k], high = left > 0 ? w.high[k] : step;
    const double unit = 1 / ((stiffness + slope * rate) * step + byRate);
    const double first = left * unit;
    // Δp² Y''
    const double bend = slope * c.bending / (w.strain[k] + step + c.shift) * rate * step;
    const double curvature = (bend + 2 * slope * slopeByRate) * step - byRate;
    const double next = step + step * first * (1 - curvature * unit * first / 2);
    // Each comparison is false for NaN.
    const double middle = (low + high) / 2, below = next <= high ? next : middle;
    const double change = w.change[k], isOpen = change > c.accuracy ? 1 : 0;
    w.step[k] = isOpen > 0 ? (next >= low ? below : middle) : step;
    w.low[k] = low, w.high[k] = high;
    const double now = std::abs(left) > tolerance::kReturned * trial ? std::abs(first) : 0;
    w.change[k] = isOpen > 0 ? now : change;
  });
}

/// Δp of a metal.
template <YieldConstants::Kind kKind, std::size_t W>
[[gnu::always_inline]] inline void findStep(const YieldConstants c, double dt, FlowLanes<W>& w) {
  if constexpr (kKind == YieldConstants::Kind::kLine) {
    const double by = 1 / (3 * c.moduli.shear + c.factor);
    w.groups.forEach([&](std::size_t k) __attribute__((always_inline)) {
      const double step = (w.mises[k] - w.yield[k]) * by;
      w.step[k] = w.over[k] > 0 ? step : 0;
    });
    return;
  }
  estimateStep(c, w);
  LaneGroups<W> open = w.groups;
  for (int i = 0; i < tolerance::kReturns && open.count > 0; ++i) {
    hardenTo<kKind>(c, open, w);
    improveStep(c, dt, open, w);
    open = open.with([&](std::size_t k)
                         __attribute__((always_inline)) { return w.change[k] > c.accuracy; });
  }
}

/// The part of the deviator that flow takes away.
template <std::size_t W>
[[gnu::always_inline]] inline double goneAt(const SolidModuli& m, const FlowLanes<W>& w,
                                            std::size_t k) {
  const double gone = std::min(1., 3 * m.shear * w.step[k] / w.mises[k]);
  return w.step[k] > 0 ? gone : 0;
}

/// In plane stress the thickness depends on the flow, and the flow on the thickness.
template <YieldConstants::Kind kKind, std::size_t W>
[[gnu::always_inline]] inline void solveThickness(const ReturnInput<W>& in, FlowLanes<W>& w) {
  const SolidModuli m = in.c.moduli;
  LaneGroups<W> open = w.groups;
  for (int i = 0; i < tolerance::kThicknesses && open.count > 0; ++i) {
    open.forEach([&](std::size_t k) __attribute__((always_inline)) {
      if (!(w.rare[k] > 0)) return;
      const Matrix2 f = in.now.gradient(w.edges, k);
      const double last = w.stretch[k];
      w.stretch[k] = freeThickness(f, last, 1 - goneAt(m, w, k), m);
      const auto t = ElasticTrial::ofAnySize(f, w.stretch[k]);
      double thickness = w.thickness[k];
      const ElasticTrial former = trialAt<true, true>(in.before.gradient(w.edges, k), m, thickness);
      w.trial.set(k, t);
      w.mises[k] = m.shear * std::sqrt(t.squaredMises()), w.paired[k] = product(t, former);
      w.mean[k] = meanStress(t.volume, m.bulk);
      if (std::abs(w.stretch[k] - last) <= tolerance::kNoStress) w.rare[k] = 0;
    });
    findStep<kKind>(in.c, in.dt, w);
    open = open.with([&](std::size_t k) __attribute__((always_inline)) { return w.rare[k] > 0; });
  }
}

/// What the flow of a metal takes away and adds.
template <std::size_t W>
[[gnu::always_inline]] inline void harden(const YieldConstants c, FlowLanes<W>& w) {
  constexpr double kTinySquare = tolerance::kTinyFlow * tolerance::kTinyFlow;
  w.groups.forEach([&](std::size_t k) __attribute__((always_inline)) {
    const double squared = w.trial[k].squaredMises(), gone = goneAt(c.moduli, w, k);
    const double work = c.moduli.shear * gone * (w.paired[k] + (1 - gone) * squared * (1. / 6));
    w.rare[k] = gone * gone * squared / 9 < kTinySquare ? 0 : 1;
    w.gone[k] = gone, w.kept[k] = 1 - gone, w.work[k] = work;
    w.strain[k] += w.step[k];
    w.temperature[k] += c.heating * std::max(0., work);
  });
}

/// Flow on the cone; `kNodal`: with the opening that is known, and the mean before it.
template <bool kNodal, std::size_t W>
[[gnu::always_inline]] inline void flowOnCone(const YieldConstants c, FlowLanes<W>& w) {
  constexpr double kTinySquare = tolerance::kTinyFlow * tolerance::kTinyFlow;
  const auto [bulk, shear] = c.moduli;
  w.forAnySize(
      [&, bulk = bulk, shear = shear ](std::size_t k, auto isAlone) __attribute__((always_inline)) {
        constexpr bool kTiny = !decltype(isAlone)::value;
        const ElasticTrial t = w.trial[k];
        const double distortion = w.mises[k] * (1 / std::numbers::sqrt3);
        const ConeTrial at{distortion, w.mean[k], bulk * t.volume * t.volume, w.size[k]};
        ConeFlow flowed{};
        double mean = 0;
        if constexpr (kNodal) {
          mean = at.mean * expOfAny<kTiny>(-w.opening[k]);
          flowed = {w.opening[k], goneBy(fallAt(c.cone, at, mean), distortion)};
        } else {
          flowed = coneFlow<kTiny>(c.cone, shear, at);
          mean = meanAfter<kTiny>(at, flowed.opening);
        }
        const double opening = flowed.opening, squaredStrain = t.squaredMises() * (1. / 6);
        const double pull = opening * (w.formerMean[k] + mean) / (2 * shear);
        const double gone = goneWithoutGain(flowed.gone, squaredStrain, w.paired[k], pull);
        const double slip = distortion * gone / (std::numbers::sqrt3 * shear);
        const double work = shear * coneWork(gone, squaredStrain, w.paired[k], pull);
        const double strain = std::sqrt(slip * slip + 2. / 9 * opening * opening);
        double flows = w.over[k] > 0 ? 1 : 0;
        if constexpr (kTiny) {
          // Each comparison is false for NaN.
          const double squared = gone * gone * t.squaredMises() / 9 + opening * opening;
          const double isTiny = squared < kTinySquare ? flows : 0;
          w.rare[k] = flows - isTiny, flows = isTiny;
        }
        w.gone[k] = flows > 0 ? gone : 0, w.kept[k] = 1 - w.gone[k];
        w.work[k] = flows > 0 ? (kNodal ? work : std::max(0., work)) : 0;
        w.strain[k] += flows > 0 ? strain : 0;
        w.opening[k] = flows > 0 ? opening : w.opening[k];
        w.mean[k] = flows > 0 ? mean : w.mean[k];
      });
}

/// Fₑ exp(−Δεₚ), where Δεₚ is the part of the trial's deviator that is gone, and a volume strain if
/// `kOpens`.
template <bool kOpens, std::size_t W>
[[gnu::always_inline]] inline void shape(FlowLanes<W>& w) {
  w.forAnySize([&](std::size_t k, auto isAlone) __attribute__((always_inline)) {
    constexpr bool kTiny = !decltype(isAlone)::value;
    const ElasticTrial t = w.trial[k];
    const double gone = w.gone[k], across = gone * t.across / 3;
    // exp of a symmetric matrix: x → e^h (cosh x − sinh/|ℓ| ℓ x̄), ℓ = gone · part · u
    const double squared = gone * gone * t.squared / 4;
    double cosh = 1 + squared / 2 * (1 + squared / 12 * (1 + squared / 30));
    double sinhFactor = 1 + squared / 6 * (1 + squared / 20 * (1 + squared / 42));
    if (!kTiny && squared > tolerance::kTinyFlow * tolerance::kTinyFlow) {
      const double size = std::sqrt(squared), up = expOf(size), down = 1 / up;
      cosh = (up + down) / 2, sinhFactor = (up - down) / (2 * size);
    }
    const double third = kOpens ? w.opening[k] * (1. / 3) : 0;
    const double grown = expOfAny<kTiny>(across / 2 - third);
    const double by = grown * sinhFactor * gone * t.part / 2 * t.inverseZ;
    const double real = by * (t.wx * t.zx + t.wy * t.zy), xy = by * (t.wx * t.zy - t.wy * t.zx);
    const double xx = grown * cosh - real, yy = grown * cosh + real;
    const double e0 = w.edges[0][k], e1 = w.edges[1][k], e2 = w.edges[2][k], e3 = w.edges[3][k];
    const std::array<double, 4> fresh{e0 * xx + e1 * xy, e0 * xy + e1 * yy,  //
                                      e2 * xx + e3 * xy, e2 * xy + e3 * yy};
    const double thickness = w.stretch[k] * expOfAny<kTiny>(-across - third);
    // A lane that is computed alone afterwards needs the state before the flow.
    const double flows = std::max(gone, third), isTaken = kTiny && w.rare[k] > 0 ? 0 : flows;
    w.steep[k] = isTaken > 0 ? squaredGradient(fresh) : 0;
    for (std::size_t i = 0; i < 4; ++i) w.edges[i][k] = isTaken > 0 ? fresh[i] : w.edges[i][k];
    w.thickness[k] = isTaken > 0 ? thickness : w.thickness[k];
  });
}

/// Returns the lanes of `w.groups` that are above the yield surface, after `tryLanes`.
template <YieldConstants::Kind kKind, bool kPlane, bool kNodal, std::size_t W>
[[gnu::always_inline]] inline void returnLanes(const ReturnInput<W>& in, FlowLanes<W>& w) {
  constexpr bool kCone = kKind == YieldConstants::Kind::kCone;
  compareWithLastStep<kPlane, kNodal, kCone>(in, w);
  if constexpr (kCone) {
    flowOnCone<kNodal>(in.c, w);
  } else {
    findStep<kKind>(in.c, in.dt, w);
    if constexpr (kPlane) solveThickness<kKind>(in, w);
    harden(in.c, w);
  }
  shape<kCone>(w);
}

/// The yield stress of metals after the flow, as yieldStress with the same bits.
template <YieldConstants::Kind kKind, std::size_t W>
[[gnu::always_inline]] inline void yieldAfter(const YieldConstants c, FlowLanes<W>& w) {
  using enum YieldConstants::Kind;
  w.groups.forEach([&](std::size_t k) __attribute__((always_inline)) {
    if constexpr (kKind == kLine) {
      w.yield[k] = c.base + c.factor * w.strain[k];
    } else if constexpr (kKind == kCurved) {
      const double relative = (w.temperature[k] - c.startTemperature) / c.range;
      const double heat = std::min(std::max(relative, 0.), 1.);
      const double power = expOf(c.exponent * logOf(c.begin + w.strain[k] / c.unit));
      const double weaker = expOf(c.thermalExponent * logOf(heat));
      const double thermal = 1 - (heat > 0 ? weaker : 0);
      const double yield = (c.base + c.factor * power) * thermal;
      w.thermal[k] = w.step[k] > 0 ? thermal : w.thermal[k];
      w.yield[k] = w.step[k] > 0 ? yield : w.yield[k];
    } else if constexpr (kKind == kAny) {
      w.yield[k] = yieldStress(c.plastic, w.strain[k], w.temperature[k]);
      w.thermal[k] = thermalFactor(c.plastic, w.temperature[k]);
    }
  });
}

}  // namespace yadefrag
