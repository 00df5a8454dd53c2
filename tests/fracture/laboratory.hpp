#pragma once
// Scenes of a materials laboratory, on the irregular meshes that brittle bodies get.

#include <cmath>
#include <numbers>
#include <vector>

#include "core/sentence.hpp"
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

/// What a refused body is said to be; the world stays empty.
inline void expectRefused(const TriangleMesh& mesh, const BodySpec& spec, const char* part) {
  World world;
  const std::string text = refusalOf([&] { world.addBody(mesh, spec); });
  EXPECT_NE(text.find(part), std::string::npos) << part << ": " << text;
  EXPECT_EQ(world.model.nodes.size(), 0);
  EXPECT_EQ(world.fracture.edges.size(), 0);
}

}  // namespace yadefrag::test
