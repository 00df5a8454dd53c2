#pragma once
// Forces of the actives that keep slaves out of their masters (paper §2, eq. 3–8).

#include <cstdint>
#include <span>
#include <vector>

#include "contact/box_problem.hpp"
#include "contact/contact_groups.hpp"
#include "contact/contact_row.hpp"
#include "mesh/model.hpp"

namespace yadefrag {

/// Lagrange: λ ≥ 0, g + Gλ ≥ 0, λ·(g + Gλ) = 0 for the normal forces, with G = Δt² W M⁻¹ Wᵀ; for
/// the tangential ones |τ| ≤ μλ, and no slip where less is enough.
class Lagrange {
 public:
  /// Sets the forces of all rows, starting from those they have. Returns the largest residual of
  /// any group, relative to its largest gap.
  double solve(std::span<ContactRow> rows, const Nodes& nodes, double dt, double drag);

 private:
  void numberUnknowns(std::span<const ContactRow> rows, std::span<const std::uint32_t> members);
  void assemble(std::span<const ContactRow> rows, const Nodes& nodes, std::size_t group, double dt,
                double drag);
  void addPair(const ContactRow& a, const ContactRow& b, const RowNode& p, const RowNode& q,
               Vec2 mobile);
  double solveGroup(std::span<ContactRow> rows, std::span<const std::uint32_t> members);
  bool boundFriction(std::span<const ContactRow> rows, std::span<const std::uint32_t> members,
                     std::span<const double> lambda);

  ContactGroups groups_;
  BoxProblem problem_;
  BoxSolver solver_;
  std::vector<MatrixEntry> entries_;
  std::vector<std::uint32_t> normalOf_, tangentOf_;  // unknowns of a row, by row
  std::vector<double> start_;
  double mostForce_ = 0;  // N, what bounds friction in the group at hand
};

/// Penalty: each row by itself, the force that would undo `factor` of its penetration in one step.
void penalize(std::span<ContactRow> rows, const Nodes& nodes, double dt, double drag,
              double factor);

}  // namespace yadefrag
