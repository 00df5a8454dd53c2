// Resistance to collapse: below `kBarrierBegin` of its area an element gets the stiffer the flatter
// it is.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "dynamics/blocks.hpp"
#include "dynamics/element_state.hpp"

namespace yadefrag {
namespace {

constexpr ElasticMaterial kSoft{.young = 5e6, .poisson = .4, .density = 1100};
constexpr ElementKind kKinds[] = {ElementKind::kLinear, ElementKind::kSmoothed};

/// A block pressed to a part of its height, and turned.
Model pressed(double part, ElementKind kind, int side = 3) {
  Model model = square(side, kSoft, .01);
  for (Component& component : model.components) component.element = kind;
  const double c = std::cos(.4), s = std::sin(.4);
  for (Vec2& x : model.nodes.position) x = {c * x.x - s * part * x.y, s * x.x + c * part * x.y};
  return model;
}

/// (J) Without the barrier. In a uniform strain smoothed bodies have the same.
double elasticEnergy(const Model& model) {
  double sum = 0;
  for (std::size_t e = 0; e < model.triangles.size(); ++e)
    sum +=
        .01 * model.triangles.area[e] *
        energyDensity(deformationGradient(model, ElementId(e)), kSoft.lame(), kSoft.shearModulus());
  return sum;
}

TEST(Collapse, NothingChangesAboveAndAnyEnergyIsReachedBelow) {
  for (const ElementKind kind : kKinds) {
    for (const double part : {.9, .5, .2001}) {
      const Model model = pressed(part, kind);
      EXPECT_NEAR(strainEnergy(model, 0) / elasticEnergy(model), 1, 1e-12) << part;
    }
    double last = 1;
    for (const double part : {.15, .1, .01, 1e-3, 1e-4}) {
      const Model model = pressed(part, kind);
      const double ratio = strainEnergy(model, 0) / elasticEnergy(model);
      EXPECT_GT(ratio, last) << part;
      last = ratio;
      double elements = 0;
      for (const double energy : elementEnergies(model)) elements += energy;
      EXPECT_NEAR(elements / strainEnergy(model, 0), 1, 1e-12);
    }
    EXPECT_GT(last, 100);
  }
}

TEST(Collapse, ForcesAreTheGradientOfTheEnergy) {
  for (const ElementKind kind : kKinds) {
    Model model = pressed(.08, kind);
    shake(model, 2e-5);
    for (std::size_t n = 0; n < model.nodes.size(); ++n)
      model.nodes.position[n] += model.nodes.velocity[n];
    const std::vector<Vec2> forces = forcesOf(model);
    double most = 0, worst = 0;
    for (std::size_t n = 0; n < model.nodes.size(); ++n)
      for (double Vec2::*axis : {&Vec2::x, &Vec2::y}) {
        const auto at = [&](double way) {
          Model moved = model;
          moved.nodes.position[n].*axis += way;
          return strainEnergy(moved, 0);
        };
        const double slope = (at(1e-8) - at(-1e-8)) / 2e-8;
        most = std::max(most, std::abs(slope));
        worst = std::max(worst, std::abs(forces[n].*axis + slope));
      }
    EXPECT_LT(worst, 1e-5 * most);
  }
}

/// σ of a uniform strain times the area of the turned, pressed side is the force on it.
TEST(Collapse, StressesContainTheBarrier) {
  for (const ElementKind kind : kKinds) {
    const Model model = pressed(.05, kind);
    const std::vector<Vec2> forces = forcesOf(model);
    const Vec2 normal{-std::sin(.4), std::cos(.4)};
    double force = 0;  // of the body on what presses its upper side
    for (std::size_t n = 0; n < model.nodes.size(); ++n)
      if (dot(model.nodes.position[n], normal) > .05 * .01 - 1e-9) force += dot(forces[n], normal);
    for (const auto& [xx, yy, xy] : stresses(model)) {
      const double along =
          xx * normal.x * normal.x + yy * normal.y * normal.y + 2 * xy * normal.x * normal.y;
      EXPECT_NEAR(-along * .02 * .01 / force, 1, 1e-9);
    }
  }
}

/// 2/ω of the highest mode of the whole model, from differences of forces.
double exactStep(const Model& model) {
  const std::size_t count = 2 * model.nodes.size();
  const auto forceAt = [&](std::size_t i, double way) {
    Model moved = model;
    (i % 2 == 0 ? moved.nodes.position[i / 2].x : moved.nodes.position[i / 2].y) += way;
    return forcesOf(moved);
  };
  std::vector<std::vector<double>> stiffness(count, std::vector<double>(count));
  for (std::size_t i = 0; i < count; ++i) {
    const auto a = forceAt(i, 1e-9), b = forceAt(i, -1e-9);
    for (std::size_t j = 0; j < count; ++j)
      stiffness[j][i] = (j % 2 == 0 ? b[j / 2].x - a[j / 2].x : b[j / 2].y - a[j / 2].y) / 2e-9 /
                        model.nodes.mass[j / 2];
  }
  std::vector<double> mode(count), next(count);
  for (std::size_t i = 0; i < count; ++i) mode[i] = std::sin(1. + 7. * static_cast<double>(i));
  double squared = 0;
  for (int round = 0; round < 500; ++round) {
    double size = 0;
    for (std::size_t j = 0; j < count; ++j) {
      next[j] = 0;
      for (std::size_t i = 0; i < count; ++i) next[j] += stiffness[j][i] * mode[i];
      size = std::max(size, std::abs(next[j]));
    }
    squared = size;
    for (std::size_t j = 0; j < count; ++j) mode[j] = next[j] / size;
  }
  return 2 / std::sqrt(squared);
}

TEST(Collapse, TheCriticalStepIsABound) {
  for (const ElementKind kind : kKinds)
    for (const double part : {.5, .19, .15, .1, .05, .01}) {
      const Model model = pressed(part, kind, 2);
      const double bound = criticalTimeStep(model), exact = exactStep(model);
      EXPECT_LE(bound, exact * (1 + 1e-4)) << part;
      EXPECT_GT(bound, (part < .2 ? .25 : .4) * exact) << part;
    }
  EXPECT_LT(criticalTimeStep(pressed(.05, kKinds[0])),
            .2 * criticalTimeStep(pressed(.21, kKinds[0])));
}

}  // namespace
}  // namespace yadefrag
