#pragma once
// The return of the lanes of a frictional material, in vector loops; the formulas are those of
// returnToCone in plastic_return.cpp.

#include <numbers>

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

/// The flow; `ownPart`: 1 if the work contains all of the opening, 0 if its second half follows.
[[gnu::always_inline]] inline void returnToCone(const Cone c, const SolidModuli m, double ownPart,
                                                const TrialLanes& t, FlowLanes& w, ConeLanes& cone,
                                                FlowedLanes& out) {
  const double by = 1 / (m.shear + m.bulk * c.slope * c.dilation);
#pragma omp simd
  for (std::size_t k = 0; k < kLanes; ++k) {
    const double trial = t.mean[k], distortion = w.mises[k] * (1 / std::numbers::sqrt3);
    const double step = std::max(0., distortion + c.slope * trial - c.strength) * by;
    const double lower = trial - m.bulk * c.dilation * step;
    const double sheared = m.shear * step;
    const double least = std::min(c.limit, trial);
    const double most = std::min(distortion, std::max(0., c.strength - c.slope * least));
    const double isOpen = lower > c.limit ? 1 : 0;
    const double isApex = distortion < sheared ? 1 : isOpen;
    const double mean = isApex > 0 ? least : lower;
    const double remaining = isApex > 0 ? most : std::max(0., distortion - sheared);
    const double ratio = remaining / distortion;
    const double kept = distortion > 0 ? ratio : 1;
    const double opening = logRatio(m.bulk + 2 * trial, m.bulk + 2 * mean) / 2;
    const double gone = 1 - kept;
    const double slip = (distortion - remaining) / (std::numbers::sqrt3 * m.shear);
    out.work[k] = m.shear * gone * (w.paired[k] + kept * t.squaredMises[k] * (1. / 6)) +
                  opening * (cone.formerMean[k] + ownPart * mean) / 2;
    out.strain[k] = w.strain[k] + std::sqrt(slip * slip + 2. / 9 * opening * opening);
    out.kept[k] = kept;
    const double isWanted = w.over[k] > 0 ? 1 : 0;
    w.gone[k] = gone;
    cone.mean[k] = mean, w.opening[k] = isWanted > 0 ? opening : 0;
    // Each comparison is false for NaN.
    const double squared = gone * gone * t.squaredMises[k] / 9 + opening * opening;
    const double isGood = squared < tolerance::kTinyFlow * tolerance::kTinyFlow ? isWanted : 0;
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
