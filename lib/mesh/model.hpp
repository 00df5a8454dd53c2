#pragma once
// All finite-element bodies of a scene: nodes, triangles and components as parallel arrays.

#include <array>
#include <cstdint>
#include <numbers>
#include <string>
#include <vector>

#include "core/columns.hpp"
#include "core/ids.hpp"
#include "core/vec2.hpp"
#include "mesh/body_material.hpp"
#include "mesh/motion.hpp"
#include "mesh/plastic_state.hpp"

namespace yadefrag {

/// Directions in which a node moves at its prescribed velocity, independent of forces.
enum Held : std::uint8_t { kFree = 0, kHeldX = 1, kHeldY = 2, kHeldXY = 3 };

struct Nodes {
  std::vector<Vec2> position;  ///< m, xⁿ
  std::vector<Vec2> velocity;  ///< m/s, vⁿ⁻½; in a held direction: the prescribed one
  /// kg, lumped; 0 for nodes of removed triangles, which are held in both directions.
  std::vector<double> mass;
  std::vector<std::uint8_t> held;  ///< Held
  std::vector<ComponentId> component;
  std::vector<Vec2> load;  ///< N, constant external force; empty if the scene has none
  /// By node: 1 + the index in Model::motions of the motion of a held node; 0: constant velocity.
  /// Empty if the scene has no motions.
  std::vector<std::uint32_t> motion;
  std::vector<Vec2> arm;        ///< m, from the motion's centre at its begin; as long as `motion`
  std::vector<Vec2> reference;  ///< m, stress-free position

  /// All arrays by node (core/columns.hpp), in the order of saved states.
  template <class Self>
  static auto columnsOf(Self& self) {
    return [&self](auto visit) {
      visit(Column{"position"}, self.position);
      visit(Column{"velocity"}, self.velocity);
      visit(Column{"mass"}, self.mass);
      visit(Column{"load", kOptional}, self.load);
      visit(Column{"held"}, self.held);
      visit(Column{"nodeComponent"}, self.component);
      visit(Column{"motion", kOptional}, self.motion);
      visit(Column{"arm", kOptional}, self.arm);
      visit(Column{"reference"}, self.reference);
    };
  }
  auto columns() { return columnsOf(*this); }
  auto columns() const { return columnsOf(*this); }

  [[nodiscard]] std::size_t size() const { return position.size(); }
  /// Adds a node with all values of `node`, but without a mass.
  NodeId duplicate(NodeId node) {
    appendCopy(columns(), node.value);
    mass.back() = 0;
    return NodeId(size() - 1);
  }
};

struct Triangles {
  std::vector<std::array<NodeId, 3>> nodes;  ///< counter-clockwise
  /// (1/m) Inverse of the stress-free edge matrix D = [X₁−X₀, X₂−X₀], row by row: F = d·D⁻¹.
  std::vector<std::array<double, 4>> inverseEdges;
  std::vector<double> area;  ///< m², stress-free; 0: removed
  std::vector<ComponentId> component;
  /// Number of the triangle's material among its body's materials; empty if no body has several.
  std::vector<std::uint32_t> material;
  /// (Pa) Of bodies that do not yield, in plane strain: initial stress across the plane without the
  /// part of that in the plane, Poisson's ratio times (xx + yy). Empty: none.
  std::vector<double> stressAcross;
  /// (m) Stress-free distance of the centroid from the axis, in an axisymmetric scene; empty in a
  /// plane one.
  std::vector<double> radius;
  PlasticState plastic;

  /// All arrays by triangle, likewise.
  template <class Self>
  static auto columnsOf(Self& self) {
    return [&self](auto visit) {
      visit(Column{"triangles"}, self.nodes);
      visit(Column{"inverseEdges"}, self.inverseEdges);
      visit(Column{"area"}, self.area);
      visit(Column{"triangleComponent"}, self.component);
      visit(Column{"triangleMaterial", kOptional}, self.material);
      visit(Column{"stressAcross", kOptional}, self.stressAcross);
      visit(Column{"radius", kOptional}, self.radius);
      PlasticState::columnsOf(self.plastic)(visit);
    };
  }
  auto columns() { return columnsOf(*this); }
  auto columns() const { return columnsOf(*this); }

