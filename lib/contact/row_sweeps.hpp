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
#include <cstdint>
#include <span>
#include <vector>

#include "contact/contact_row.hpp"
#include "core/footprint.hpp"
#include "core/step_length.hpp"
#include "mesh/model.hpp"

namespace yadefrag {

class RowSweeps {
 public:
  /// Improves the forces of all rows until no gap or slip changes by more than `tolerance` (m) in a
  /// sweep, or for kRowSweeps sweeps; returns the last change (m).
  double solve(std::span<ContactRow> rows, const Nodes& nodes, const StepLength& step, double drag,
               double tolerance);
  /// Room for so many nodes of the model.
  void reserve(std::size_t nodes) { numbers_.reserve(nodes); }
  void addTo(Footprint& footprint) const {
    footprint.add(Use::kFracture, rows_, nodes_, numbers_, displacement_, pushedAt_);
  }

 private:
  /// A row as the sweeps want it: all that they touch, and nothing else.
  struct Lean {
    std::array<std::uint32_t, 5> node;  // among those of all rows
    std::uint32_t count;
    std::array<double, 5> weight;
    std::array<Vec2, 5> perForce;  // m/N, by axis: what a force does to the node
    Vec2 normal;
    double gap, slip, friction;
    double normalResponse, tangentResponse;  // m/N: what 1 N undoes of gap and slip
    double slipPerNormal;                    // m/N: where a node is held in one direction
    double normalForce, tangentForce;        // N
    std::uint64_t looked;                    // when it was relaxed last
  };

  void begin(std::span<const ContactRow> rows, const Nodes& nodes, const StepLength& step,
             double drag);
  std::uint32_t numberOf(NodeId node);
  [[nodiscard]] Vec2 relative(const Lean& row) const;
  void push(const Lean& row, Vec2 force);
  double relax(Lean& row);
  double sweep(bool forwards, double tolerance);
  [[nodiscard]] bool isStale(const Lean& row) const;

  std::vector<Lean> rows_;
  std::vector<NodeId> nodes_;            // of rows
  std::vector<std::uint32_t> numbers_;   // by node: among nodes_; of those only
  std::vector<Vec2> displacement_;       // m, by number
  std::vector<std::uint64_t> pushedAt_;  // by number: when it last moved by more than the tolerance
  std::uint64_t now_ = 0;
};

}  // namespace yadefrag
