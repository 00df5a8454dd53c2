#pragma once
// Scenes of a materials laboratory, on the irregular meshes that brittle bodies get. Bodies whose
// nodes differ along their common sides, for the tests of their bonds.

#include <algorithm>
#include <cmath>
#include <tuple>
#include <vector>

#include "core/checks.hpp"
#include "step/bodies.hpp"

namespace yadefrag::test {

/// Of rock: c = β·ft = 15 MPa, φ = 0.6 rad.
inline BodySpec rock() {
  BodySpec spec = brittle({20e9, .2, 2500, false}, 5e6);
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

/// With a notch from its left side to `tip`, whose mouth is a tenth of an element wide.
inline Polygon plateWithNotch(Vec2 low, Vec2 high, Vec2 tip, double size) {
  const double left = low.x, slit = size / 20;
  const Vec2 mouth{left, tip.y + slit}, otherMouth{left, tip.y - slit};
  return {{low, {high.x, low.y}, high, {left, high.y}, mouth, tip, otherMouth}, {}};
}

/// Nodes at the height `y` (m) of the stress-free shape.
inline std::vector<NodeId> nodesAtHeight(const World& world, double y) {
  return nodesWhere(world.model.nodes, [y](Vec2 x) { return std::abs(x.y - y) < 1e-9; });
}

/// Drawn along x at a constant rate (1/s) from the start on, so that the strain is even; the ends
/// keep their velocities.
inline void draw(BodySpec& spec, const TriangleMesh& mesh, double length, double rate) {
  spec.velocity.clear();
  for (const Vec2 x : mesh.nodes) spec.velocity.push_back({rate * (x.x - length / 2), 0});
  hold(spec, mesh, kHeldX, [=](Vec2 at) { return at.x < 1e-9 || at.x > length - 1e-9; });
}

/// What a refused body is said to be; the world stays empty.
inline void expectRefused(const TriangleMesh& mesh, const BodySpec& spec, const char* part) {
  World world;
  const std::string text = refusalOf([&] { world.addBody(mesh, spec); });
  EXPECT_TRUE(contains(text, part)) << part << ": " << text;
  EXPECT_EQ(world.model.nodes.size(), 0);
  EXPECT_EQ(world.fracture.edges.size(), 0);
}

inline constexpr ElasticMaterial kMaterial{10e9, 0, 1000, true};
inline constexpr double kHeight = .02;  // m
inline const ComponentId kFirst(std::size_t{0}), kSecond(std::size_t{1}), kThird(std::size_t{2});

inline TriangleMesh blockOf(Vec2 low, Vec2 high, double size) {
  const auto parts = [&](double length) {
    return std::max(1, static_cast<int>(std::lround(length / size)));
  };
  return structuredRectangle(low, high, parts(high.x - low.x), parts(high.y - low.y),
                             QuadPattern::kCrossed);
}

inline TriangleMesh barFrom(double begin, double end, int rows) {
  return blockOf({begin, 0}, {end, kHeight}, kHeight / rows);
}

inline BodySpec resting(const TriangleMesh& mesh) { return moving(mesh, kMaterial, {}); }

inline double bondedLength(const World& world) {
  double sum = 0;
  for (const double area : world.fracture.cohesion.area) sum += 2 * area;
  return sum;
}

/// A brick on two half bricks that are shifted by `part` of an element, turned by `angle`.
inline World tJunction(double part, double angle, double upperSize, bool isFree = true) {
  constexpr double size = .01;
  World world;
  const double shift = part * size;
  for (const auto& [low, high, own] : {std::tuple{Vec2{0, 0}, Vec2{.06, .04}, size},
                                       {Vec2{.06, 0}, Vec2{.12, .04}, size},
                                       {Vec2{shift, .04}, Vec2{.12 + shift, .08}, upperSize}}) {
    TriangleMesh mesh = blockOf(low, high, own);
    BodySpec spec = resting(mesh);
    spec.friction = .5;
    for (std::size_t n = 0; n < mesh.nodes.size(); ++n) {
      const Vec2 at = mesh.nodes[n];
      if (isFree) spec.velocity[n] = {-3 * at.y, 5 * at.x};
      mesh.nodes[n] = turnedBy(at, angle);
    }
    world.addBody(mesh, spec);
  }
  return world;
}

}  // namespace yadefrag::test
