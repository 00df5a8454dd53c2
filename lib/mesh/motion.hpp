#pragma once
// Prescribed motions that change in time: a frame that is shifted and turned carries held nodes.
//
// A node is put where the frame has it at the end of each step. With a velocity along the tangent
// instead, which is exact for translations only, a node leaves its circle by (ωΔt)²/2 a step.

#include <cstdint>
#include <vector>

#include "core/time_table.hpp"
#include "core/vec2.hpp"

namespace yadefrag {

struct Motion {
  Vec2 centre = {};                    ///< m, of the turn, at `begin`
  double begin = 0;                    ///< s, when the frame starts
  TimeTable speedX = {}, speedY = {};  ///< m/s, of the centre
  TimeTable turn = {};                 ///< rad/s
  /// A script's own function gives the nodes' velocities, by this number; 0: the tables do.
  std::uint32_t function = 0;

  /// In place of a function's number: a rigid boundary's nodes, which World::rigidVelocities moves.
  static constexpr std::uint32_t kRigid = 0xffffffff;
  [[nodiscard]] bool isScripted() const { return function != 0 && function != kRigid; }
};

/// Where a motion has its frame at one time.
struct MovedFrame {
  Vec2 centre;
  double cosine = 1, sine = 0;

  MovedFrame(const Motion& motion, double time);
  /// `arm`: m, from the centre when the motion began.
  [[nodiscard]] Vec2 place(Vec2 arm) const {
    return centre + Vec2{cosine * arm.x - sine * arm.y, sine * arm.x + cosine * arm.y};
  }
};

/// Motions as plain numbers, for saving.
struct FlatMotions {
  std::vector<std::uint32_t> counts;
  std::vector<double> numbers;
};
[[nodiscard]] FlatMotions flatten(const std::vector<Motion>& motions);
/// False where the numbers cannot be those of motions.
[[nodiscard]] bool unflatten(const FlatMotions& flat, std::vector<Motion>& motions);

}  // namespace yadefrag
