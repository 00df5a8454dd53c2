#pragma once
// The forces of all rows (paper §2, eq. 3–8): λ ≥ 0, g + Gλ ≥ 0, λ·(g + Gλ) = 0 for the normal
// forces, with G = Δt² W M⁻¹ Wᵀ; for the tangential ones |τ| ≤ μλ, and no slip if a smaller force
// is sufficient. (Slip forces −μ sgn(v)|λ| as in eq. 8 would make the system unsymmetric, and the
// sign must be known in advance.)
//
// Sweeps from row to row (nonlinear block Gauss–Seidel of Moreau and Jean's contact dynamics),
// without a matrix: each row uses the displacements of its nodes by the other rows so far. They
// start from the forces of the last step and stay near them. Ten to twenty short sweeps are enough,
// unless rows contradict each other. What remains of an overlap is reduced in later steps.

#include <cstdint>
#include <vector>

#include "contact/contact_row.hpp"
#include "contact/inertia.hpp"
#include "contact/rigid_rows.hpp"
#include "contact/row_system.hpp"

namespace yadefrag {

class RowSweeps {
 public:
  /// Sweeps end when none changes a gap or a slip by more than `change` (m) and kOfFirst of what
  /// the first one changes, or by more than `least` (m), or after `most` sweeps; later, up to
  /// kMostSweeps, while the forces are far from a solution.
  struct Stop {
    double change;
    int most;
    double least = 0;
  };
  /// Must be called before the first row of a step.
  void clear() { system_.clear(); }
  /// A row with its forces of the last step.
  RowSystem::Row& add(const ContactRow& row, const Inertia& inertia) {
    return system_.add(row, inertia);
  }
  /// The last two rows are those of one corner with both sides of a notch: solved together, since
  /// from row to row their forces converge slowly where the notch is shallow.
  void linkLast() { system_.linkLast(); }
  /// Improves the forces of all rows, and those that are coupled to them (`position`: m, by node,
  /// without contact; null without coupled forces); returns the largest change in the last sweep
  /// (m). Then gaps may be set anew: `improve` follows with at most `most` sweeps. `end` is the
  /// last call of a step; it returns the largest displacement of nodes with coupled forces (m).
  double begin(Stop stop, CoupledForces* coupled, std::vector<Vec2>* position);
  void setGap(std::size_t number, double gap);
  void improve(int most);
  double end(CoupledForces* coupled, std::vector<Vec2>* position);

  [[nodiscard]] std::size_t size() const { return system_.rows.size(); }
  /// Number of sweeps of the last solution.
  [[nodiscard]] int sweeps() const { return count_; }
  [[nodiscard]] const RowSystem::Row& row(std::size_t number) const { return system_.rows[number]; }
  /// (m) A row's gap with all forces, above the tolerated one.
  [[nodiscard]] double gapAfter(const RowSystem::Row& row) const {
    return row.gap + dot(system_.relativeMotion(row), row.normal);
  }
  /// (m) Displacement of a node by all forces.
  [[nodiscard]] Vec2 shiftOf(NodeId node) const { return system_.shiftOf(node); }
  /// Reserves memory for this number of nodes of the model.
  void reserve(std::size_t nodes) { system_.numbers.reserve(nodes); }

 private:
  double sweep(int number);
  double solveRigid(std::size_t body, int sweep);
  double relax(RowSystem::Row& row, int sweep);
  double relaxNotch(RowSystem::Row& row, int sweep);
  double setForces(RowSystem::Row& row, double normal, Vec2 moved, int sweep);
  [[nodiscard]] bool isDue(const RowSystem::Row& row, int sweep) const;
  void share(CoupledForces* coupled, const std::vector<Vec2>* position);
  double sweepCoupled(CoupledForces& forces, std::vector<Vec2>& position, int sweep, bool last);

  RowSystem system_;
  RigidRows rigid_;
  int count_ = 0;
  double change_ = 0;           // m, at which the sweeps of this solution end
  std::vector<int> lastMoved_;  // by number of the node: the last sweep that moved it
  /// A node that coupled forces move, too.
  struct SharedNode {
    std::uint32_t number;
    NodeId node;
    Vec2 byOthers = {};   // m, part of the displacement
    Vec2 byContact = {};  // m, the rest, at the last sweep of the other forces
    Vec2 at = {};         // m, position then
    bool isKnown = false;
  };
  std::vector<SharedNode> shared_;
};

}  // namespace yadefrag
