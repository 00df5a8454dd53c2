#include "collider/error_messages.hpp"

#include <fmt/core.h>

#include <string>

#include "core/errors.hpp"

namespace yadefrag {
namespace {

std::string text(const yade::Vector3r& v) {
  return fmt::format("({:g}, {:g}, {:g})", v[0], v[1], v[2]);
}

}  // namespace

void throwBadPosition(std::size_t id, const yade::Vector3r& position) {
  throw InputError(fmt::format(
      "Body #{} is at {}, which is not finite: the simulation has become unstable (is O.dt too "
      "large?) or the position was set wrongly.",
      id, text(position)));
}

void throwBadRadius(std::size_t id, double radius) {
  throw InputError(fmt::format(
      "Body #{} has an inverted bound: the radius of its sphere is {:g}; it must not be negative.",
      id, radius));
}

void throwBadBound(std::size_t id, const yade::Bound& bound) {
  throw InputError(fmt::format(
      "Body #{} has an inverted bound or one that is not a number: from {} to {}; its shape or its "
      "orientation is wrong.",
      id, text(bound.min), text(bound.max)));
}

void throwTooManyPairs(std::size_t bodies, std::size_t mostPairs, double freeBytes) {
  throw RunError(fmt::format(
      "Of {} bodies more than {} pairs have overlapping bounds; their interactions do not fit into "
      "the {:g} GB of free memory. Many bodies overlap, or they or verletDist are too large for "
      "the "
      "scene or its periodic cell.",
      bodies, mostPairs, freeBytes / 1e9));
}

void throwBadVerletDist(const std::string& collider, double verletDist) {
  throw InputError(
      fmt::format("{}.verletDist is {:g}: it must be a length in m, 0, or minus a multiple of the "
                  "smallest radius.",
                  collider, verletDist));
}

void throwTooLarge(std::size_t id, int axis, double cellSize) {
  throw InputError(fmt::format(
      "Body #{} spans over half of the cell size {:g} (axis={}): Body larger than half of the cell "
      "size encountered. See allowBiggerThanPeriod and Cell.flipFlippable.",
      id, cellSize, axis));
}

}  // namespace yadefrag
