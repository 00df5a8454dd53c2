#pragma once
// The return of the lanes of a frictional material, in vector loops.

#include <numbers>

#include "dynamics/cone_return.hpp"
#include "dynamics/yield_lanes.hpp"

namespace yadefrag {

/// What the return of kLanes elements to the cone needs besides `FlowLanes`.
struct alignas(64) ConeLanes {
  double formerMean[kLanes];  ///< Pa, of τ at the last step
  double mean[kLanes];        ///< Pa, of τ after the return
};

/// (Pa) The mean of the last step from the element's own volume, or from `pressure` by local number
/// of the node.
[[gnu::always_inline]] inline void formerMeans(const ElementLanes& e, const double* pressure,
                                               double bulk, const FlowLanes& w, ConeLanes& cone) {
  if (pressure == nullptr) {
#pragma omp simd
    for (std::size_t k = 0; k < kLanes; ++k)
      cone.formerMean[k] = meanStress(w.formerVolume[k], bulk);
    return;
  }
  for (std::size_t k = 0; k < kLanes; ++k)
    cone.formerMean[k] =
        (pressure[e.corner[0][k]] + pressure[e.corner[1][k]] + pressure[e.corner[2][k]]) *
        (1. / 3) * w.formerVolume[k];
}

/// `kNodal`: with the opening that is known, and the mean of `t` before it.
template <bool kNodal>
[[gnu::always_inline]] inline void returnToCone(const Cone c, const SolidModuli m,
                                                const TrialLanes& t, FlowLanes& w, ConeLanes& cone,
                                                FlowedLanes& out) {
  const double perShear = 1 / (2 * m.shear);
#pragma omp simd
  for (std::size_t k = 0; k < kLanes; ++k) {
    const double distortion = w.mises[k] * (1 / std::numbers::sqrt3);
    ConeFlow flowed{};
    double mean = 0;
    const double stiffness = m.bulk * t.volume[k] * t.volume[k];
    const ConeTrial at{distortion, t.mean[k], stiffness, w.size[k]};
    if constexpr (kNodal) {
      mean = t.mean[k] * expOfTiny(-w.opening[k]);
      flowed = {w.opening[k], goneBy(fallAt(c, at, mean), distortion)};
    } else {
      flowed = coneFlow<true>(c, m.shear, at);
      mean = meanAfter<true>(at, flowed.opening);
    }
    const double opening = flowed.opening, squaredStrain = t.squaredMises[k] * (1. / 6);
    const double pull = opening * (cone.formerMean[k] + mean) * perShear;
    const double gone = goneWithoutGain(flowed.gone, squaredStrain, w.paired[k], pull);
    const double slip = distortion * gone * (2 / std::numbers::sqrt3 * perShear);
    const double work = m.shear * coneWork(gone, squaredStrain, w.paired[k], pull);
    out.work[k] = kNodal ? work : std::max(0., work);
    out.strain[k] = w.strain[k] + std::sqrt(slip * slip + 2. / 9 * opening * opening);
    out.kept[k] = 1 - gone;
    const double isWanted = w.over[k] > 0 ? 1 : 0;
    w.gone[k] = gone;
    cone.mean[k] = mean, w.opening[k] = isWanted > 0 ? opening : 0;
    // Each comparison is false for NaN.
    const double squared = gone * gone * t.squaredMises[k] / 9 + opening * opening;
    const double isTiny = squared < tolerance::kTinyFlow * tolerance::kTinyFlow ? isWanted : 0;
    const double isGood = t.squaredMises[k] < tolerance::kSeries ? isTiny : 0;
    w.flows[k] = isGood;
    w.fails[k] = isWanted - isGood;
  }
}

/// As takeFlow.
[[gnu::always_inline]] inline void takeConeFlow(const FlowedLanes& fresh, const ConeLanes& cone,
                                                const double* volume, StateLanes& s, TrialLanes& t,
                                                FlowLanes& w, FlowSums& sums) {
  for (std::size_t i = 0; i < 4; ++i) choose(w.flows, fresh.edges[i], s.edges[i]);
  choose(w.flows, fresh.thickness, s.thickness);
  choose(w.flows, fresh.kept, t.kept);
  choose(w.flows, fresh.strain, w.strain);
  choose(w.flows, cone.mean, t.mean);
  addFlow(fresh, volume, w, sums);
}

}  // namespace yadefrag
