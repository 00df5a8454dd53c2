#pragma once
// Forces of another kind between nodes that contact moves, too: the tractions of cohesive cracks.
// Both are improved in the same sweeps. If the tractions were found before contact and then kept,
// closed faces would be pushed against each other by contact, and their pressure would do work.

#include <cstdint>
#include <span>
#include <vector>

#include "core/ids.hpp"
#include "core/vec2.hpp"

namespace yadefrag {

class CoupledForces {
 public:
  virtual ~CoupledForces() = default;
  static constexpr std::uint32_t kNoGroup = ~std::uint32_t{0};
  /// Number of the group of nodes that these forces connect in this step; kNoGroup: none acts
  /// there.
  [[nodiscard]] virtual std::uint32_t groupOf(NodeId node) const = 0;
  /// Before the sweeps, at `position` (m, by node).
  virtual void begin(std::span<const Vec2> position) = 0;
  /// Contact has moved a node: the forces there must be improved.
  virtual void noteMoved(NodeId node) = 0;
  /// Improves them, which changes positions, and those that this affects by more than `tolerance`
  /// (m). Returns the largest displacement (m).
  virtual double sweep(std::vector<Vec2>& position, double tolerance) = 0;
  /// Sweeps until no force changes any more, except for their own tolerance. Returns the largest
  /// displacement since the begin (m).
  virtual double converge(std::vector<Vec2>& position) = 0;
};

}  // namespace yadefrag
