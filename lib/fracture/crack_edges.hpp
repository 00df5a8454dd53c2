#pragma once
// The edges along which brittle bodies may crack, and how their triangles hang together across
// them.
//
//   An edge that has cracked separates its two triangles. The triangles around a node that hang
//   together across edges which have not are its fan: a ring, or a row between two faces.

#include <array>
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

/// Corner `corner` of a triangle, counted around.
inline constexpr std::uint8_t afterCorner(int corner) {
  return static_cast<std::uint8_t>(corner == 2 ? 0 : corner + 1);
}
inline constexpr std::uint8_t beforeCorner(int corner) {
  return static_cast<std::uint8_t>(corner == 0 ? 2 : corner - 1);
}

/// A side with its two nodes, the lower one first: two triangles side by side have equal ones.
struct KeyedSide {
  NodeId low, high;
  Side side;
  friend auto operator<=>(const KeyedSide&, const KeyedSide&) = default;
  [[nodiscard]] bool joins(const KeyedSide& o) const { return low == o.low && high == o.high; }
};

/// All sides of a body's triangles, ascending; dropped triangles have none.
[[nodiscard]] std::vector<KeyedSide> sidesByNodes(const Model& model, const Component& body);

struct CrackEdges {
  // By edge.
  std::vector<std::array<ElementId, 2>> element;    ///< the lower one first
  std::vector<std::array<std::uint8_t, 2>> corner;  ///< of each: where the edge begins in it
  std::vector<double> strength;                     ///< Pa
  std::vector<double> fractureEnergy;               ///< J/m²; 0: a crack opens at once
  std::vector<std::uint8_t> cracked;

  // By triangle and node of the whole model; none() for bodies that do not crack.
  std::vector<std::array<EdgeId, 3>> ofElement;  ///< by corner; none() on the boundary, too
  std::vector<ElementId> ofNode;                 ///< one of its fan

  [[nodiscard]] std::size_t size() const { return element.size(); }

  /// Adds the inner edges of a body that has just joined the model, in the order of its triangles.
  /// Of the values that its two triangles have, by material or in `places`, an edge has the
  /// smaller; it never cracks where both do not. The strength's scatter is about that value; joints
  /// have none. Returns the edges of joints without strength.
  std::vector<EdgeId> addBody(const Model& model, ComponentId component,
                              const BrittlePlaces& places = {});
  /// Adds edges between two bodies, that are cracked already.
  void addBonds(const Model& model, std::span<const std::array<Side, 2>> sides, double ofStrength,
                double ofEnergy);
  [[nodiscard]] bool isBond(const Model& model, EdgeId edge) const {
    const auto& [a, b] = element[edge.value];
    return model.triangles.component[a.value] != model.triangles.component[b.value];
  }
  /// After a body has left the model: what is left is known by new numbers. Returns those of the
  /// edges, none() for edges that are gone.
  std::vector<EdgeId> removeBody(const Model& model, ElementId first, ElementId last,
                                 std::span<const NodeId> renumberedNodes);

  [[nodiscard]] Side side(EdgeId edge, int which) const {
    const auto w = static_cast<std::size_t>(which);
    return {element[edge.value][w], corner[edge.value][w]};
  }
  /// The same edge from the other triangle; none() on the boundary.
  [[nodiscard]] Side twin(Side side) const;
  /// The triangle across a side, none() where there is a face or a crack.
  [[nodiscard]] ElementId across(Side side) const;

  /// Appends a node's fan, counter-clockwise; true if it is a ring.
  bool appendFan(const Model& model, NodeId node, std::vector<ElementId>& fan) const;
};

/// The corner of a triangle at which a node is.
int cornerOf(const Model& model, ElementId element, NodeId node);

/// The node at which a side begins, and that at which it ends.
inline NodeId firstNode(const Model& model, Side side) {
  return model.triangles.nodes[side.element.value][side.corner];
}
inline NodeId lastNode(const Model& model, Side side) {
  return model.triangles.nodes[side.element.value][afterCorner(side.corner)];
}

}  // namespace yadefrag
