#include "collider/error_messages.hpp"

#include <sstream>

#include "core/errors.hpp"

namespace yadefrag {
namespace {

std::ostream& operator<<(std::ostream& out, const yade::Vector3r& v) {
  return out << '(' << v[0] << ", " << v[1] << ", " << v[2] << ')';
}

}  // namespace

void throwBadPosition(std::size_t id, const yade::Vector3r& position) {
  std::ostringstream text;
  text << "Body #" << id << " is at " << position
       << ", which is not finite: the simulation has become unstable (is O.dt too large?) or the "
          "position was set wrongly.";
  throw InputError(text.str());
}

void throwBadRadius(std::size_t id, double radius) {
  std::ostringstream text;
  text << "Body #" << id << " has an inverted bound: the radius of its sphere is " << radius
       << "; it must not be negative.";
  throw InputError(text.str());
}

void throwBadBound(std::size_t id, const yade::Bound& bound) {
  std::ostringstream text;
  text << "Body #" << id << " has an inverted bound or one that is not a number: from " << bound.min
       << " to " << bound.max << "; its shape or its orientation is wrong.";
  throw InputError(text.str());
}

void throwTooManyPairs(std::size_t bodies, std::size_t mostPairs, double freeBytes) {
  std::ostringstream text;
  text << "Of " << bodies << " bodies more than " << mostPairs
       << " pairs have overlapping bounds; their interactions do not fit into the "
       << freeBytes / 1e9
       << " GB of free memory. Many bodies overlap, or they or verletDist are too "
          "large for the scene or its periodic cell.";
  throw RunError(text.str());
}

void throwBadVerletDist(const std::string& collider, double verletDist) {
  std::ostringstream text;
  text << collider << ".verletDist is " << verletDist
       << ": it must be a length in m, 0, or minus a multiple of the smallest radius.";
  throw InputError(text.str());
}

void throwTooLarge(std::size_t id, int axis, double cellSize) {
  std::ostringstream text;
  text << "Body #" << id << " spans over half of the cell size " << cellSize << " (axis=" << axis
       << "): Body larger than half of the cell size encountered. See allowBiggerThanPeriod and "
          "Cell.flipFlippable.";
  throw InputError(text.str());
}

}  // namespace yadefrag
