#pragma once
// The couple of a crack's tractions.
//
// Opposite tractions t act on nodes that are apart by the opening o. Unless t is parallel to o,
// they have a moment: with a shear factor, under friction or pressure after a slip, and, of first
// order in the step, for any law, since o is that of the step's begin and t that of its end. The
// law is written in the frame of the crack, which rotates with the faces; the forces that belong to
// it (the derivatives of its energy by the positions) contain a couple on the faces that balances
// this moment. Without it, a free body gains angular momentum (Vossen, Schreurs, van der Sluis and
// Geers 2013, Comput. Methods Appl. Mech. Eng. 254, 146).
//
// The couple is a force on the two nodes at one end, and the opposite force on those at the other
// end, across the line between both. At each end the force is divided in proportion to the masses,
// so that both nodes move alike: the openings do not change.

#include <array>
#include <span>
#include <vector>

#include "core/vec2.hpp"
#include "mesh/model.hpp"

namespace yadefrag {

class FaceCouple {
 public:
  /// `nodes`: both nodes at the first end, then at the other, at `before` (m). `rate`: m/Pa, by
  /// axis, likewise.
  FaceCouple(const std::array<NodeId, 4>& nodes, const std::array<Vec2, 4>& rate,
             std::span<const Vec2> before);

  /// Sets the moment of the tractions, Σ o × t (Pa m), and corrects the positions by its change.
  void balance(std::vector<Vec2>& position, double moment);
  /// Corrects the velocities; `duration`: s, of the step.
  void push(std::vector<Vec2>& velocity, double duration) const;
  /// (N) `area`: m², of each end.
  void addForces(std::vector<Vec2>& forces, double area) const;
  /// (rad/s) Rotation of the line, for velocities by node.
  template <class Velocity>
  [[nodiscard]] double rotation(Velocity velocity) const {
    double sum = 0;
    for (std::size_t i = 0; i < 4; ++i) sum += part_[i] * dot(across_, velocity(nodes_[i]));
    return sum;
  }

 private:
  [[nodiscard]] Vec2 moved(std::size_t i, double moment) const {
    return {rate_[i].x * part_[i] * moment * across_.x, rate_[i].y * part_[i] * moment * across_.y};
  }

  std::array<NodeId, 4> nodes_;
  std::array<Vec2, 4> rate_;
  std::array<double, 4> part_;  // of the force, by node; negative at the first end
  Vec2 across_;                 // 1/m, the unit normal of the line over its length
  double moment_ = 0;           // Pa m
};

}  // namespace yadefrag
