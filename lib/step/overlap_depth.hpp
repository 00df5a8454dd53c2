#pragma once
// How deep bodies are in each other, by their triangles alone: a check of contact that knows
// nothing of surfaces, slaves, masters or flags. Tips that pass each other overlap without a node
// of either inside the other. Costs nothing unless it is asked for.

#include <array>

#include "mesh/model.hpp"

namespace yadefrag {

/// (m) The shortest way that gets two triangles (counter-clockwise) apart; 0 if they are. It is
/// along the normal of one of their sides.
[[nodiscard]] double overlapOf(const std::array<Vec2, 3>& a, const std::array<Vec2, 3>& b);

/// (m) The deepest overlap of any two triangles that share no node; no more than a triangle's
/// height, since it is the triangles that are pushed apart.
[[nodiscard]] double deepestOverlap(const Model& model, int threads = 1);

}  // namespace yadefrag
