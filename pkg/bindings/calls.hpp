#pragma once
// How functions that Python calls begin and end: locks, and exceptions for Python.

#include <algorithm>
#include <cstdint>
#include <mutex>
#include <span>
#include <stdexcept>
#include <vector>

#include "core/errors.hpp"
#include "meshing/triangulate.hpp"
#include "solver/fe_solver.hpp"
#include "step/world.hpp"
#include "yade/running.hpp"
#include "yade/yade.hpp"

namespace yadefrag {

/// Runs `work`, and converts an InputError to Python's ValueError.
template <class Work>
auto asValueError(Work&& work) {
  try {
    return work();
  } catch (const InputError& error) {
    throw std::invalid_argument(error.what());
  }
}

/// Runs `work`, which changes the scene, between two steps.
template <class Work>
auto change(const FESolver& solver, Work&& work) {
  requirePaused();
  const std::lock_guard guard(solver.betweenSteps());
  return asValueError(work);
}

/// A call that waits for the end of a step if another thread runs the scene.
template <auto call>
struct Locked;
template <class Value, class Solver, class... Rest, Value (*function)(Solver&, Rest...)>
struct Locked<function> {
  static Value call(Solver& self, Rest... rest) {
    const std::lock_guard guard(self.betweenSteps());
    return function(self, rest...);
  }
};

// --- The nodes that a script can access: all except those of rigid boundaries, numbered without
// these.

class ShownNodes {
 public:
  explicit ShownNodes(const World& world)
      : hidden_(world.rigidNodes()), count_(world.model.nodes.size() - hidden_.size()) {}

  [[nodiscard]] std::size_t size() const { return count_; }

  /// Rows of the nodes that are shown, from a column by node.
  template <class Value>
  [[nodiscard]] std::vector<Value> rows(std::vector<Value> column) const {
    auto next = hidden_.begin();
    std::size_t kept = 0;
    for (std::size_t n = 0; n < column.size(); ++n) {
      if (next != hidden_.end() && next->value == n) {
        ++next;
        continue;
      }
      column[kept++] = column[n];
    }
    column.resize(kept);
    return column;
  }
  /// A column by node from one by shown node; other nodes have `Value()`.
  template <class Value>
  [[nodiscard]] std::vector<Value> column(std::vector<Value> rows) const {
    if (rows.size() != count_) return rows;  // wrong length: refused later
    for (const NodeId node : hidden_) rows.insert(rows.begin() + node.value, Value());
    return rows;
  }

  [[nodiscard]] NodeId number(NodeId node) const {
    const auto before = std::ranges::lower_bound(hidden_, node) - hidden_.begin();
    return NodeId(node.value - static_cast<std::size_t>(before));
  }
  /// Node numbers as used in scripts.
  [[nodiscard]] std::vector<NodeId> nodes(std::vector<NodeId> numbers) const {
    if (hidden_.empty()) return numbers;
    for (NodeId& node : numbers)
      for (const NodeId hidden : hidden_) {
        if (hidden > node) break;
        node = NodeId(node.value + 1);
      }
    return numbers;
  }

 private:
  const std::vector<NodeId>& hidden_;
  std::size_t count_;
};

// --- The mesh of a body that is not added yet, for Python.

/// `yadefrag.Mesh`: the mesh of a body that is not added yet.
struct ScriptMesh : PolygonMesh {
  std::size_t numJoints = 0;         ///< lines given, also those outside of the polygon
  std::vector<std::uint8_t> smooth;  ///< by node: on a C¹-smooth part of the boundary; empty: none
};
using SharedMesh = yade::shared_ptr<ScriptMesh>;

/// Outline and holes from arrays of their points.
Polygon polygonOf(const yade::py::object& outline, const yade::py::list& holes);

}  // namespace yadefrag
