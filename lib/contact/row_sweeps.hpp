#pragma once
// Contact forces of rubble, by sweeps from row to row (nonlinear block Gauss–Seidel of Moreau and
// Jean's contact dynamics), without a matrix: every row sees the displacements that the others have
// given to its nodes so far.
//
// With both faces of every crack, each row shares nodes with a dozen others, many say the same, and
// bounds of friction change with every normal force. The exact solves for given bounds then take a
// hundred times longer, and where pieces jam they grow forces that cancel each other, which
// friction turns into energy. Sweeps that start from the last step's forces stay near them; what
// they leave is a gap of the next step.

#include <array>
#include <span>
#include <vector>

#include "contact/contact_row.hpp"
#include "mesh/model.hpp"

namespace yadefrag {

class RowSweeps {
 public:
  /// Improves the forces of all rows until no gap or slip changes by more than `tolerance` (m) in a
  /// sweep, or for kRowSweeps sweeps; returns the last change (m).
  double solve(std::span<ContactRow> rows, const Nodes& nodes, double dt, double drag,
               double tolerance);

 private:
  /// What a row's forces do to its nodes.
  struct Response {
    std::array<Vec2, 5> perNormal, perTangent;  // m/N, by node of the row
    double normal, tangent;                     // m/N: what 1 N undoes of gap and slip
    Vec2 along;                                 // the row's tangent
  };

  void begin(std::span<const ContactRow> rows, const Nodes& nodes, double dt, double drag);
  double relax(ContactRow& row, const Response& response);
  void push(const ContactRow& row, const std::array<Vec2, 5>& perForce, double force);

  std::vector<Response> responses_;
  std::vector<Vec2> displacement_;  // m, by node; of nodes of rows only
};

}  // namespace yadefrag
