#pragma once
// Common code of the vector loops over elements: copies nodal values to lanes and back, and
// collects the lanes with findings.

#include <algorithm>
#include <array>
#include <cstdint>
#include <vector>

#include "core/lanes.hpp"
#include "core/tolerances/dynamics.hpp"
#include "core/vec2.hpp"
#include "elements/elastic_law.hpp"
#include "elements/element_chunks.hpp"
#include "elements/element_kernel.hpp"

namespace yadefrag {

/// Coordinates, then forces, of the corners of W elements.
template <std::size_t W>
struct alignas(64) Corners {
  double x[3][W];
  double y[3][W];

  /// F from the edges and D⁻¹ by rows.
  [[nodiscard, gnu::always_inline]] Matrix2 gradient(const double (&inverse)[4][W],
                                                     std::size_t k) const {
    return deformationGradient(x[1][k] - x[0][k], y[1][k] - y[0][k], x[2][k] - x[0][k],
                               y[2][k] - y[0][k], inverse[0][k], inverse[1][k], inverse[2][k],
                               inverse[3][k]);
  }
  [[nodiscard, gnu::always_inline]] double twiceArea(std::size_t k) const {
    return (x[1][k] - x[0][k]) * (y[2][k] - y[0][k]) - (y[1][k] - y[0][k]) * (x[2][k] - x[0][k]);
  }
  /// The forces on the second and the third corner, and the opposite one on the first.
  [[gnu::always_inline]] void setForces(std::size_t k, double f1x, double f1y, double f2x,
                                        double f2y) {
    x[0][k] = -(f1x + f2x);
    y[0][k] = -(f1y + f2y);
    x[1][k] = f1x;
    y[1][k] = f1y;
    x[2][k] = f2x;
    y[2][k] = f2y;
  }
  /// Three times the distance of the centroid from the axis.
  [[nodiscard, gnu::always_inline]] double sumOfX(std::size_t k) const {
    return x[0][k] + x[1][k] + x[2][k];
  }
  /// A further force towards the axis on each corner, of the stress along the circle.
  [[gnu::always_inline]] void pullInwards(std::size_t k, double pull) {
    x[0][k] -= pull;
    x[1][k] -= pull;
    x[2][k] -= pull;
  }
};

/// To kLanes elements of the corners, from the one `at` on.
template <std::size_t W>
[[gnu::always_inline]] inline void gather(const ElementLanes& lanes, const Vec2* values,
                                          Corners<W>& corners, std::size_t at = 0) {
  for (int i = 0; i < 3; ++i)
    for (std::size_t k = 0; k < kLanes; ++k) {
      const Vec2 value = values[lanes.corner[i][k]];
      corners.x[i][at + k] = value.x;
      corners.y[i][at + k] = value.y;
    }
}

template <std::size_t W>
[[gnu::always_inline]] inline void scatter(const ElementLanes& lanes, const Corners<W>& corners,
                                           Vec2* force, std::size_t at = 0) {
  for (std::size_t k = 0; k < kLanes; ++k)
    for (int i = 0; i < 3; ++i) {
      Vec2& f = force[lanes.corner[i][k]];
      f.x += corners.x[i][at + k];
      f.y += corners.y[i][at + k];
    }
}

/// Number of flat and of stressed elements among kLanes.
struct Findings {
  int flat = 0, stressed = 0;
};

/// Numbers of the lanes that contain a stressed element.
struct StressedLanes {
  std::array<std::uint32_t, tolerance::kChunkElements / kLanes> lanes;
  std::size_t count = 0;

  /// Without a branch: an entry that is not counted is overwritten by the next one.
  [[gnu::always_inline]] void note(std::uint32_t lane, int stressed) {
    lanes[count] = lane;
    count += stressed != 0 ? 1 : 0;
  }

  void appendTo(std::vector<ElementRange>& ranges, const Chunk& chunk) const {
    for (std::size_t i = 0; i < count; ++i) {
      const auto first =
          static_cast<std::uint32_t>(chunk.firstElement + kLanes * (lanes[i] - chunk.firstLanes));
      const auto end = static_cast<std::uint32_t>(first + kLanes);
      ranges.push_back({first, std::min(end, chunk.lastElement)});
    }
  }
};

/// Calls `work(l, corners)`, which must be always inlined, for each index l of the chunk's lanes,
/// and records those with a stressed element if `kWatched`. Returns false if an element is flat.
template <bool kWatched, class Work>
[[gnu::always_inline]] inline bool forEachLanes(const Chunk& chunk, const ElementLanes* lanes,
                                                const Vec2* position, StressedLanes& stressed,
                                                const Work& work) {
  int flat = 0;
  Corners<kLanes> corners;
  for (std::uint32_t l = chunk.firstLanes; l < chunk.lastLanes; ++l) {
    gather(lanes[l], position, corners);
    const Findings found = work(l, corners);
    flat += found.flat;
    if constexpr (kWatched) stressed.note(l, found.stressed);
  }
  return flat == 0;
}

}  // namespace yadefrag
