#pragma once

#include <array>
#include <cassert>
#include <cstdint>
#include <span>
#include <vector>

#include "core/ids.hpp"
#include "core/vec2.hpp"
#include "mesh/model.hpp"
#include "surface/contact_surface.hpp"

namespace yadefrag {

/// One active: a slave in front of a master, as a row of the step's system (paper fig. 2). The
/// slave S is a sampling point: a node, or the middle between two. The foot M is the point of the
/// master nearest to S, between the master's nodes. S and M move with the nodes beside them by the
/// shape functions h; the displacement of S relative to M is the sum of weight × displacement over
/// all these nodes.
struct ContactRow {
  static constexpr std::uint32_t kNone = 0xffffffff;
  /// Its nodes on a rigid boundary that obeys forces act together, as one part of that body.
  struct RigidPart {
    std::uint32_t mass = kNone;  ///< number of the body, or none
    double weight = 0;           ///< sum of the nodes' weights
    Vec2 lever;                  ///< m, Σ weight × position from the centre of mass, at xⁿ
  };

  EntryId slave;
  EntryId master;
  std::array<NodeId, 5> node;    ///< nodes of the slave, then of the master
  std::array<double, 5> weight;  ///< hᵢ of the slave, −hᵢ of the master (eq. 4, 6, 7)
  int count = 0;
  Vec2 normal;              ///< outward normal of the master, at xⁿ
  double gap = 0;           ///< m, at the predicted positions; negative: penetration
  double toleratedGap = 0;  ///< m, ≤ 0: an overlap older than this contact
  double slip = 0;          ///< m, of the slave along `tangent()` in this step, without contact
  double friction = 0;      ///< tan of the friction angle
  double normalForce = 0;   ///< N, on the slave along the normal
  double tangentForce = 0;  ///< N, on the slave along `tangent()`
  RigidPart rigid;

  [[nodiscard]] Vec2 tangent() const { return {-normal.y, normal.x}; }
  [[nodiscard]] Vec2 force() const { return normalForce * normal + tangentForce * tangent(); }
  void add(const Stencil& stencil, double sign) {
    for (int k = 0; k < stencil.count; ++k) {
      if (stencil.weight[k] == 0) continue;
      assert(count < static_cast<int>(node.size()));
      const auto at = static_cast<std::size_t>(count++);
      node[at] = stencil.node[k];
      weight[at] = sign * stencil.weight[k];
    }
  }
  /// True for a node that moves with the row's rigid part.
  [[nodiscard]] bool isOfRigid(const Nodes& nodes, NodeId at) const {
    return rigid.mass != kNone && nodes.held[at.value] == kHeldXY;
  }
};

/// Σ weight × field over the row's nodes.
template <class Field>
Vec2 relative(const ContactRow& row, const Field& field) {
  Vec2 sum;
  for (int k = 0; k < row.count; ++k) sum += row.weight[k] * field[row.node[k].value];
  return sum;
}

// --- Forces of another kind between nodes that contact moves, too: the tractions of cohesive
// cracks. Both are improved in the same sweeps. If the tractions were found before contact and then
// kept, closed faces would be pushed against each other by contact, and their pressure would do
// work.

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
