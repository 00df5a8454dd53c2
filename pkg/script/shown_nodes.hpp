#pragma once
// The nodes that a script can access: all except those of rigid boundaries, numbered without these.

#include <algorithm>
#include <span>
#include <vector>

#include "step/world.hpp"

namespace yadefrag {

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

}  // namespace yadefrag
