#pragma once
// The sentences in which the colliders refuse bad input.

#include <cstddef>
#include <string>

#include "abi/yade.hpp"

namespace yadefrag {

[[noreturn]] void complainOfPosition(std::size_t id, const yade::Vector3r& position);
[[noreturn]] void complainOfRadius(std::size_t id, double radius);
[[noreturn]] void complainOfBound(std::size_t id, const yade::Bound& bound);

/// More pairs of bounds overlap than there is memory for.
[[noreturn]] void complainOfPairs(std::size_t bodies, std::size_t mostPairs, double freeBytes);

[[noreturn]] void complainOfVerletDist(const std::string& collider, double verletDist);

/// The body spans more than the cell allows along an axis; YADE's words, for scripts that look for
/// them, with the body in front.
[[noreturn]] void complainOfSize(std::size_t id, int axis, double cellSize);

}  // namespace yadefrag
