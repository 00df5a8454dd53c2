#include "fracture/cohesion.hpp"

#include <algorithm>

namespace yadefrag {
namespace {

/// Part of the first of two nodes: its mass over that of both. A held node takes all.
double partOf(Vec2 first, Vec2 second) {
  const double here = first.x + first.y, there = second.x + second.y;
  return here + there > 0 ? there / (here + there) : .5;
}

}  // namespace

FaceCouple::FaceCouple(const std::array<NodeId, 4>& nodes, const std::array<Vec2, 4>& rate,
                       std::span<const Vec2> before)
    : nodes_(nodes), rate_(rate) {
  const double first = partOf(rate[0], rate[1]), last = partOf(rate[2], rate[3]);
  part_ = {-first, first - 1, last, 1 - last};
  Vec2 line;
  for (std::size_t i = 0; i < 4; ++i) line += part_[i] * before[nodes[i].value];
  across_ = (-1 / dot(line, line)) * rightOf(line);
}

void FaceCouple::balance(std::vector<Vec2>& position, double moment) {
  for (std::size_t i = 0; i < 4; ++i) position[nodes_[i].value] += moved(i, moment - moment_);
  moment_ = moment;
}

void FaceCouple::push(std::vector<Vec2>& velocity, double duration) const {
  for (std::size_t i = 0; i < 4; ++i)
    velocity[nodes_[i].value] += (1 / duration) * moved(i, moment_);
}

void FaceCouple::addForces(std::vector<Vec2>& forces, double area) const {
  for (std::size_t i = 0; i < 4; ++i)
    forces[nodes_[i].value] += (area * part_[i] * moment_) * across_;
}

}  // namespace yadefrag
