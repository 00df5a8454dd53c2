#pragma once
// Spheres that are where a body is: contact gives them the energy of that overlap, or, from inside,
// does not find them.

#include <array>
#include <cstddef>
#include <optional>
#include <span>

#include "core/vec2.hpp"
#include "yade/yade.hpp"

namespace yadefrag {

struct SphereOverlap {
  yade::Body::id_t sphere;
  double depth;   ///< m; that of the centre or less, if the centre is inside
  double radius;  ///< m
};

/// The sphere that overlaps the triangles most, relative to its radius, of those from number
/// `first` on that share a bit of `mask`; none if no overlap is more than `tolerated` (of the
/// radius).
std::optional<SphereOverlap> deepestOverlap(const yade::Scene& scene, std::size_t first,
                                            yade::mask_t mask,
                                            std::span<const std::array<Vec2, 3>> triangles,
                                            double tolerated);

}  // namespace yadefrag
