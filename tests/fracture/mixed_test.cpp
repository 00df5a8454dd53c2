// Cracks in bodies of several materials: which edges have whose strength, and where they crack.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "fracture/laboratory.hpp"
#include "step/bodies.hpp"

namespace yadefrag::test {
namespace {

constexpr double kStiff = 10e9, kSoft = 1e9, kRate = 1;      // Pa, Pa, 1/s
constexpr double kLength = .1, kHeight = .04, kSize = 5e-3;  // m

BodyMaterial brittle(double young, double strength, double energy) {
  BodyMaterial one;
  one.material = {young, 0, 1000, true};
  one.brittle.tensileStrength = strength;
  one.brittle.fractureEnergy = energy;
  return one;
}

Vec2 middleOf(const TriangleMesh& mesh, std::size_t triangle) {
  const auto& [a, b, c] = mesh.triangles[triangle];
  return (1. / 3) * (mesh.nodes[a] + mesh.nodes[b] + mesh.nodes[c]);
}

/// A bar that is drawn along x at a constant rate from the start on, so that the strain is even
/// where the layers lie along it.
template <class NumberAt>
BodySpec drawn(const TriangleMesh& mesh, std::vector<BodyMaterial> materials, NumberAt numberAt) {
  BodySpec spec;
  for (const Vec2 node : mesh.nodes) spec.velocity.push_back({kRate * (node.x - kLength / 2), 0});
  hold(spec, mesh, kHeldX, [](Vec2 at) { return at.x < 1e-9 || at.x > kLength - 1e-9; });
  spec.materials.materials = std::move(materials);
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
    spec.materials.ofTriangle.push_back(static_cast<std::uint32_t>(numberAt(middleOf(mesh, t))));
  return spec;
}

TriangleMesh barMesh() {
  return structuredRectangle({0, 0}, {kLength, kHeight}, 20, 8, QuadPattern::kCrossed);
}

int lowerHalf(Vec2 at) { return at.y < kHeight / 2 ? 0 : 1; }
int leftHalf(Vec2 at) { return at.x < kLength / 2 ? 0 : 1; }

std::vector<JointEdge> interfaces(const TriangleMesh& mesh, double strength, double energy,
                                  double atX) {
  std::vector<JointEdge> edges;
  for (const auto& t : mesh.triangles)
    for (std::size_t i = 0; i < 3; ++i) {
      const std::uint32_t a = t[i], b = t[(i + 1) % 3];
      if (a < b && std::abs(mesh.nodes[a].x - atX) < 1e-9 && std::abs(mesh.nodes[b].x - atX) < 1e-9)
        edges.push_back({{a, b}, strength, energy});
    }
  return edges;
}

/// (1) The strain at the first crack, and whose it is: the material of either side, as a set of
/// bits.
struct FirstCrack {
  double strain;
  unsigned materials = 0;
};

FirstCrack firstCrackOf(const BodySpec& spec) {
  World world;
  world.addBody(barMesh(), spec);
  const double dt = .5 * world.criticalTimeStep();
  while (world.fracture.numCracks() == 0 && world.time < .01) world.step(dt);
  FirstCrack first{kRate * world.time, 0};
  for (const CrackLine& crack : cracksOf(world))
    for (const ElementId e : world.fracture.edges.element[crack.edge.value])
      first.materials |= 1U << world.model.triangles.material[e.value];
  return first;
}

// Beside an interface that is pulled along, the stress jumps by the ratio of the stiffnesses. Each
// layer cracks at its own stress: a mean over both would let the soft one crack at a third of its
// strength. What is left is the step in which it is seen, 0.1 %, and waves by the strain's square.
TEST(Mixed, EachLayerCracksAtItsOwnStress) {
  for (const auto& [stiff, soft, whose] : {std::array{4e6, 4e6, 1.}, std::array{40e6, 2e6, 2.}}) {
    const FirstCrack first = firstCrackOf(
        drawn(barMesh(), {brittle(kStiff, stiff, 500), brittle(kSoft, soft, 500)}, lowerHalf));
    const double wanted = std::min(stiff / kStiff, soft / kSoft);
    EXPECT_NEAR(first.strain / wanted, 1, .02);
    EXPECT_EQ(first.materials, static_cast<unsigned>(whose));
  }
}

TEST(Mixed, AnEdgeBetweenTwoMaterialsIsAsTheWeakerOne) {
  BodyMaterial strong = brittle(kStiff, 9e6, 20), weak = brittle(kSoft, 3e6, 70);
  const BodyMaterial never{{kStiff, 0, 1000, true}, {}, .4, {}};
  strong.brittle.shearFactor = 2, weak.brittle.shearFactor = 5;
  const TriangleMesh mesh = barMesh();
  World world;
  const BodySpec spec = drawn(mesh, {strong, weak, never}, [](Vec2 at) {
    return at.x < .04 ? 0 : at.x < .07 ? 1 : 2;
  });
  world.addBody(mesh, spec);
  const CrackEdges& edges = world.fracture.edges;
  const auto strengthOf = [&](std::uint32_t m) {
    return m == 2 ? kUnbreakable : spec.materials.materials[m].brittle.tensileStrength;
  };
  for (std::size_t i = 0; i < edges.size(); ++i) {
    const std::uint32_t a = spec.materials.ofTriangle[edges.element[i][0].value];
    const std::uint32_t b = spec.materials.ofTriangle[edges.element[i][1].value];
    EXPECT_EQ(edges.strength[i], std::min(strengthOf(a), strengthOf(b)));
    const double energy = a == 2 && b == 2 ? 0 : std::min(a, b) == 0 ? 20 : 70;
    EXPECT_EQ(edges.fractureEnergy[i], energy);
  }
  const Component& body = world.model.components[0];
  EXPECT_EQ(body.brittle.tensileStrength, 3e6);
  EXPECT_EQ(body.brittle.shearFactor, 1);
  EXPECT_EQ(body.friction, 0);
}

/// Layers one after the other, and what is between them weaker than either or no brittle body at
/// all: all cracks are there, at that strength, and take that energy.
void checkInterface(std::vector<BodyMaterial> materials) {
  constexpr double kWeak = 1e6, kEnergy = 20;
  const TriangleMesh mesh = barMesh();
  BodySpec spec = drawn(mesh, std::move(materials), leftHalf);
  for (Vec2& v : spec.velocity) v = {};
  // Slowly: the waves of it have a hundredth of the stress that breaks it.
  for (std::size_t n = 0; n < mesh.nodes.size(); ++n)
    spec.velocity[n].x = .01 * (mesh.nodes[n].x - kLength / 2) / kLength * 2;
  spec.places.joints = interfaces(mesh, kWeak, kEnergy, kLength / 2);
  ASSERT_EQ(spec.places.joints.size(), 8U);
  World world;
  world.addBody(mesh, spec);
  world.dynamicsSettings.damping = 1e4;
  const double dt = .5 * world.criticalTimeStep();
  while (world.time < 10e-3 &&
         !(world.fracture.numCracks() > 0 && world.fracture.cohesion.edge.empty())) {
    world.step(dt);
  }
  EXPECT_EQ(world.fracture.numCracks(), 8U);
  for (const CrackLine& crack : cracksOf(world)) EXPECT_NEAR(crack.first.x, kLength / 2, 1e-9);
  // To what steps make of the law's work.
  EXPECT_NEAR(world.ledger.fracture / (kEnergy * kHeight), 1, .01);
}

TEST(Mixed, AWeakInterfaceCracksAlongItself) {
  checkInterface({brittle(kStiff, 5e6, 100), brittle(kSoft, 5e6, 100)});
}

TEST(Mixed, AnInterfaceMayCrackBetweenMaterialsThatDoNot) {
  checkInterface({{{kStiff, 0, 1000, true}, {}, 0, {}}, {{kSoft, 0, 1000, true}, {}, 0, {}}});
}

/// A square with a round inclusion, pulled apart: cracks pass around what is stronger.
World inclusion(double strengthOfInclusion) {
  const Polygon outline{box({0, 0}, {.1, .1}), {}};
  const Loop corners = circle({.05, .05}, .02, 20);
  JointLines lines;
  for (std::size_t k = 0; k < corners.size(); ++k)
    lines.push_back({corners[k], corners[(k + 1) % corners.size()]});
  const TriangleMesh mesh =
      triangulate(outline, 5e-3, {NodeLayout::kScattered, 1}, INFINITY, lines);
  BodySpec spec;
  spec.materials.materials = {brittle(10e9, 3e6, 30), brittle(30e9, strengthOfInclusion, 30)};
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
    spec.materials.ofTriangle.push_back(norm(middleOf(mesh, t) - Vec2{.05, .05}) < .02 ? 1 : 0);
  for (const Vec2 node : mesh.nodes) spec.velocity.push_back({2 * (node.x - .05), 0});
  hold(spec, mesh, kHeldX, [](Vec2 x) { return x.x < 1e-9 || x.x > .1 - 1e-9; });
  World world;
  world.addBody(mesh, spec);
  const double dt = .3 * world.criticalTimeStep();
  while (world.time < 4e-4) world.step(dt);
  return world;
}

std::size_t cracksIn(const World& world, std::uint32_t material) {
  const auto isIn = [&](ElementId e) {
    return world.model.triangles.material[e.value] == material;
  };
  std::size_t count = 0;
  for (const CrackLine& crack : cracksOf(world))
    count += std::ranges::all_of(world.fracture.edges.element[crack.edge.value], isIn) ? 1 : 0;
  return count;
}

TEST(Mixed, CracksPassAroundAStrongInclusionAndThroughAWeakOne) {
  const World strong = inclusion(60e6);
  EXPECT_GT(cracksIn(strong, 0), 10U);
  EXPECT_EQ(cracksIn(strong, 1), 0U);
  const World weak = inclusion(2e6);
  EXPECT_GT(cracksIn(weak, 1), 5U);
}

TEST(Mixed, ImpossibleArgumentsAreRefusedAndTheWorldIsUnchanged) {
  const TriangleMesh mesh = barMesh();
  const BodySpec good = drawn(mesh, {brittle(kStiff, 1e6, 1), brittle(kSoft, 1e6, 1)}, leftHalf);
  BodySpec spec = good;
  spec.element = ElementKind::kSmoothed;
  expectRefused(mesh, spec, "it must be 'linear'");
  spec = good;
  spec.materials.ofTriangle.pop_back();
  expectRefused(mesh, spec, "material has 639 values, but the mesh has 640 triangles");
  spec = good;
  spec.materials.ofTriangle[3] = 2;
  expectRefused(mesh, spec, "material is 2");
  spec = good;
  spec.materials.materials[1].material.density = 0;
  expectRefused(mesh, spec, "density is 0");
}

}  // namespace
}  // namespace yadefrag::test
