#pragma once
// Forces of the actives that prevent penetration (paper §2, eq. 3–8).

#include <cstdint>
#include <span>
#include <vector>

#include "contact/box_problem.hpp"
#include "contact/contact_groups.hpp"
#include "contact/contact_row.hpp"
#include "contact/inertia.hpp"
#include "contact/row_sweeps.hpp"
#include "core/footprint.hpp"

namespace yadefrag {

/// Lagrange: λ ≥ 0, g + Gλ ≥ 0, λ·(g + Gλ) = 0 for the normal forces, with G = Δt² W M⁻¹ Wᵀ; for
/// the tangential ones |τ| ≤ μλ, and no slip if a smaller force is sufficient.
class Lagrange {
 public:
  /// Errors of the solution, and its cost.
  struct Outcome {
    /// Of a pivoted group: largest error of a gap or slip, over its largest gap.
    double residual = 0;
    double change = 0;  ///< m, of a swept group: largest change of a gap or slip in the last sweep
    int sweeps = 0;     ///< of a swept group
  };
  /// Must be called for new rows, or the same ones in another order: determines their groups and
  /// systems.
  void setRows(std::span<const ContactRow> rows, const Inertia& inertia);
  /// Computes the forces of all rows, starting from their present values. Groups without a
  /// penetration (`excess`) above `tolerance` (m) keep their forces. `inertia` as in `setRows`.
  Outcome solve(std::span<ContactRow> rows, const Inertia& inertia, double tolerance);
  /// The same in rubble: all rows are solved by a few sweeps, independently of groups, until no gap
  /// or slip changes by more than `change` (m). Does not need `setRows`; returns the last change
  /// (m).
  double sweep(std::span<ContactRow> rows, const Inertia& inertia, double change,
               Coupling* coupling);
  /// Reserves memory for this number of nodes of the model.
  void reserve(std::size_t nodes) { sweeps_.reserve(nodes); }
  /// Without the memory of the solver of a group.
  void addTo(Footprint& footprint) const;

 private:
  struct System {
    BoxProblem problem;
    bool isSwept = false;  ///< true: solved by sweeps, without a matrix
    double mostForce = 0;  ///< N, largest normal force in friction bounds
    Outcome outcome;
  };
  using Members = std::span<const std::uint32_t>;

  static constexpr std::uint32_t kNone = 0xffffffff;
  /// The unknown of a row's tangential force, kNone without friction.
  [[nodiscard]] std::uint32_t tangentOf(std::uint32_t row) const {
    return tangentOf_.empty() ? kNone : tangentOf_[row];
  }
  [[nodiscard]] bool isSwept(Members members) const;
  std::size_t numberUnknowns(std::span<const ContactRow> rows, Members members);
  void assemble(std::span<const ContactRow> rows, const Inertia& inertia, std::size_t group);
  void addPair(const ContactRow& a, const ContactRow& b, const RowNode& p, const RowNode& q,
               Vec2 mobile, double turning);
  void setGaps(std::span<const ContactRow> rows, Members members, BoxProblem& problem);
  void solveGroup(std::span<ContactRow> rows, Members members, System& system);
  bool boundFriction(std::span<const ContactRow> rows, Members members, System& system,
                     std::span<const double> lambda) const;

  ContactGroups groups_;
  std::vector<System> systems_;  // of the groups; unused ones are kept for their memory
  BoxSolver solver_;
  RowSweeps sweeps_;
  std::vector<MatrixEntry> entries_;
  std::vector<std::uint32_t> normalOf_;   // by row: unknown of its normal force
  std::vector<std::uint32_t> tangentOf_;  // by row: of its tangential force; empty without friction
  std::vector<double> start_;
};

}  // namespace yadefrag
