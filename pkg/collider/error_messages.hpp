#pragma once
// Error messages of the colliders.

#include <cstddef>
#include <string>

#include "abi/yade.hpp"

namespace yadefrag {

[[noreturn]] void throwBadPosition(std::size_t id, const yade::Vector3r& position);
[[noreturn]] void throwBadRadius(std::size_t id, double radius);
[[noreturn]] void throwBadBound(std::size_t id, const yade::Bound& bound);

/// More pairs of bounds overlap than fit into the memory.
[[noreturn]] void throwTooManyPairs(std::size_t bodies, std::size_t mostPairs, double freeBytes);

[[noreturn]] void throwBadVerletDist(const std::string& collider, double verletDist);

/// The body is larger along an axis than the cell permits. The message has YADE's text, since
/// scripts may search for it, preceded by the body.
[[noreturn]] void throwTooLarge(std::size_t id, int axis, double cellSize);

}  // namespace yadefrag
