// Strength and fracture energy that differ by place: closed forms of a bar in tension, and what
// must follow them.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>

#include "core/checks.hpp"
#include "fracture/brittle_checks.hpp"
#include "fracture/laboratory.hpp"
#include "step/bodies.hpp"

namespace yadefrag::test {
namespace {

constexpr ElasticMaterial kMaterial{1e9, 0, 1000, true};
constexpr double kLength = .1, kHeight = .02, kSize = .005, kThickness = .01;  // m
constexpr double kWeak = 1e6, kEnergy = 20;                                    // Pa, J/m²
constexpr double kRate = 1;                                                    // 1/s, of strain

using Field = std::function<double(Vec2)>;

std::vector<double> sampled(const TriangleMesh& mesh, const Field& field) {
  return byTriangle<double>(mesh, field);
}

TriangleMesh barMesh() {
  return structuredRectangle({0, 0}, {kLength, kHeight}, 20, 4, QuadPattern::kCrossed);
}

/// The stress is even: E·rate·t.
BodySpec drawnBar(const TriangleMesh& mesh) {
  BodySpec spec = brittle(kMaterial, 10 * kWeak, 10 * kEnergy);
  draw(spec, mesh, kLength, kRate);
  spec.thickness = kThickness;
  return spec;
}

/// (m) From the section that is to break: a line of sides in the middle of the right half.
double fromSection(Vec2 at) { return std::abs(at.x - .75 * kLength); }

/// Of a bar of so much, weakest along one line; the sides there have triangles with middles a sixth
/// of a size away.
double bandStrength(Vec2 at) {
  return fromSection(at) < 2 * kSize ? kWeak * (1 + fromSection(at) / kSize) : 10 * kWeak;
}
double bandEnergy(Vec2 at) { return fromSection(at) < 2 * kSize ? kEnergy : 10 * kEnergy; }

BodySpec weakBar(const TriangleMesh& mesh) {
  BodySpec spec = drawnBar(mesh);
  spec.places.strength = sampled(mesh, bandStrength);
  spec.places.fractureEnergy = sampled(mesh, bandEnergy);
  return spec;
}

double farthestCrack(const World& world) {
  double farthest = 0;
  for (const CrackLine& crack : cracksOf(world))
    farthest = std::max({farthest, fromSection(crack.first), fromSection(crack.last)});
  return farthest;
}

TEST(Places, ABarBreaksInItsWeakBandAtTheBandsStrengthAndTakesTheBandsEnergy) {
  World world;
  const TriangleMesh mesh = barMesh();
  world.addBody(mesh, weakBar(mesh));
  const double dt = .5 * world.criticalTimeStep();
  while (world.fracture.numCracks() == 0 && world.time < .01) world.step(dt);
  const double wanted = kWeak * (1 + 1. / 6);
  // Stress at the first crack, to the step in which it is seen and the strain's square.
  EXPECT_NEAR(kMaterial.young * kRate * world.time / wanted, 1,
              2 * kMaterial.young * kRate * dt / wanted + 2 * wanted / kMaterial.young);
  while (world.time < .003) world.step(dt);
  EXPECT_LT(farthestCrack(world), 1e-9);
  EXPECT_EQ(world.fracture.numCracks(), 4);  // sides along the section
  // The law spends Gc, to what steps make of it (mode_one_test.cpp).
  EXPECT_NEAR(world.ledger.fracture, kEnergy * kHeight * kThickness,
              1e-3 * kEnergy * kHeight * kThickness);
}

TEST(Places, CracksOpenAtOnceWhereThereIsNoFractureEnergy) {
  World world;
  const TriangleMesh mesh = barMesh();
  BodySpec spec = weakBar(mesh);
  spec.places.fractureEnergy =
      sampled(mesh, [](Vec2 at) { return fromSection(at) < 2 * kSize ? 0 : 10 * kEnergy; });
  world.addBody(mesh, spec);
  const double dt = .5 * world.criticalTimeStep();
  while (world.fracture.numCracks() == 0 && world.time < .01) world.step(dt);
  EXPECT_GT(world.fracture.numCracks(), 0);
  EXPECT_EQ(world.fracture.cohesion.edge.size(), 0);
  EXPECT_EQ(world.ledger.fracture, 0);
}

TEST(Places, AnEdgeHasTheSmallerOfItsTwoTriangles) {
  World world;
  const TriangleMesh mesh = barMesh();
  const BodySpec spec = weakBar(mesh);
  world.addBody(mesh, spec);
  const CrackEdges& edges = world.fracture.edges;
  for (std::size_t i = 0; i < edges.size(); ++i) {
    const auto [a, b] = edges.element[i];
    EXPECT_EQ(edges.strength[i],
              std::min(spec.places.strength[a.value], spec.places.strength[b.value]));
    EXPECT_EQ(edges.fractureEnergy[i],
              std::min(spec.places.fractureEnergy[a.value], spec.places.fractureEnergy[b.value]));
  }
}

TEST(Places, ScatterIsAboutTheFieldsValue) {
  const TriangleMesh mesh = barMesh();
  BodySpec spec = drawnBar(mesh);
  spec.brittle.strengthScatter = .3, spec.brittle.weibullModulus = 8;
  const auto strengths = [&] {
    World world;
    world.addBody(mesh, spec);
    return world.fracture.edges.strength;
  };
  const std::vector<double> even = strengths();
  spec.places.strength.assign(mesh.triangles.size(), spec.brittle.tensileStrength);
  EXPECT_TRUE(sameBits(strengths(), even));
  spec.places.strength.assign(mesh.triangles.size(), 2 * spec.brittle.tensileStrength);
  std::vector<double> doubled = even;
  for (double& one : doubled) one *= 2;
  EXPECT_TRUE(sameBits(strengths(), doubled));
}

TEST(Places, FollowWhenAnotherBodyLeaves) {
  const TriangleMesh mesh = barMesh();
  TriangleMesh above = mesh;
  for (Vec2& node : above.nodes) node.y += 2 * kHeight;
  World alone, both;
  alone.addBody(mesh, drawnBar(mesh));
  const ComponentId first = both.addBody(above, drawnBar(above));
  const ComponentId second = both.addBody(mesh, weakBar(mesh));
  both.removeBody(first);
  const CrackEdges& edges = both.fracture.edges;
  ASSERT_EQ(edges.fractureEnergy.size(), alone.fracture.edges.size());
  EXPECT_EQ(std::ranges::count(edges.fractureEnergy, kEnergy) > 0, true);
  const double dt = .5 * both.criticalTimeStep();
  while (both.time < .003) both.step(dt);
  EXPECT_LT(farthestCrack(both), 1e-9);
  EXPECT_NEAR(both.ledger.fracture, kEnergy * kHeight * kThickness,
              1e-3 * kEnergy * kHeight * kThickness);
  EXPECT_EQ(both.model.components[second.value].brittleByPlace, true);
}

TEST(Places, AStepThatDoesNotResolveTheBandIsRefusedByItsPlace) {
  World world;
  const TriangleMesh mesh = barMesh();
  BodySpec spec = weakBar(mesh);
  // δc = ¼Δt²(L/2)h(1/m₁ + 1/m₂)σ of the mesh's edges at some Gc; a hundredth of that is too little
  // for any step near the critical one.
  spec.places.fractureEnergy =
      sampled(mesh, [](Vec2 at) { return fromSection(at) < kSize ? 1e-4 * kEnergy : kEnergy; });
  world.addBody(mesh, spec);
  const double dt = .9 * world.criticalTimeStep();
  const std::string text = refusalOf([&] { world.step(dt); });
  EXPECT_NE(text.find("fractureEnergy is 0.002 J/m² in component 0 at (0.07"), std::string::npos)
      << text;
  EXPECT_NE(text.find("does not resolve"), std::string::npos) << text;
  EXPECT_EQ(world.steps, 0);
  const std::string warning =
      cohesiveZoneWarning(world.model, world.fracture.edges, ComponentId(std::size_t{0}));
  EXPECT_NE(warning.find("the cohesive zone is"), std::string::npos) << warning;
}

TEST(Places, ImpossibleArgumentsAreRefusedAndTheWorldIsUnchanged) {
  const TriangleMesh mesh = barMesh();
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const auto expectRefusedAfter = [&](const std::function<void(BodySpec&)>& spoil,
                                      const char* part) {
    BodySpec spec = weakBar(mesh);
    spoil(spec);
    expectRefused(mesh, spec, part);
  };
  for (const double wrong : {0., -1., nan, double(INFINITY)})
    expectRefusedAfter([&](BodySpec& s) { s.places.strength[3] = wrong; }, "strength is");
  for (const double wrong : {-1., nan, double(INFINITY)})
    expectRefusedAfter([&](BodySpec& s) { s.places.fractureEnergy[3] = wrong; },
                       "fractureEnergy is");
  expectRefusedAfter([](BodySpec& s) { s.places.strength.pop_back(); },
                     "strength has 319 values, but the mesh has 320 triangles");
  expectRefusedAfter([](BodySpec& s) { s.places.fractureEnergy.push_back(1); },
                     "fractureEnergy has 321 values");
  expectRefusedAfter([](BodySpec& s) { s.brittle = {}; }, "must be a BrittleFEMat");
}

}  // namespace
}  // namespace yadefrag::test
