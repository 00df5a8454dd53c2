#pragma once
// The edges along which brittle bodies may crack, and the connection of triangles across them.
//
//   An edge that has cracked separates its two triangles. The triangles around a node that are
//   connected across edges without a crack are its fan: a ring, or a row between two faces.

#include <algorithm>
#include <array>
#include <cassert>
#include <cstdint>
#include <span>
#include <vector>

#include "core/ids.hpp"
#include "mesh/model.hpp"

namespace yadefrag {

/// The side of a triangle from its corner `corner` to the next one.
struct Side {
  ElementId element;
  std::uint8_t corner;
  friend auto operator<=>(const Side&, const Side&) = default;
};

/// The next corner of a triangle, counter-clockwise.
inline constexpr std::uint8_t afterCorner(int corner) {
  return static_cast<std::uint8_t>(corner == 2 ? 0 : corner + 1);
}
inline constexpr std::uint8_t beforeCorner(int corner) {
  return static_cast<std::uint8_t>(corner == 0 ? 2 : corner - 1);
}

/// A side with its two nodes, the lower one first: sides of two adjacent triangles are equal.
struct KeyedSide {
  NodeId low, high;
  Side side;
  friend auto operator<=>(const KeyedSide&, const KeyedSide&) = default;
  [[nodiscard]] bool joins(const KeyedSide& o) const { return low == o.low && high == o.high; }
};

/// All sides of a body's triangles, ascending; without removed triangles.
[[nodiscard]] std::vector<KeyedSide> sidesByNodes(const Model& model, const Component& body);

/// The corner of a triangle at which a node is.
inline int cornerOf(const Model& model, ElementId element, NodeId node) {
  const auto& nodes = model.triangles.nodes[element.value];
  const int corner = nodes[0] == node ? 0 : nodes[1] == node ? 1 : 2;
  assert(nodes[static_cast<std::size_t>(corner)] == node);
  return corner;
}

struct CrackEdges {
  // By edge.
  std::vector<std::array<ElementId, 2>> element;  ///< both triangles, the lower one first
  /// Of each triangle: the corner at which the edge begins.
  std::vector<std::array<std::uint8_t, 2>> corner;
  std::vector<double> strength;        ///< Pa
  std::vector<double> fractureEnergy;  ///< J/m²; 0: a crack opens at once
  std::vector<std::uint8_t> cracked;

  /// All arrays by edge (core/columns.hpp), in the order of saved states.
  template <class Self>
  static auto columnsOf(Self& self) {
    return [&self](auto visit) {
      visit(Column{"crackElement"}, self.element);
      visit(Column{"crackCorner"}, self.corner);
      visit(Column{"crackStrength"}, self.strength);
      visit(Column{"crackEnergy"}, self.fractureEnergy);
      visit(Column{"cracked"}, self.cracked);
    };
  }
  auto columns() { return columnsOf(*this); }
  auto columns() const { return columnsOf(*this); }

  // By triangle and node of the whole model; none() for bodies that do not crack.
  std::vector<std::array<EdgeId, 3>> ofElement;  ///< by corner; none() on the boundary, too
  std::vector<ElementId> ofNode;                 ///< one triangle of its fan

  [[nodiscard]] std::size_t size() const { return element.size(); }

  /// Adds an edge between two sides, that of the lower triangle first.
  void append(Side a, Side b, double ofStrength, double ofEnergy, bool isCracked);

  /// Adds the inner edges of a body that was just added to the model, in the order of its
  /// triangles. An edge has the smaller of the values of its two triangles, by material or in
  /// `places`; it never cracks if neither triangle does. The scatter of strengths is about that
  /// value; joints have none. Returns the edges of joints without strength.
  std::vector<EdgeId> addBody(const Model& model, ComponentId component,
                              const BrittlePlaces& places = {});
  /// Adds edges between two bodies, which are cracked from the start.
  void addBonds(const Model& model, std::span<const std::array<Side, 2>> sides, double ofStrength,
                double ofEnergy);
  [[nodiscard]] bool isBond(const Model& model, EdgeId edge) const {
    const auto& [a, b] = element[edge.value];
    return model.triangles.component[a.value] != model.triangles.component[b.value];
  }
  /// Follows the removal of a body from the model: changes all numbers. Returns the new numbers of
  /// the edges, none() for removed ones.
  std::vector<EdgeId> removeBody(const Model& model, ElementId first, ElementId last,
                                 std::span<const NodeId> renumberedNodes);

  [[nodiscard]] Side side(EdgeId edge, int which) const {
    const auto w = static_cast<std::size_t>(which);
    return {element[edge.value][w], corner[edge.value][w]};
  }
  /// The other triangle's side at this edge; none() on the boundary.
  [[nodiscard]] Side twin(Side side) const;
  /// The triangle across a side; none() at a face or a crack.
  [[nodiscard]] ElementId across(Side side) const {
    const EdgeId edge = ofElement[side.element.value][side.corner];
    if (edge == EdgeId::none() || cracked[edge.value] != 0) return ElementId::none();
    const auto& both = element[edge.value];
    return both[0] == side.element ? both[1] : both[0];
  }

  /// Appends a node's fan, counter-clockwise; returns true if it is a ring.
  bool appendFan(const Model& model, NodeId node, std::vector<ElementId>& fan) const;

  /// Calls `visit(edge)` for the inner edges at a node, for most of them twice. `fan`: the
  /// triangles there.
  template <class Visit>
  void forEdgesAt(const Model& model, NodeId node, std::span<const ElementId> fan,
                  Visit visit) const {
    for (const ElementId triangle : fan) {
      const int at = cornerOf(model, triangle, node), before = beforeCorner(at);
      for (const int side : {std::min(at, before), std::max(at, before)}) {
        const EdgeId edge = ofElement[triangle.value][static_cast<std::size_t>(side)];
        if (edge != EdgeId::none()) visit(edge);
      }
    }
  }
};

/// The node at which a side begins, and the node at which it ends.
inline NodeId firstNode(const Model& model, Side side) {
  return model.triangles.nodes[side.element.value][side.corner];
}
inline NodeId lastNode(const Model& model, Side side) {
  return model.triangles.nodes[side.element.value][afterCorner(side.corner)];
}

}  // namespace yadefrag
