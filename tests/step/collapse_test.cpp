// Soft bodies that are hit so hard that their elastic law alone would let elements collapse.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "core/errors.hpp"
#include "core/same_bits.hpp"
#include "dynamics/element_state.hpp"
#include "meshing/structured.hpp"
#include "step/bodies.hpp"

namespace yadefrag::test {
namespace {

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
  while (world.time < duration && fall.refused < 50) try {
      world.step(dt);
      fall.least = std::min(fall.least, flattest(world.model));
      fall.drift = std::max(fall.drift, std::abs(totalEnergy(world) / start - 1));
    } catch (const RunError& error) {
      const std::string text = error.what(), words = "take a step of at most ";
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

TEST(Collapse, ARefusedStepIsTakenBack) {
  World world = falling(2, ElementKind::kLinear);
  const double dt = .8 * world.criticalTimeStep();
  std::string text;
  std::vector<Vec2> position, velocity;
  for (int i = 0; i < 100 && text.empty(); ++i) {
    position = world.model.nodes.position, velocity = world.model.nodes.velocity;
    try {
      world.step(dt);
    } catch (const RunError& error) {
      text = error.what();
    }
  }
  EXPECT_NE(text.find("is pressed to"), std::string::npos) << text;
  EXPECT_GT(flattest(world.model), tolerance::kBarrierBegin);
  EXPECT_TRUE(sameBits(world.model.nodes.position, position));
  EXPECT_TRUE(sameBits(world.model.nodes.velocity, velocity));
}

}  // namespace
}  // namespace yadefrag::test
