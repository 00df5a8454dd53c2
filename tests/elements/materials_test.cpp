// Bodies of several materials: layers against their closed forms, waves through an interface.

#include <gtest/gtest.h>
#include <algorithm>

#include <cmath>

#include "core/checks.hpp"
#include "elements/blocks.hpp"
#include "elements/element_state.hpp"

namespace yadefrag {
namespace {

using test::sameBits;

BodyMaterial elastic(double young, double density, double poisson = 0) {
  return {{.young = young, .poisson = poisson, .density = density, .planeStress = true}, {}, 0, {}};
}

/// `numberAt(x, y)`: the number of the material there.
template <class NumberAt>
MaterialPlaces placed(const TriangleMesh& mesh, std::vector<BodyMaterial> materials,
                      NumberAt numberAt) {
  return {std::move(materials), test::byTriangle<std::uint32_t>(mesh, numberAt)};
}

Model modelOf(const TriangleMesh& mesh, const MaterialPlaces& places) {
  Model model;
  appendBody(model, mesh, {boundOf(places, {})}, places);
  return model;
}

/// Forces inside, of the largest anywhere: 0 in equilibrium.
double imbalance(const Model& model, double low, double high) {
  const std::vector<Vec2> force = forcesOf(model);
  double inside = 0, most = 0;
  for (std::size_t n = 0; n < force.size(); ++n) {
    const double x = model.nodes.position[n].x;
    most = std::max(most, norm(force[n]));
    if (x > low && x < high) inside = std::max(inside, norm(force[n]));
  }
  return inside / most;
}

constexpr double kStiff = 3e9, kSoft = 1e9, kPart = .4, kHeight = .2;  // Pa, Pa, of 1 m, m
constexpr double kSmall = 1e-7;  // strain: what is neglected is of its order

double energyOf(const Model& model) { return strainEnergy(model, 0); }

// Both states are linear by parts, which triangles of constant strain have exactly.
TEST(Materials, LayersAreAsStiffAsTheMeanOfTheirCompliancesOrStiffnesses) {
  const TriangleMesh mesh = structuredRectangle({0, 0}, {1, kHeight}, 20, 10);
  for (const bool inSeries : {true, false}) {
    const MaterialPlaces places =
        placed(mesh, {elastic(kStiff, 1000), elastic(kSoft, 1000)},
               [&](Vec2 at) { return (inSeries ? at.x < kPart : at.y < kPart * kHeight) ? 0 : 1; });
    Model model = modelOf(mesh, places);
    const double whole = inSeries ? 1 / (kPart / kStiff + (1 - kPart) / kSoft)
                                  : kPart * kStiff + (1 - kPart) * kSoft;
    const double stress = kSmall * whole;
    for (Vec2& x : model.nodes.position)
      x.x += inSeries ? stress * (std::min(x.x, kPart) / kStiff + std::max(x.x - kPart, 0.) / kSoft)
                      : kSmall * x.x;
    EXPECT_LT(imbalance(model, 1e-3, 1 - 1e-3), 1e-6);
    EXPECT_NEAR(energyOf(model) / (whole * kSmall * kSmall / 2 * kHeight), 1, 1e-6);
    const auto all = stresses(model);
    for (std::size_t e = 0; e < all.size(); ++e) {
      const double alone = (places.ofTriangle[e] == 0 ? kStiff : kSoft) * kSmall;
      EXPECT_NEAR(all[e][0] / (inSeries ? stress : alone), 1, 1e-6);
    }
  }
}

/// Runs a wave of the velocity ½(1 − cos) to the right from the middle of the left half until it is
/// reflected and transmitted; the extreme velocities in both halves, over what came.
struct Echo {
  double reflected, transmitted;
};

Echo echoOf(const BodyMaterial& left, const BodyMaterial& right) {
  constexpr double kWidth = .4, kSpeed = 1e-3;  // m, m/s
  const TriangleMesh mesh = structuredRectangle({-1, 0}, {1, .02}, 400, 4);
  Model model =
      modelOf(mesh, placed(mesh, {left, right}, [](Vec2 at) { return at.x < 0 ? 0 : 1; }));
  const double c = std::sqrt(left.material.young / left.material.density);
  const double other = std::sqrt(right.material.young / right.material.density);
  for (std::size_t n = 0; n < model.nodes.size(); ++n) {
    Vec2& x = model.nodes.position[n];
    const double s = std::clamp((x.x + .5) / kWidth + .5, 0., 1.);
    model.nodes.velocity[n].x = kSpeed / 2 * (1 - std::cos(2 * M_PI * s));
    // u = −∫ v dx/c behind the front
    const double passed = s - std::sin(2 * M_PI * s) / (2 * M_PI);
    x.x += kSpeed / (2 * c) * kWidth * (1 - passed);
  }
  Stepper run = runOf(std::move(model), .8);
  const double begin = run.total();
  const double time = .5 / c + std::min(.5 / c, .4 / other);
  run.step(static_cast<int>(time / run.dt));
  EXPECT_NEAR(run.total() / begin, 1, 1e-6);
  Echo echo{0, 0};
  for (std::size_t n = 0; n < run.model.nodes.size(); ++n) {
    const double v = run.model.nodes.velocity[n].x / kSpeed;
    double& most = mesh.nodes[n].x < 0 ? echo.reflected : echo.transmitted;
    if (std::abs(v) > std::abs(most)) most = v;
  }
  return echo;
}

// Of bars with impedances z = √(Eρ): of the velocity 2z₁/(z₁+z₂) goes on and (z₁−z₂)/(z₁+z₂) comes
// back. The pulse is 80 triangles long, of which the mesh's dispersion takes some thousandths.
TEST(Materials, AWaveIsReflectedAndTransmittedAsTheImpedancesRequire) {
  const BodyMaterial first = elastic(1e9, 1000);
  for (const BodyMaterial& second :
       {elastic(1e9, 4000), elastic(4e9, 1000), elastic(.25e9, 1000), elastic(3e9, 3000)}) {
    const double z1 = std::sqrt(first.material.young * first.material.density);
    const double z2 = std::sqrt(second.material.young * second.material.density);
    const Echo echo = echoOf(first, second);
    EXPECT_NEAR(echo.transmitted, 2 * z1 / (z1 + z2), .01) << z2;
    EXPECT_NEAR(echo.reflected, (z1 - z2) / (z1 + z2), .01) << z2;
  }
  // Of one impedance, nothing comes back although the wave's speed changes.
  const Echo matched = echoOf(first, elastic(2e9, 500));
  EXPECT_NEAR(matched.transmitted, 1, .01);
  EXPECT_LT(std::abs(matched.reflected), .01);
}

/// Three materials without any order, very different from each other.
TEST(Materials, TheCriticalStepHoldsForAnyMixture) {
  const TriangleMesh mesh = structuredRectangle({0, 0}, {1, 1}, 8, 8);
  const std::vector<BodyMaterial> materials{elastic(1e9, 1000, .3), elastic(50e9, 1000, .1),
                                            elastic(2e9, 8000, .45)};
  for (const double viscosity : {0., .1}) {
    std::mt19937_64 random(3);
    Model model = modelOf(mesh, placed(mesh, materials, [&](Vec2) { return random() % 3; }));
    shake(model, 1e-6);
    StepSettings settings;
    settings.viscosity.linear = viscosity;
    Stepper run = runOf(std::move(model), 1, settings);
    run.step(1);
    const double begin = run.total();
    run.step(5000);
    EXPECT_NEAR(run.total() / begin, 1, 1e-4) << viscosity;
    // Hardly more than the lightest and stiffest of them would require alone.
    Model stiffest;
    appendBody(stiffest, mesh, {materials[1]});
    EXPECT_GT(run.dt, .8 * criticalTimeStep(stiffest, settings.viscosity));
  }
}

TEST(Materials, AListOfOneMaterialHasTheBitsOfABodyOfIt) {
  const TriangleMesh mesh = structuredRectangle({-.01, -.01}, {.01, .01}, 9, 7);
  const auto runOn = [&](bool mixed) {
    Model model;
    const BodyMaterial material{kSteel, {}, 0, {}};
    const MaterialPlaces places{{material, material},
                                std::vector<std::uint32_t>(mesh.triangles.size(), 1)};
    appendBody(model, mesh, {material}, mixed ? places : MaterialPlaces{});
    shake(model, 10);
    StepSettings settings;
    settings.viscosity = {.06, 1.2};
    Stepper run = runOf(std::move(model), .8, settings);
    run.step(200);
    return run;
  };
  const Stepper one = runOn(false), several = runOn(true);
  EXPECT_TRUE(sameBits(one.model.nodes.position, several.model.nodes.position));
  EXPECT_TRUE(sameBits(one.model.nodes.velocity, several.model.nodes.velocity));
  EXPECT_EQ(one.dt, several.dt);
  EXPECT_EQ(one.total(), several.total());
  EXPECT_EQ(energyOf(one.model), energyOf(several.model));
}

TEST(Materials, BodiesJoinAndLeave) {
  const TriangleMesh mesh = structuredRectangle({0, 0}, {1, 1}, 2, 2);
  const auto numbers = [](Vec2 at) { return at.x < .5 ? 0 : 1; };
  const MaterialPlaces first = placed(mesh, {elastic(1, 1), elastic(2, 2)}, numbers);
  const MaterialPlaces second = placed(mesh, {elastic(3, 3), elastic(4, 4)}, numbers);
  Model model;
  const ComponentId plain = appendBody(model, mesh, {elastic(9, 9)});
  EXPECT_TRUE(model.triangles.material.empty());
  const ComponentId gone = appendBody(model, mesh, {boundOf(first, {})}, first);
  const ComponentId stays = appendBody(model, mesh, {boundOf(second, {})}, second);
  appendBody(model, mesh, {elastic(9, 9)});
  const std::vector<double> masses = model.nodes.mass;
  removeBody(model, gone);
  removeBody(model, plain);
  ASSERT_EQ(model.materials.size(), 2U);
  for (std::size_t e = 0; e < 8; ++e)
    EXPECT_EQ(model.materialOf(ElementId(e)).material.young, 3 + second.ofTriangle[e]);
  EXPECT_EQ(model.materialOf(ElementId(std::size_t{8})).material.young, 9);
  const std::vector<double> before = model.nodes.mass;
  lumpMasses(model);
  EXPECT_TRUE(sameBits(before, model.nodes.mass));
  removeBody(model, stays);
  EXPECT_TRUE(model.triangles.material.empty());
}

}  // namespace
}  // namespace yadefrag
