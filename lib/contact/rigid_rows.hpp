#pragma once
// All rows on one rigid body, solved together. From row to row, a light body between two others
// moves back and forth: what a sweep changes is the part that its neighbours give way, and their
// impact is not transmitted. Here the motion p of the body is the unknown (two displacements and
// the rotation, scaled by the roots of mobilities). For a given p the rows do not depend on each
// other, if each node that several rows share is divided among them, which makes it more compliant
// than it is. With the changes p of the motion and λ, τ of the forces,
//
//   λᵢ(p) = −(gᵢ + aᵢ·p)/Dᵢ,  τᵢ(p) = −(hᵢ + bᵢ·p)/Eᵢ,  each within its bounds,  p = Σ aᵢλᵢ + bᵢτᵢ,
//
// where g and h are the gaps and slips so far, and D and E compliances of the row's other nodes.
// That is the minimum of a convex piecewise quadratic function: Newton's method finds it in a few
// iterations (bounds of friction: those of the normal forces before). What the division of nodes
// changes vanishes from sweep to sweep.

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "contact/row_system.hpp"
#include "core/csr.hpp"

namespace yadefrag {

class RigidRows {
 public:
  /// Finds the rows of each body. Must follow each change of the system's rows.
  void index(const RowSystem& system);
  [[nodiscard]] std::size_t bodies() const { return rowsOf_.rows(); }
  /// Numbers of the rows of a body.
  [[nodiscard]] std::span<const std::uint32_t> rowsOf(std::size_t body) const {
    return rowsOf_.row(body);
  }
  /// Sets the forces of a body's rows, and the displacements that they cause; returns the largest
  /// one (m) of the body at a row, or of a row's other nodes.
  double solve(RowSystem& system, std::size_t body);

 private:
  using Motion = std::array<double, 3>;
  /// One force of a row: normal or tangential.
  struct Force {
    Motion lever;        // aᵢ, √m per N: what a unit of it moves the body by
    double compliance;   // Dᵢ, m/N
    double gap;          // gᵢ or hᵢ, m
    double former;       // N, so far
    double least, most;  // N, bounds of the force
    double change;       // N
  };
  struct Residual {
    Motion value;
    double scale;
  };
  void collect(const RowSystem& system, std::size_t body);
  void minimize(Motion& motion);
  Residual residualAt(const Motion& motion);
  double apply(RowSystem& system, std::size_t body, const Motion& motion);

  Csr<std::uint32_t> rowsOf_;
  std::vector<std::uint32_t> bodyOf_;  // by number in the system: its row of `rowsOf_`
  std::vector<std::uint32_t> shares_;  // by number in the system: rows of the body with this node
  std::vector<Force> forces_;          // of one body: normal and tangential of each row
};

}  // namespace yadefrag
