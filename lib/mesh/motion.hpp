#pragma once
// Prescribed motions of nodes, and tables in time.

#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/vec2.hpp"

namespace yadefrag {

// --- A piecewise linear function of time, constant before its first time and after its last.

class TimeTable {
 public:
  TimeTable() = default;
  explicit TimeTable(double constant) : TimeTable({0}, {constant}) {}
  /// `times` (s), ascending; one value for each.
  TimeTable(std::vector<double> times, std::vector<double> values);

  /// True if there is at least one value, as many values as times, all are finite, and the times
  /// ascend.
  [[nodiscard]] static bool isValid(const std::vector<double>& times,
                                    const std::vector<double>& values);

  [[nodiscard]] const std::vector<double>& times() const { return times_; }
  [[nodiscard]] const std::vector<double>& values() const { return values_; }

  /// 0 for a table without values.
  [[nodiscard]] double at(double time) const;
  /// Exact, except for rounding.
  [[nodiscard]] double integral(double from, double to) const;

 private:
  [[nodiscard]] std::size_t after(double time) const;
  [[nodiscard]] double sumUpTo(double time) const;

  std::vector<double> times_, values_;
  std::vector<double> sums_;  // integral from the first time to each time
};

// --- Prescribed motions that vary with time. Held nodes move with a frame that is translated and
// rotated.
//
// At the end of each step a node is put at its position in the frame. If it moved with a velocity
// along the tangent, which is exact for translations only, it would leave its circle by (ωΔt)²/2
// per step.

struct Motion {
  Vec2 centre = {};                    ///< m, centre of rotation at `begin`
  double begin = 0;                    ///< s, start of the motion
  TimeTable speedX = {}, speedY = {};  ///< m/s, velocity of the centre
  TimeTable turn = {};                 ///< rad/s, angular velocity
  /// Number of a script's function that returns the nodes' velocities; 0: the tables determine the
  /// motion.
  std::uint32_t function = 0;

  /// Instead of a function's number: nodes of a rigid boundary, which World::rigidVelocities moves.
  static constexpr std::uint32_t kRigid = 0xffffffff;
  [[nodiscard]] bool isScripted() const { return function != 0 && function != kRigid; }
};

/// Position and rotation of a motion's frame at one time.
struct MovedFrame {
  Vec2 centre;
  double cosine = 1, sine = 0;

  MovedFrame(const Motion& motion, double time);
  /// `arm`: m, from the motion's centre at its begin.
  [[nodiscard]] Vec2 place(Vec2 arm) const {
    return centre + Vec2{cosine * arm.x - sine * arm.y, sine * arm.x + cosine * arm.y};
  }
};

/// Motions as plain numbers, for saved files.
struct FlatMotions {
  std::vector<std::uint32_t> counts;
  std::vector<double> numbers;
};
[[nodiscard]] FlatMotions flatten(const std::vector<Motion>& motions);
/// Returns false if the numbers cannot be those of motions.
[[nodiscard]] bool unflatten(const FlatMotions& flat, std::vector<Motion>& motions);

}  // namespace yadefrag
