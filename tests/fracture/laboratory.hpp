#pragma once
// Scenes of a materials laboratory, on the irregular meshes that brittle bodies get.

#include <cmath>
#include <numbers>
#include <vector>

#include "step/bodies.hpp"

namespace yadefrag::test {

/// Of rock: c = β·ft = 15 MPa, φ = 0.6 rad.
inline BodySpec rock() {
  BodySpec spec;
  spec.material = {20e9, .2, 2500, false};
  spec.brittle.tensileStrength = 5e6;
  spec.brittle.shearFactor = 3;
  spec.friction = std::tan(.6);
  return spec;
}

/// (Pa) Mohr and Coulomb: σ₁ at failure under the lateral pressure σ₃, both positive in
/// compression.
inline double mohrCoulomb(const BodySpec& spec, double confining) {
  const double c = spec.brittle.shearFactor * spec.brittle.tensileStrength;
  const double s = std::sin(std::atan(spec.friction));
  return (2 * c * std::sqrt(1 - s * s) + confining * (1 + s)) / (1 - s);
}

/// Which mesh, and how fast.
struct Trial {
  double size = 0;  ///< m
  std::uint64_t seed = 1;
  double turned = 0;  ///< °, of the outline as it is meshed
  NodeLayout layout = NodeLayout::kScattered;
  ElementKind element = ElementKind::kLinear;
  double crossings = 100;  ///< of the specimen by a wave, in the time that it is loaded

  [[nodiscard]] TriangleMesh mesh(Polygon polygon) const {
    return turnedMesh(std::move(polygon), size, turned, {layout, seed});
  }
};

/// Nodes at the height `y` (m) of the stress-free shape.
inline std::vector<NodeId> nodesAtHeight(const World& world, double y) {
  return nodesWhere(world.model.nodes, [y](Vec2 x) { return std::abs(x.y - y) < 1e-9; });
}

/// (m) Of the first edge that has cracked, its middle.
inline Vec2 firstCrack(const World& world) {
  const CrackEdges& edges = world.fracture.edges;
  for (std::size_t i = 0; i < edges.size(); ++i) {
    if (edges.cracked[i] == 0) continue;
    const Side side = edges.side(EdgeId(i), 0);
    return .5 * (world.model.nodes.reference[firstNode(world.model, side).value] +
                 world.model.nodes.reference[lastNode(world.model, side).value]);
  }
  return {NAN, NAN};
}

}  // namespace yadefrag::test
