#pragma once
// Conjugate gradients on the forces within their bounds. They minimise ½λᵀGλ + gᵀλ, with the
// responses of single rows as a preconditioner, up to the first bound that a force reaches, or to a
// direction in which rows contradict each other: which forces are at a bound is decided by the
// sweeps, and rows without a solution are left to them.

#include <vector>

#include "contact/row_system.hpp"

namespace yadefrag {

class RowGradients {
 public:
  /// Once, before threads share the ranges of rows.
  void makeRoom(const RowSystem& system);
  /// Finds what is left of gaps and slips at forces within their bounds; returns the largest (m).
  double findResiduals(const RowSystem& system, RowRange range);
  /// From the residuals found, until none exceeds `tolerance` (m); returns false if a force reaches
  /// a bound before. The nodes of a range are those of no other.
  bool descend(RowSystem& system, RowRange range, double tolerance);

 private:
  /// Normal and tangential part of a row: of a gap and a slip (m), or of two forces (N).
  struct Pair {
    double normal = 0, tangent = 0;
  };

  /// (N m) Second derivative of the quadratic in a direction, and the sum of those of each row
  /// alone.
  struct Curvature {
    double together = 0, alone = 0;
  };

  void turnDirection(RowRange range, double kept);
  Curvature findResponses(const RowSystem& system, RowRange range);
  [[nodiscard]] double scaledSquare(RowRange range) const;
  [[nodiscard]] double stepToBound(const RowSystem& system, RowRange range) const;
  double advance(RowSystem& system, RowRange range, double step);

  // By row; 0 for forces at a bound. Empty before they are needed.
  std::vector<Pair> former_;       // N, forces at the begin
  std::vector<Pair> residual_;     // m, what is left of gap and slip, with the sign of a force
  std::vector<Pair> perResidual_;  // N/m, force that removes it in this row alone
  std::vector<Pair> direction_;    // N
  std::vector<Pair> response_;     // m, to the forces `direction_`
  RowSystem::Motion along_;        // by these forces
};

}  // namespace yadefrag
