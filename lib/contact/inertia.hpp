#pragma once
// Inertia of all that contact moves: nodes, and rigid boundaries that obey forces. Such a boundary
// has three degrees of freedom, which all rows on it share: the translation and the rotation of its
// body.

#include <algorithm>
#include <cstdint>
#include <span>
#include <vector>

#include "contact/contact_row.hpp"
#include "core/csr.hpp"
#include "core/step_times.hpp"
#include "mesh/model.hpp"

namespace yadefrag {

/// The body of a rigid boundary that obeys forces, in one step.
struct RigidMass {
  Vec2 centre;         ///< m, centre of mass at xⁿ
  Vec2 moved;          ///< m, the same at the end of the step, without contact
  Vec2 mobility;       ///< 1/kg, acceleration per force, by direction; 0 in a blocked one
  double turning = 0;  ///< 1/(kg m²), angular acceleration per moment; 0 if blocked
};

/// All of them, and their boundaries.
struct RigidMasses {
  /// A node of a boundary, and the number of its body.
  struct Member {
    NodeId node;
    std::uint32_t mass;
  };
  std::vector<RigidMass> masses;
  std::vector<Member> members;  ///< by node
  Csr<NodeId> nodesOf;          ///< by body

  /// Follows a change of `masses` or `members`; Contact::correct asserts it.
  void index() {
    fillRows(
        nodesOf, masses.size(), members.size(), [&](std::size_t i) { return members[i].mass; },
        [&](std::size_t i) { return members[i].node; });
  }
  void clear() { masses.clear(), members.clear(), index(); }
  [[nodiscard]] bool empty() const { return masses.empty(); }
  /// The number of a node's body; `ContactRow::kNone` if there is none.
  [[nodiscard]] std::uint32_t of(NodeId node) const {
    const auto at = std::ranges::lower_bound(members, node, {}, &Member::node);
    return at != members.end() && at->node == node ? at->mass : ContactRow::kNone;
  }
};

/// Inertia in a step. Rigid bodies have the numbers after those of the nodes.
struct Inertia {
  const Nodes& nodes;
  StepLength step;
  double drag = 0;  ///< αΔt/2
  std::span<const RigidMass> rigid = {};

  [[nodiscard]] std::size_t size() const { return nodes.size() + rigid.size(); }
  /// (1/kg) Acceleration per force, by direction.
  [[nodiscard]] Vec2 mobilityOf(NodeId number) const {
    if (number.value < nodes.size()) return mobility(nodes, number, drag);
    return rigid[number.value - nodes.size()].mobility;
  }
  /// (1/(kg m²)) Angular acceleration per moment; 0 for nodes.
  [[nodiscard]] double turningOf(NodeId number) const {
    return number.value < nodes.size() ? 0 : rigid[number.value - nodes.size()].turning;
  }
};

/// Σ aᵢ·mobileᵢ·bᵢ over both directions.
inline double weighted(Vec2 a, Vec2 mobile, Vec2 b) {
  return a.x * mobile.x * b.x + a.y * mobile.y * b.y;
}

}  // namespace yadefrag
