// Many blows in a small space: nothing gets out, nothing gets in, no energy appears.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>
#include <string>

#include "core/checks.hpp"
#include "elements/element_state.hpp"
#include "fracture/overlaps.hpp"
#include "meshing/polygon.hpp"
#include "meshing/triangulate.hpp"
#include "step/bodies.hpp"

namespace yadefrag::test {
namespace {

TriangleMesh ring(double inner, double outer, int count, int countInside) {
  return triangulate(checkPolygon({circle({}, outer, count), {circle({}, inner, countInside)}}),
                     2 * std::numbers::pi * outer / count);
}

/// 20 squares between rigid walls. Coarse meshes lose most of the energy in their blows (the part
/// of a contact node at touch); it is booked as contact, and the total stays within 0.5 %.
TEST(Enclosures, TwentySquaresInABox) {
  World world = twoPasses();
  const TriangleMesh frame =
      triangulate(checkPolygon({{{-1, -1}, {6.5, -1}, {6.5, 5.5}, {-1, 5.5}},
                                {{{-.2, -.2}, {-.2, 4.8}, {5.8, 4.8}, {5.8, -.2}}}}),
                  .5);
  BodySpec rigid = moving(frame, rubber(), {0, 0});
  hold(rigid, frame, kHeldXY, [](Vec2) { return true; });
  world.addBody(frame, rigid);
  std::mt19937 random(1);
  std::uniform_real_distribution<double> speed(-10, 10);
  for (int i = 0; i < 20; ++i) {
    const int column = i % 5, row = i / 5;
    const Vec2 low{1.1 * column + .1, 1.1 * row + .1};
    addMoving(world, structuredRectangle(low, low + Vec2{1, 1}, 4, 4), rubber(),
              {speed(random), speed(random)});
  }
  const RunResult result = watch(world, 100000, 200);
  EXPECT_LE(result.deepest, 5e-3) << "of the shortest segment";
  EXPECT_LE(result.growth, 5e-3);
  EXPECT_LE(result.drift, 5e-3);
  EXPECT_GT(result.touched, 1000U);
}

TEST(DiscInARing, Rattles) {
  for (const bool isSmooth : {false, true}) {
    SCOPED_TRACE(isSmooth);
    World world = twoPasses();
    // What sweeps leave is a part of the displacement in a step, some .02 of a segment here.
    world.contactSettings.constants.stop = 1e-4;
    const TriangleMesh outer = ring(1, 1.3, 80, 64);
    const TriangleMesh disc = triangulate(checkPolygon({circle({.2, .1}, .6, 48), {}}), .0785);
    BodySpec hollow = moving(outer, rubber(), {0, 0});
    BodySpec full = moving(disc, rubber(), {15, 7});
    if (isSmooth) smoothAll(hollow, outer), smoothAll(full, disc);
    world.addBody(outer, hollow);
    world.addBody(disc, full);
    const RunResult result = watch(world, 10000, 50);
    // A smooth surface bulges over its segments, so nodes are inside the other's polygon by the
    // sagitta of an arc, up to a 16th of a segment here; halfpoints are what is held outside the
    // arcs.
    // In two passes the rows of two arcs that face each other are nearly one row: sweeps converge
    // slowly, and end after Contact::rowSweeps.
    EXPECT_LE(isSmooth ? result.penetration : result.deepest, isSmooth ? 5e-4 : 2e-5)
        << "of the shortest segment";
    EXPECT_LE(result.deepest, isSmooth ? 1. / 16 : 2e-5);
    EXPECT_LE(result.growth, 5e-3);
    EXPECT_LE(result.drift, 5e-3);
    EXPECT_GT(result.touched, 1000U);
  }
}

double distanceToLine(Vec2 point, Vec2 a, Vec2 b) {
  return std::abs(cross(b - a, point - a)) / norm(b - a);
}

/// (m) How deep a loop's segments cross one another: the end that is least far through.
double selfCrossing(const BodyLoop& loop) {
  const auto& p = loop.points;
  const std::size_t n = p.size();
  double deepest = 0;
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t j = i + 2; j < n; ++j) {
      if (i == 0 && j + 1 == n) continue;
      const Vec2 a = p[i], b = p[(i + 1) % n], c = p[j], d = p[(j + 1) % n];
      const bool cross1 = (cross(b - a, c - a) > 0) != (cross(b - a, d - a) > 0);
      const bool cross2 = (cross(d - c, a - c) > 0) != (cross(d - c, b - c) > 0);
      if (cross1 && cross2)
        deepest = std::max(deepest, std::min({distanceToLine(a, c, d), distanceToLine(b, c, d),
                                              distanceToLine(c, a, b), distanceToLine(d, a, b)}));
    }
  return deepest;
}

/// A ring that is squeezed until its inner face lies on itself, and springs back.
TEST(BucklingRing, TouchesItself) {
  for (const bool isSmooth : {false, true}) {
    SCOPED_TRACE(isSmooth);
    World world;
    const TriangleMesh mesh = ring(.85, 1, 80, 72);
    BodySpec spec = moving(mesh, rubber(), {0, 0});
    for (std::size_t i = 0; i < mesh.nodes.size(); ++i)
      spec.velocity[i] = 25. * Vec2{mesh.nodes[i].x, -mesh.nodes[i].y};
    if (isSmooth) smoothAll(spec, mesh);
    world.addBody(mesh, spec);
    const double dt = .25 * world.criticalTimeStep();
    const double start = totalEnergy(world);
    double least = INFINITY, growth = 0, crossed = 0;
    std::size_t touched = 0;
    for (int i = 0; i < 4000; ++i) {
      world.step(dt);
      touched += world.contact.rows().size();
      if (i % 20 != 0) continue;
      for (const BodyLoop& loop : loopsOf(world)) {
        crossed = std::max(crossed, selfCrossing(loop) / world.search.shortest);
        least = std::min(least, std::abs(signedArea(loop.points)));
      }
      growth = std::max(growth, (world.kineticEnergy() + world.strainEnergy()) / start - 1);
    }
    // The straight polygon of a smooth surface may overlap by its sagittas: up to .15 in two meshes
    // that differ in their last bits.
    EXPECT_LE(crossed, isSmooth ? 1. / 6 : 1e-5) << "of the shortest segment";
    EXPECT_GT(touched, 100U);
    EXPECT_LT(least, .3) << "m², the hole at its smallest: it was 2.27";
    EXPECT_LE(growth, 5e-3);
  }
}

// --- Soft bodies that are hit so hard that their elastic law alone would let elements collapse.

/// A block that stands on held nodes and falls onto them at `speed` (of the wave speed).
World falling(double speed, ElementKind element) {
  World world;
  const TriangleMesh mesh = structuredRectangle({0, 0}, {.02, .02}, 4, 4);
  BodySpec spec;
  spec.material = {5e6, .4, 1100, false};
  spec.element = element;
  spec.selfContact = false;
  for (const Vec2 x : mesh.nodes) {
    spec.held.push_back(x.y < 1e-9 ? kHeldXY : kFree);
    spec.velocity.push_back({0, x.y < 1e-9 ? 0 : -100 * speed});
  }
  world.addBody(mesh, spec);
  return world;
}

double flattest(const Model& model) {
  double least = 1;
  for (std::size_t e = 0; e < model.triangles.size(); ++e)
    least = std::min(least, determinant(deformationGradient(model, ElementId(e))));
  return least;
}

struct Fall {
  double least = 1, drift = 0;
  int refused = 0;
};

/// Takes every step that a message asks for.
Fall follow(World world, double part, double duration) {
  Fall fall;
  double dt = part * world.criticalTimeStep();
  world.step(1e-3 * dt);
  const double start = totalEnergy(world);
  while (world.time < duration && fall.refused < 50) {
    const std::string text = saidBy<RunError>([&] { world.step(dt); });
    if (text.empty()) {
      fall.least = std::min(fall.least, flattest(world.model));
      fall.drift = std::max(fall.drift, std::abs(totalEnergy(world) / start - 1));
      continue;
    }
    // The last good state can be looked at.
    EXPECT_TRUE(text.starts_with("Step " + std::to_string(world.steps) + ", time ")) << text;
    EXPECT_GT(flattest(world.model), 0);
    EXPECT_TRUE(std::isfinite(totalEnergy(world)));
    const std::string words = "take a step of at most ";
    const std::size_t at = text.find(words);
    ++fall.refused;
    dt = at == std::string::npos ? dt / 2 : std::stod(text.substr(at + words.size()));
  }
  return fall;
}

TEST(Collapse, NoElementCollapsesAndEnergyIsKept) {
  for (const ElementKind element : {ElementKind::kLinear, ElementKind::kSmoothed})
    for (const double speed : {1.1, 1.5}) {
      const Fall coarse = follow(falling(speed, element), .8, 6e-4);
      EXPECT_LT(coarse.refused, 20) << speed;
      EXPECT_GT(coarse.refused, 0) << speed;
      EXPECT_TRUE(coarse.least > 0 && coarse.least < .1) << speed << ' ' << coarse.least;
      EXPECT_LT(coarse.drift, .03) << speed;
      const Fall fine = follow(falling(speed, element), .02, 6e-4);
      EXPECT_LT(fine.drift, .006) << speed;
      EXPECT_NEAR(coarse.least / fine.least, 1, .3) << speed;
    }
}

}  // namespace
}  // namespace yadefrag::test
