// Strength and fracture energy that differ by place: closed forms of a bar in tension, and what
// must follow them.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>

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
  spec.places.strength = byTriangle<double>(mesh, bandStrength);
  spec.places.fractureEnergy = byTriangle<double>(mesh, bandEnergy);
  return spec;
}

/// Also if a body that was added before it has left.
TEST(Places, ABarBreaksInItsWeakBandAtTheBandsStrengthAndTakesTheBandsEnergy) {
  const TriangleMesh mesh = barMesh();
  TriangleMesh above = mesh;
  for (Vec2& node : above.nodes) node.y += 2 * kHeight;
  for (const double energy : {kEnergy, 0.})  // without it cracks open at once
    for (const bool isSecond : {false, true}) {
      World world;
      if (isSecond) world.addBody(above, drawnBar(above));
      BodySpec spec = weakBar(mesh);
      for (double& one : spec.places.fractureEnergy)
        if (one == kEnergy) one = energy;
      const ComponentId body = world.addBody(mesh, spec);
      if (isSecond) world.removeBody(ComponentId(std::size_t{0}));
      EXPECT_TRUE(world.model.components[body.value].brittleByPlace);
      EXPECT_GT(std::ranges::count(world.fracture.edges.fractureEnergy, energy), 0);
      const double dt = .5 * world.criticalTimeStep();
      while (world.fracture.numCracks() == 0 && world.time < .01) world.step(dt);
      const double wanted = kWeak * (1 + 1. / 6);
      // Stress at the first crack, to the step in which it is seen and the strain's square.
      EXPECT_NEAR(kMaterial.young * kRate * world.time / wanted, 1,
                  2 * kMaterial.young * kRate * dt / wanted + 2 * wanted / kMaterial.young);
      EXPECT_EQ(world.fracture.cohesion.edge.empty(), energy == 0);
      while (world.time < .003) world.step(dt);
      if (energy > 0) {
        for (const CrackLine& crack : cracksOf(world))
          EXPECT_LT(std::max(fromSection(crack.first), fromSection(crack.last)), 1e-9);
        EXPECT_EQ(world.fracture.numCracks(), 4);  // sides along the section
      }
      // The law spends Gc, to what steps make of it (mode_one_test.cpp).
      EXPECT_NEAR(world.ledger.fracture, energy * kHeight * kThickness,
                  1e-3 * energy * kHeight * kThickness);
    }
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

TEST(Places, AStepThatDoesNotResolveTheBandIsRefusedByItsPlace) {
  World world;
  const TriangleMesh mesh = barMesh();
  BodySpec spec = weakBar(mesh);
  // δc = ¼Δt²(L/2)h(1/m₁ + 1/m₂)σ of the mesh's edges at some Gc; a hundredth of that is too little
  // for any step near the critical one.
  spec.places.fractureEnergy = byTriangle<double>(
      mesh, [](Vec2 at) { return fromSection(at) < kSize ? 1e-4 * kEnergy : kEnergy; });
  world.addBody(mesh, spec);
  const double dt = .9 * world.criticalTimeStep();
  const std::string text = refusalOf([&] { world.step(dt); });
  EXPECT_TRUE(contains(text, "fractureEnergy is 0.002 J/m² in component 0 at (0.07"));
  EXPECT_TRUE(contains(text, "does not resolve"));
  EXPECT_EQ(world.steps, 0);
  const std::string warning =
      cohesiveZoneWarning(world.model, world.fracture.edges, ComponentId(std::size_t{0}));
  EXPECT_TRUE(contains(warning, "the cohesive zone is"));
}

TEST(Places, ImpossibleArgumentsAreRefusedAndTheWorldIsUnchanged) {
  const TriangleMesh mesh = barMesh();
  const auto expectRefusedAfter = [&](const std::function<void(BodySpec&)>& spoil,
                                      const char* part) {
    BodySpec spec = weakBar(mesh);
    spoil(spec);
    expectRefused(mesh, spec, part);
  };
  for (const double wrong : {0., -1., double(NAN), double(INFINITY)})
    expectRefusedAfter([&](BodySpec& s) { s.places.strength[3] = wrong; }, "strength is");
  for (const double wrong : {-1., double(NAN), double(INFINITY)})
    expectRefusedAfter([&](BodySpec& s) { s.places.fractureEnergy[3] = wrong; },
                       "fractureEnergy is");
  expectRefusedAfter([](BodySpec& s) { s.places.strength.pop_back(); },
                     "strength has 319 values, but the mesh has 320 triangles");
  expectRefusedAfter([](BodySpec& s) { s.places.fractureEnergy.push_back(1); },
                     "fractureEnergy has 321 values");
  expectRefusedAfter([](BodySpec& s) { s.brittle = {}; }, "must be a BrittleFEMat");
  for (const double wrong : {-1., double(INFINITY)})
    for (const bool isEnergy : {false, true})
      expectRefusedAfter(
          [&](BodySpec& s) {
            s.places.joints = jointsWhere(mesh, isEnergy ? 1 : wrong, isEnergy ? wrong : 0,
                                          [](Vec2 at) { return fromSection(at) < 1e-9; });
          },
          isEnergy ? "jointEnergy is" : "jointStrength is");
}

TEST(Places, ImpossibleMaterialsAreRefusedAndTheWorldIsUnchanged) {
  const TriangleMesh mesh = barMesh();
  const auto expectRefusedAfter = [&](void (*spoil)(BodySpec&), const char* part) {
    BodySpec spec = drawnBar(mesh);
    spec.materials.materials = {spec, spec};
    spec.materials.ofTriangle =
        byTriangle<std::uint32_t>(mesh, [](Vec2 at) { return at.x < kLength / 2 ? 0 : 1; });
    spoil(spec);
    expectRefused(mesh, spec, part);
  };
  expectRefusedAfter([](BodySpec& s) { s.element = ElementKind::kSmoothed; },
                     "it must be 'linear'");
  expectRefusedAfter([](BodySpec& s) { s.materials.ofTriangle.pop_back(); },
                     "material has 319 values, but the mesh has 320 triangles");
  expectRefusedAfter([](BodySpec& s) { s.materials.ofTriangle[3] = 2; }, "material is 2");
  expectRefusedAfter([](BodySpec& s) { s.materials.materials[1].material.density = 0; },
                     "density is 0");
}

}  // namespace
}  // namespace yadefrag::test
