#pragma once
// Depth of overlaps between bodies, from their triangles only: a check of contact that is
// independent of surfaces, slaves and masters. Tips that pass each other overlap without a
// node of one inside the other. No cost unless it is called.

#include <array>
#include <cstdint>
#include <span>

#include "mesh/model.hpp"

namespace yadefrag {

/// (m) The shortest translation that separates two triangles (counter-clockwise); 0 if they do not
/// overlap. It is along the normal of one of their sides.
[[nodiscard]] double overlapOf(const std::array<Vec2, 3>& a, const std::array<Vec2, 3>& b);

/// (m) The deepest overlap of any two triangles without a common node; at most a triangle's height,
/// since the triangles are separated one by one.
[[nodiscard]] double deepestOverlap(const Model& model, int threads = 1);
/// The same of the triangles with a node that `among` marks, by node.
[[nodiscard]] double deepestOverlap(const Model& model, std::span<const std::uint8_t> among,
                                    int threads = 1);

}  // namespace yadefrag