  [[nodiscard]] std::size_t size() const { return nodes.size(); }
  /// A removed ("dropped") triangle keeps its number and its nodes, but takes part in nothing.
  [[nodiscard]] bool isDropped(std::size_t element) const { return area[element] == 0; }
};

/// Computation of forces from the strains of a body's triangles (elements/smoothed_law.hpp).
enum class ElementKind : std::uint8_t {
  kLinear,    ///< constant strain in each triangle
  kSmoothed,  ///< strains averaged at the nodes
};

/// Properties common to all triangles of one body: its material, or the bound of several materials
/// (`boundOf`). A removed component keeps its slot, without triangles.
struct Component : BodyMaterial {
  double thickness = 1;         ///< m
  bool brittleByPlace = false;  ///< its edges have individual strengths or energies
  bool selfContact = true;      ///< its surfaces may touch each other
  bool rigid = false;           ///< a boundary without triangles, whose nodes are held
  ElementKind element = ElementKind::kLinear;
  std::uint32_t firstTriangle = 0;
  std::uint32_t lastTriangle = 0;   ///< one past the last; triangles of a component are consecutive
  std::uint32_t firstMaterial = 0;  ///< in Model::materials, if it has several
  std::uint32_t lastMaterial = 0;   ///< one past the last
  std::string name = {};            ///< given by a script, or empty

  [[nodiscard]] bool yields() const { return plastic.yields(); }
  [[nodiscard]] bool fails() const { return plastic.fails(); }
  /// True: it yields, and its volume strain is averaged at the nodes. In plane stress the thickness
  /// is free to change, so that nothing locks.
  [[nodiscard]] bool averagesVolume() const {
    return yields() && element == ElementKind::kSmoothed && !material.planeStress;
  }
  [[nodiscard]] bool isMixed() const { return firstMaterial != lastMaterial; }
};

struct Model {
  Nodes nodes;
  Triangles triangles;
  std::vector<Component> components;
  std::vector<BodyMaterial> materials;  ///< of bodies with several, body by body
  std::vector<Motion> motions;          ///< motions of held nodes
  /// True: x is the distance from the axis, y the place along it; masses, forces and energies are
  /// those of a full turn. It changes only without bodies.
  bool axisymmetric = false;

  [[nodiscard]] const Component& bodyOf(ElementId element) const {
    return components[triangles.component[element.value].value];
  }
  [[nodiscard]] const BodyMaterial& materialOf(ElementId element) const {
    const Component& body = bodyOf(element);
    if (!body.isMixed()) return body;
    return materials[body.firstMaterial + triangles.material[element.value]];
  }
  /// (m) Extent of a triangle across the plane: the body's thickness, or the circle of its
  /// stress-free centroid, with which an area has its exact volume (Pappus).
  [[nodiscard]] double depthOf(ElementId element) const {
    if (axisymmetric) return 2 * std::numbers::pi * triangles.radius[element.value];
    return bodyOf(element).thickness;
  }
  /// True for a node of the axis, which moves along it only.
  [[nodiscard]] bool isOnAxis(NodeId node) const {
    return axisymmetric && nodes.reference[node.value].x == 0;
  }
  /// (m) The same of a side between two places of its body.
  [[nodiscard]] double depthOf(const Component& body, Vec2 a, Vec2 b) const {
    return axisymmetric ? std::numbers::pi * (a.x + b.x) : body.thickness;
  }
  /// Three times a corner's part of the triangle's mass: 1 in the plane. With an axis it is that of
  /// the integral of Nᵢ over the volume, so that waves along the axis are plane at all radii;
  /// thirds make the nodes on the axis heavier by a third.
  [[nodiscard]] double massShare(ElementId element, std::size_t corner) const {
    if (!axisymmetric) return 1;
    const auto& corners = triangles.nodes[element.value];
    const auto x = [&](std::size_t i) { return nodes.reference[corners[i].value].x; };
    const double sum = x(0) + x(1) + x(2);
    return .75 * (1 + x(corner) / sum);
  }
};

/// (1/kg) Acceleration per force on a node, by direction; 0 in a held direction (infinite mass).
/// `drag` is αΔt/2 of the mass-proportional damping, which also acts on the new velocity.
inline Vec2 mobility(const Nodes& nodes, NodeId node, double drag) {
  const double free = 1 / (nodes.mass[node.value] * (1 + drag));
  const std::uint8_t held = nodes.held[node.value];
  return {(held & kHeldX) != 0 ? 0 : free, (held & kHeldY) != 0 ? 0 : free};
}

}  // namespace yadefrag
