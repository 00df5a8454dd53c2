#pragma once
// Forces of the actives that keep slaves out of their masters (paper §2, eq. 3–8).

#include <cstdint>
#include <span>
#include <vector>

#include "contact/box_problem.hpp"
#include "contact/contact_groups.hpp"
#include "contact/contact_row.hpp"
#include "contact/row_sweeps.hpp"
#include "core/footprint.hpp"
#include "core/step_length.hpp"
#include "mesh/model.hpp"

namespace yadefrag {

/// Lagrange: λ ≥ 0, g + Gλ ≥ 0, λ·(g + Gλ) = 0 for the normal forces, with G = Δt² W M⁻¹ Wᵀ; for
/// the tangential ones |τ| ≤ μλ, and no slip where less is enough.
class Lagrange {
 public:
  /// How far the forces of any group are from the solution, and what they took.
  struct Outcome {
    double residual = 0;  ///< of a pivoted group: largest wrong gap or slip, over its largest gap
    double change = 0;  ///< m, of a swept group: largest change of a gap or slip in the last sweep
    int sweeps = 0;     ///< of a swept group
  };
  /// New rows, or the same ones in another order: finds their groups and systems.
  void setRows(std::span<const ContactRow> rows, const Nodes& nodes, const StepLength& step,
               double drag);
  /// Sets the forces of all rows, starting from those they have; groups in which no more than
  /// `tolerance` (m) is `left` keep theirs. `nodes`, `step`, `drag` are those of `setRows`.
  Outcome solve(std::span<ContactRow> rows, const Nodes& nodes, const StepLength& step, double drag,
                double tolerance);
  /// The same in rubble: for all rows by a few sweeps, whatever their groups are, until no gap or
  /// slip changes by more than `change` (m). Needs no `setRows`; returns the last change (m).
  double sweep(std::span<ContactRow> rows, const Nodes& nodes, const StepLength& step, double drag,
               double change);
  /// Room for so many nodes of the model.
  void reserve(std::size_t nodes) { sweeps_.reserve(nodes); }
  /// Without what the solver of a group works with.
  void addTo(Footprint& footprint) const;

 private:
  struct System {
    BoxProblem problem;
    bool isSwept = false;  ///< there is no matrix
    double mostForce = 0;  ///< N, what bounds friction
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
  void assemble(std::span<const ContactRow> rows, const Nodes& nodes, std::size_t group,
                const StepLength& step, double drag);
  void addPair(const ContactRow& a, const ContactRow& b, const RowNode& p, const RowNode& q,
               Vec2 mobile);
  void setGaps(std::span<const ContactRow> rows, Members members, BoxProblem& problem);
  void solveGroup(std::span<ContactRow> rows, Members members, System& system);
  bool boundFriction(std::span<const ContactRow> rows, Members members, System& system,
                     std::span<const double> lambda) const;

  ContactGroups groups_;
  std::vector<System> systems_;  // of the groups; more than there are, to keep their memory
  BoxSolver solver_;
  RowSweeps sweeps_;
  std::vector<MatrixEntry> entries_;
  std::vector<std::uint32_t> normalOf_;   // unknowns of a row, by row
  std::vector<std::uint32_t> tangentOf_;  // the same; empty without friction
  std::vector<double> start_;
};

/// Penalty: each row by itself, the force that would undo `factor` of its penetration in one step.
void penalize(std::span<ContactRow> rows, const Nodes& nodes, const StepLength& step, double drag,
              double factor);

}  // namespace yadefrag
