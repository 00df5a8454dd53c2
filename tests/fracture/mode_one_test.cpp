// One edge between two triangles, driven apart: what holds it, against the law's curve. Cracks in
// bodies of several materials: which edges have whose strength, and where they crack.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "fracture/cohesive_law.hpp"
#include "fracture/laboratory.hpp"
#include "fracture/two_triangles.hpp"
#include "step/bodies.hpp"

namespace yadefrag::test {
namespace {

/// What the law gives in a step between two openings: while they grow, that at the step's begin.
double lawful(const TensionLaw& law, double& largest, double begin, double end) {
  const double most = envelope(law, largest);
  const double traction = largest > 0 && end < largest ? most * std::max(0., end) / largest : most;
  largest = std::max({largest, begin, end});
  return traction;
}

struct RunResult {
  double worstTraction = 0;  // of the strength
  double worstEnergy = 0;    // of Gc·A
  double leastOpening = 0;   // m
  double largestStep = 0;    // m, opening in a step
  double spent = 0;          // of Gc·A
};

/// Through the wanted openings in turn (of δc), each half at 50 m/s: in so many steps from 0 to δc.
RunResult run(std::initializer_list<double> turns, int steps, const SofteningCurve& curve = {}) {
  constexpr double kSpeed = 50;
  const TensionLaw law{curve, kStrength, curve.criticalOpening(kStrength, kEnergy)};
  const double critical = law.criticalOpening;
  const double dt = critical / (2 * kSpeed) / steps;
  BodySpec spec;
  spec.brittle.softening = curve;
  DrivenPair pair(spec, dt);
  const auto least = [&] { return std::min(pair.opening(0).x, pair.opening(1).x); };
  double largest[2] = {0, 0};
  RunResult result;
  for (const double turn : turns) {
    const double sign = turn * critical > least() ? 1 : -1;
    // Those that are to close further than shut never come there.
    for (int n = 0; n < 2 * steps && sign * (turn * critical - least()) > 0; ++n) {
      if (n == 0) pair.drive({sign * kSpeed, 0});
      const double begin[2] = {pair.opening(0).x, pair.opening(1).x};
      pair.step();
      double wanted = 0;
      for (std::size_t end = 0; end < 2; ++end) {
        wanted += lawful(law, largest[end], begin[end], pair.opening(end).x) / 2;
        result.largestStep =
            std::max(result.largestStep, std::abs(pair.opening(end).x - begin[end]));
      }
      result.leastOpening = std::min(result.leastOpening, least());
      // Shut faces push, too.
      if (least() > 1e-6 * critical)
        result.worstTraction =
            std::max(result.worstTraction, std::abs(pair.traction.x - wanted) / kStrength);
    }
  }
  result.worstEnergy = pair.worstEnergy / (kEnergy * kArea);
  result.spent = pair.world.ledger.fracture / (kEnergy * kArea);
  return result;
}

// The traction computed from the momentum is the law's to rounding (3e-13; momenta are 10⁴ times
// what a step changes). So is the energy: 10⁻⁹ leaves room for strains of 10⁻⁵, of which the
// leapfrog's invariant neglects the square. The work is the sum of trapezoids below a straight
// line, exact but for the last step, which ends beyond δc: a triangle of at most ½σc Δδ²/δc,
// (Δδ/δc)² of Gc.
TEST(ModeOne, OpeningSpendsTheFractureEnergy) {
  for (const int steps : {40, 100, 400}) {
    const RunResult result = run({1.2}, steps);
    EXPECT_LT(result.worstTraction, 1e-11) << steps;
    EXPECT_LT(result.worstEnergy, 1e-9) << steps;
    const double part = result.largestStep / kCritical;
    EXPECT_LT(std::abs(result.spent - 1), part * part + 1e-9) << steps;
  }
}

// The same for every curve. Its knees have errors of second order: a step across one cuts a
// triangle of at most ½Δs Δδ²/4, where Δs is the change of slope; all together at most the steepest
// slope.
TEST(ModeOne, EveryCurveSpendsTheFractureEnergy) {
  for (const auto& [name, curve] : softeningCurves()) {
    double error[2];
    for (const int k : {0, 1}) {
      const RunResult result = run({1.2}, k == 0 ? 400 : 1600, curve);
      EXPECT_LT(result.worstTraction, 1e-10) << name;
      EXPECT_LT(result.worstEnergy, 1e-9) << name;
      error[k] = std::abs(result.spent - 1);
    }
    EXPECT_LT(error[0], 1e-3) << name;
    EXPECT_LT(error[1], 1e-3 / 16 + 1e-8) << name;
  }
}

// Unloading and reloading go by the line through the origin, to rounding as well. On it the
// traction is that of the step's end, half a chord late both ways, so that stiff lines do no harm:
// that spends 2·T(δmax)/δmax·Δδ for every opening that is closed and opened again, which is of
// first order in the step: 2.9 Δδ/δc of Gc in this course, and half as much with half the step.
TEST(ModeOne, UnloadsTowardsTheOriginAndBack) {
  double more[2];
  for (const int k : {0, 1}) {
    const RunResult result = run({.4, .1, .6, .2, 1.2}, k == 0 ? 200 : 400);
    EXPECT_LT(result.worstTraction, 1e-11) << k;
    EXPECT_LT(result.worstEnergy, 1e-9) << k;
    more[k] = result.spent - 1;
    EXPECT_GT(more[k], 0) << k;
    EXPECT_LT(more[k], 4 * result.largestStep / kCritical) << k;
  }
  EXPECT_NEAR(more[0] / more[1], 2, .2);
}

TEST(ModeOne, EveryCurveUnloadsTowardsTheOriginAndBack) {
  for (const auto& [name, curve] : softeningCurves()) {
    const RunResult result = run({.4, .1, .6, .2, 1.2}, 1600, curve);
    EXPECT_LT(result.worstTraction, 1e-10) << name;
    EXPECT_LT(result.worstEnergy, 1e-9) << name;
    EXPECT_GT(result.spent, 1 - 1e-4) << name;
    EXPECT_LT(result.spent, 1.01) << name;
  }
}

// Faces that are driven against each other while they still hold stop where they touch, and what
// is left of the law is as it was.
TEST(ModeOne, ShutFacesStayApart) {
  const RunResult result = run({.4, -.1, 1.2}, 200);
  EXPECT_GT(result.leastOpening, -1e-9 * kCritical);
  EXPECT_LT(result.worstTraction, 1e-11);
  EXPECT_LT(result.worstEnergy, 1e-9);
}

/// (rad) Two halves turn about an end which still holds, by more than half a turn: the angle
/// between them from which on nothing holds. `strength`: Pa, once the edge has cracked.
double doorsRelease(double strength) {
  constexpr double kDt = 1e-10, kSpin = 5e5;  // s, rad/s of each half: a step turns them 10⁻⁴ rad
  DrivenPair pair({}, kDt);
  World& world = pair.world;
  world.fracture.edges.strength[0] = strength;
  Nodes& nodes = world.model.nodes;
  for (std::size_t element = 0; element < 2; ++element) {
    const auto& corners = world.model.triangles.nodes[element];
    const Vec2 hinge = nodes.position[corners[0].value];
    for (const NodeId node : corners) {
      const Vec2 arm = nodes.position[node.value] - hinge;
      nodes.velocity[node.value] = (element == 0 ? kSpin : -kSpin) * Vec2{-arm.y, arm.x};
    }
  }
  const double start = totalEnergy(world);
  double worst = 0, turned = 0, released = 0;
  for (int n = 0; n < 40000; ++n) {
    world.step(kDt);
    worst = std::max(worst, std::abs(totalEnergy(world) / start - 1));
    turned += 2 * kSpin * kDt;
    if (released == 0 && world.fracture.cohesion.edge.empty()) released = turned;
  }
  EXPECT_GT(turned, 1.1 * std::numbers::pi);
  EXPECT_LT(worst, 1e-6);
  return released;
}

// An end that is open by 2δc breaks the whole edge. One that is so soft that it would be open by
// less at a right angle breaks there, where the faces have no common normal any more. Halves turn a
// little slower once the opening has taken its part.
TEST(ModeOne, ADoorOpensAllTheWayRound) {
  EXPECT_NEAR(doorsRelease(kStrength) / (2 * kCritical / kArea), 1, .1);
  EXPECT_NEAR(doorsRelease(1e6), std::numbers::pi / 2, .2);
}

constexpr double kStiff = 10e9, kSoft = 1e9, kRate = 1;  // Pa, Pa, 1/s
constexpr double kLength = .1, kHeight = .04;            // m

BodyMaterial brittle(double young, double strength, double energy) {
  return test::brittle({young, 0, 1000, true}, strength, energy);
}

/// The strain is even where the layers lie along the bar.
template <class NumberAt>
BodySpec drawn(const TriangleMesh& mesh, std::vector<BodyMaterial> materials, NumberAt numberAt,
               double rate = kRate) {
  BodySpec spec;
  draw(spec, mesh, kLength, rate);
  spec.materials.materials = std::move(materials);
  spec.materials.ofTriangle = byTriangle<std::uint32_t>(mesh, numberAt);
  return spec;
}

TriangleMesh barMesh() {
  return structuredRectangle({0, 0}, {kLength, kHeight}, 20, 8, QuadPattern::kCrossed);
}

int lowerHalf(Vec2 at) { return at.y < kHeight / 2 ? 0 : 1; }
int leftHalf(Vec2 at) { return at.x < kLength / 2 ? 0 : 1; }

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
TEST(Mixed, AWeakInterfaceCracksAlongItselfAlsoBetweenMaterialsThatDoNot) {
  const BodyMaterial stiff{{kStiff, 0, 1000, true}, {}, 0, {}},
      soft{{kSoft, 0, 1000, true}, {}, 0, {}};
  for (const std::vector<BodyMaterial>& materials :
       {std::vector{brittle(kStiff, 5e6, 100), brittle(kSoft, 5e6, 100)}, {stiff, soft}}) {
    constexpr double kWeak = 1e6, kEnergy = 20;
    const TriangleMesh mesh = barMesh();
    // Slowly: the waves of it have a hundredth of the stress that breaks it.
    BodySpec spec = drawn(mesh, materials, leftHalf, .02 / kLength);
    spec.places.joints = jointsWhere(mesh, kWeak, kEnergy,
                                     [](Vec2 x) { return std::abs(x.x - kLength / 2) < 1e-9; });
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
  spec.materials.ofTriangle = byTriangle<std::uint32_t>(mesh, [](Vec2 x) {
    return norm(x - Vec2{.05, .05}) < .02 ? 1 : 0;
  });
  draw(spec, mesh, .1, 2);
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

}  // namespace
}  // namespace yadefrag::test
