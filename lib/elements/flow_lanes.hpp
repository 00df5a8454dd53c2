#pragma once
// Data of W triangles that yield, in the layout of the vector loops, and loops over groups of them.

#include <algorithm>
#include <cstdint>
#include <type_traits>

#include "elements/element_chunks.hpp"
#include "elements/plastic_return.hpp"

namespace yadefrag {

template <std::size_t W>
struct alignas(64) TrialLanes {
  double zx[W], zy[W], wx[W], wy[W], inverseZ[W], part[W], squared[W], across[W], volume[W];

  [[nodiscard, gnu::always_inline]] ElasticTrial operator[](std::size_t k) const {
    ElasticTrial t;
    t.zx = zx[k], t.zy = zy[k], t.wx = wx[k], t.wy = wy[k], t.inverseZ = inverseZ[k];
    t.part = part[k], t.squared = squared[k], t.across = across[k], t.volume = volume[k];
    return t;
  }
  [[gnu::always_inline]] void set(std::size_t k, const ElasticTrial& t) {
    zx[k] = t.zx, zy[k] = t.zy, wx[k] = t.wx, wy[k] = t.wy, inverseZ[k] = t.inverseZ;
    part[k] = t.part, squared[k] = t.squared, across[k] = t.across, volume[k] = t.volume;
  }
};

/// The groups of W lanes that a loop is for.
template <std::size_t W>
struct LaneGroups {
  static constexpr std::size_t kWidth = std::min(W, kLanes);
  std::uint32_t first[W / kWidth] = {};  ///< first lanes
  std::uint32_t count = 0;

  [[gnu::always_inline]] void add(std::uint32_t group, bool wanted = true) {
    first[count] = group;
    count += wanted ? 1 : 0;
  }
  template <class Work>
  [[gnu::always_inline]] void forEach(const Work& work) const {
    for (std::uint32_t i = 0; i < count; ++i) {
      const std::size_t begin = first[i];
#pragma omp simd
      for (std::size_t k = 0; k < kWidth; ++k) work(begin + k);
    }
  }
  /// Only those with a lane for which `isWanted`.
  template <class Test>
  [[nodiscard, gnu::always_inline]] LaneGroups with(const Test& isWanted) const {
    LaneGroups some;
    for (std::uint32_t i = 0; i < count; ++i) {
      int found = 0;
      for (std::size_t k = 0; k < kWidth; ++k) found += isWanted(first[i] + k) ? 1 : 0;
      some.add(first[i], found > 0);
    }
    return some;
  }
};

/// W triangles: their state, which flow replaces, and values of the return. `thickness` is the
/// elastic stretch across the plane: the state's, with an axis times the stretch along the circle.
template <std::size_t W>
struct alignas(64) FlowLanes {
  LaneGroups<W> groups;
  double edges[4][W], thickness[W], strain[W], temperature[W];
  double yield[W];            ///< Pa, in slow flow
  double thermal[W];          ///< part of it that the temperature leaves
  double formerThickness[W];  ///< elastic stretch across the plane at the last step
  TrialLanes<W> trial;
  double stretch[W];                      ///< λ of the trial
  double size[W];                         ///< det F, of a cone
  double pressure[W], formerPressure[W];  ///< Pa, means of U'(J) at the nodes
  double over[W];                         ///< above 0 if the lane flows
  double mean[W];                         ///< Pa, of τ
  double kept[W];                         ///< part of the trial's deviator that remains
  double opening[W];                      ///< volume strain of the flow on a cone
  double work[W];                         ///< J/m³
  double steep[W];                        ///< 1/m², largest |∇N|²

  double mises[W];           ///< Pa, of the trial
  double former[W];          ///< Pa, von Mises' stress of the last step
  double formerMean[W];      ///< Pa, of τ at the last step
  double paired[W];          ///< e:e' of the trial and of the last step
  double rare[W];            ///< above 0 if the lane is computed alone
  double step[W];            ///< Δp
  double low[W], high[W];    ///< between which it is
  double change[W];          ///< its last change, relative
  double slow[W], slope[W];  ///< Pa, Y₀ and its derivative
  double gone[W];            ///< part of the trial's deviator that flow takes away

  [[nodiscard]] YieldPoint point(std::size_t k) const {
    YieldPoint at;
    at.edges = {edges[0][k], edges[1][k], edges[2][k], edges[3][k]};
    at.thickness = thickness[k], at.strain = strain[k], at.temperature = temperature[k];
    return at;
  }
  /// `run(k, isAlone)` for all lanes, then alone for those that flow and that it has marked.
  template <class Run>
  [[gnu::always_inline]] void forAnySize(const Run& run) const {
    if constexpr (W == 1) {
      run(0, std::true_type{});
      return;
    }
    groups.forEach([&](std::size_t k)
                       __attribute__((always_inline)) { run(k, std::false_type{}); });
    const auto isRare = [&](std::size_t k) __attribute__((always_inline)) { return rare[k] > 0; };
    if (const LaneGroups<W> left = groups.with(isRare); left.count > 0) runAlone(left, run);
  }

 private:
  /// Compiled once for all instruction sets.
  template <class Run>
  [[gnu::noinline]] void runAlone(const LaneGroups<W>& left, const Run& run) const {
    left.forEach([&](std::size_t k) {
      if (rare[k] > 0) run(k, std::true_type{});
    });
  }
};

}  // namespace yadefrag
