// Which elements of brittle bodies are reported as stressed, compared with one element after the
// other.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/tolerances/dynamics.hpp"
#include "elements/blocks.hpp"
#include "elements/element_state.hpp"
#include "fracture/separation.hpp"

namespace yadefrag {
namespace {

/// (Pa) By body of `bodies`.
const std::vector<double> kStrength = {3e8, 2e8, 2e8, 2e8, 2e8, 2e8, 1, 2e8};
constexpr double kInfinite = std::numeric_limits<double>::infinity();

/// xx, yy, xy of RᵀP, R found by its angle.
std::array<double, 3> turnedBack(const Matrix2& f, const ElasticMaterial& material) {
  const Matrix2 p = firstPiola(f, material.lame(), material.shearModulus());
  const double angle = std::atan2(f.yx - f.xy, f.xx + f.yy);
  const double c = std::cos(angle);
  const double s = std::sin(angle);
  return {c * p.xx + s * p.yx, c * p.yy - s * p.xy, c * p.xy + s * p.yy};
}

/// (Pa) √(max(c + r, 0)² + (max(r√(1 + μ²) + μc, 0)/β)²)
double measureOf(const std::array<double, 3>& stress, double shearFactor, double friction) {
  const double mean = (stress[0] + stress[1]) / 2;
  const double radius = std::hypot((stress[0] - stress[1]) / 2, stress[2]);
  const double slip = radius * std::hypot(1, friction) + friction * mean;
  return std::hypot(std::max(mean + radius, 0.), std::max(slip, 0.) / shearFactor);
}

/// (Pa) By element.
std::vector<double> measures(const Model& model) {
  std::vector<double> result;
  for (std::size_t e = 0; e < model.triangles.size(); ++e) {
    const Component& c = model.components[model.triangles.component[e].value];
    const auto stress = turnedBack(deformationGradient(model, ElementId(e)), c.material);
    result.push_back(measureOf(stress, c.brittle.shearFactor, c.friction));
  }
  return result;
}

/// Bodies of several brittle materials and one that is not; small ones share chunks with others.
Model bodies() {
  Model model = square(50);
  model.components[0].brittle = {.tensileStrength = 3e8, .shearFactor = 1.5};
  const auto add = [&](double x, int side, const BrittleMaterial& brittle) {
    const ComponentId id = appendBlock(model, {x, 0}, {x + .01, .01}, side, side);
    model.components[id.value].brittle = brittle;
    model.components[id.value].friction = .4;
  };
  for (int i = 0; i < 5; ++i) add(.02 + .02 * i, 5, {.tensileStrength = 2e8, .shearFactor = .7});
  add(.2, 13, {});
  add(.22, 7, {.tensileStrength = 2e8, .shearFactor = 3});
  return model;
}

/// Turns all and moves the nodes about, by up to `most` of a quad of 0.4 mm.
void distort(Model& model, double most) {
  shake(model, most * 4e-4);
  for (std::size_t n = 0; n < model.nodes.size(); ++n) {
    model.nodes.position[n] += model.nodes.velocity[n];
    model.nodes.velocity[n] = {};
  }
  turn(model, 2);
}

/// By element: does a range hold it? Checks that ranges are small and ascending.
std::vector<bool> reported(const Model& model, std::span<const ElementRange> ranges) {
  std::vector<bool> result(model.triangles.size(), false);
  std::uint32_t last = 0;
  for (const ElementRange& range : ranges) {
    EXPECT_LE(last, range.firstElement);
    EXPECT_LT(range.firstElement, range.lastElement);
    EXPECT_LE(range.lastElement - range.firstElement, kLanes);
    last = range.lastElement;
    for (std::uint32_t e = range.firstElement; e < range.lastElement; ++e) result[e] = true;
  }
  EXPECT_LE(last, model.triangles.size());
  return result;
}

/// Every range holds a stressed element, every stressed element is in a range.
void check(const Model& model, const std::vector<double>& strength,
           std::span<const ElementRange> ranges) {
  const std::vector<double> measure = measures(model);
  const std::vector<bool> isReported = reported(model, ranges);
  const auto look = [&](std::size_t e) {
    const std::size_t c = model.triangles.component[e].value;
    return model.components[c].brittle.cracks() ? tolerance::kStrengthCheck * strength[c]
                                                : kInfinite;
  };
  // Rounding of angles and of F − R: 1e-9 is far above.
  for (std::size_t e = 0; e < measure.size(); ++e)
    if (measure[e] > look(e) * (1 + 1e-9)) {
      EXPECT_TRUE(isReported[e]) << e;
    }
  for (const ElementRange& range : ranges) {
    bool any = false;
    for (std::uint32_t e = range.firstElement; e < range.lastElement; ++e)
      any = any || measure[e] > look(e) * (1 - 1e-9);
    EXPECT_TRUE(any) << range.firstElement;
  }
}

struct Found {
  std::vector<ElementRange> ranges;
  std::vector<Vec2> forces;
};

Found lookAt(Model model, const std::vector<double>& strength, int threads,
             InstructionSet set = bestInstructionSet()) {
  ExplicitDynamics dynamics(set);
  dynamics.setStressLimits(strength);
  dynamics.rebuild(model);
  dynamics.predict(model, 0, {}, {}, threads);
  return {{dynamics.stressed().begin(), dynamics.stressed().end()},
          {dynamics.internalForces().begin(), dynamics.internalForces().end()}};
}

TEST(Stressed, AreThoseThatTheScalarSumFinds) {
  std::size_t most = 0;
  std::size_t least = 1000000;
  for (const double by : {0., 1e-4, 3e-4, 1e-3, 3e-3, 1e-2}) {
    Model model = bodies();
    distort(model, by);
    const Found found = lookAt(model, kStrength, 1);
    check(model, kStrength, found.ranges);
    most = std::max(most, found.ranges.size());
    least = std::min(least, found.ranges.size());
  }
  EXPECT_EQ(least, 0);
  EXPECT_GT(most, 600);
}

TEST(Stressed, AreTheSameForAnyThreadsAndInstructionSet) {
  Model model = bodies();
  distort(model, 1e-3);
  const Found one = lookAt(model, kStrength, 1);
  EXPECT_EQ(lookAt(model, kStrength, 2).ranges, one.ranges);
  EXPECT_EQ(lookAt(model, kStrength, 2, InstructionSet::kBaseline).ranges, one.ranges);
  const std::vector<Vec2> unwatched = lookAt(model, {}, 2).forces;
  EXPECT_TRUE(one.forces == unwatched);
}

TEST(Stressed, OnlyWatchedElementsAreReportedAndTheyMayChange) {
  Model model = bodies();
  distort(model, .01);
  const double none = kInfinite;
  EXPECT_TRUE(lookAt(model, {}, 1).ranges.empty());
  EXPECT_TRUE(lookAt(model, {0, 0, none, none, 0, 0, 1, none}, 1).ranges.empty());
  ExplicitDynamics dynamics;
  dynamics.rebuild(model);
  dynamics.setStressLimits({none, none, none, none, none, none, none, 2e8});
  dynamics.predict(model, 0, {}, {}, 1);
  ASSERT_FALSE(dynamics.stressed().empty());
  EXPECT_EQ(dynamics.stressed().front().firstElement, model.components[7].firstTriangle);
  dynamics.setStressLimits({});
  dynamics.predict(model, 0, {}, {}, 1);
  EXPECT_TRUE(dynamics.stressed().empty());
}

TEST(Stressed, BodiesInOneChunkAreWatchedForTheWeakest) {
  Model model = bodies();
  distort(model, 1e-3);
  const std::vector<double> strength = {kInfinite, 9e8, 9e8, 1e8, 9e8, 9e8, 0, 0};
  const auto alone = lookAt(model, strength, 1).ranges;
  const auto all = lookAt(model, {kInfinite, 1e8, 1e8, 1e8, 1e8, 1e8, 0, 0}, 1).ranges;
  EXPECT_FALSE(alone.empty());
  EXPECT_EQ(alone, all);
}

TEST(Stressed, AreLookedForAfterSplitsToo) {
  Model model = bodies();
  ExplicitDynamics dynamics;
  dynamics.setStressLimits(kStrength);
  dynamics.rebuild(model);
  std::vector<ElementId> changed;
  std::vector<NodeId> originals;
  for (std::size_t e = 0; e < model.triangles.size(); e += 100) {
    originals.push_back(model.triangles.nodes[e][1]);
    model.triangles.nodes[e][1] = model.nodes.duplicate(originals.back());
    changed.emplace_back(e);
  }
  lumpMasses(model);
  dynamics.follow(model, changed, originals);
  distort(model, 1e-3);
  dynamics.predict(model, 0, {}, {}, 1);
  EXPECT_FALSE(dynamics.stressed().empty());
  check(model, kStrength, dynamics.stressed());
}

TEST(Stressed, TheMeasureBoundsTheEffectiveTractionInEveryDirection) {
  std::mt19937_64 random(9);
  std::uniform_real_distribution<double> any(-.01, .01);
  for (int i = 0; i < 2000; ++i) {
    const Matrix2 f{any(random), 1 + any(random), -1 + any(random), any(random)};
    const BrittleMaterial brittle{.tensileStrength = 1, .shearFactor = i % 4 + .5};
    const double friction = i % 3 * .3;
    const auto stress = turnedBack(f, kSteel);
    const double measure = measureOf(stress, brittle.shearFactor, friction);
    const double rounding = 1e-9 * std::abs(stress[0] + stress[1]);
    const auto reaches = [&](double look) {
      return isStressed(f, kSteel.lame(), kSteel.shearModulus(),
                        StressLimit(brittle.shearFactor, friction, look * look));
    };
    // Pressed evenly, nothing is stressed.
    if (measure > 2 * rounding) {
      EXPECT_TRUE(reaches(measure - rounding)) << i;
    }
    EXPECT_FALSE(reaches(measure + rounding)) << i;
    double greatest = 0;
    for (double angle = 0; angle < 3.15; angle += .05) {
      const Traction traction = tractionOn(stress, {std::cos(angle), std::sin(angle)});
      greatest =
          std::max(greatest, effectiveTraction(traction.normal, traction.shear, brittle, friction));
    }
    EXPECT_LE(greatest, measure + rounding);
    EXPECT_GE(greatest, measure / 2 - 1e-3 * std::abs(stress[0] + stress[1]));
  }
}

}  // namespace
}  // namespace yadefrag
