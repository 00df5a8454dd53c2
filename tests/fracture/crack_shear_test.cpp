// One edge between two triangles, pressed or pulled, and sheared: what holds it, against the law's
// curves, and where the work goes. Cohesive tractions create no angular momentum, whatever the law,
// and this costs no energy.

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "core/checks.hpp"
#include "fracture/cohesive_law.hpp"
#include "fracture/two_triangles.hpp"
#include "step/bodies.hpp"

namespace yadefrag::test {
namespace {

constexpr double kSpeed = 50;                                // m/s of each half
constexpr int kSteps = 200;                                  // from shut to δc, by tension
constexpr double kStep = kCritical / (2 * kSpeed) / kSteps;  // s

constexpr double kWeak = 1e-6;  // of the strength, before it cracks

struct Law {
  double beta = 1, kappa = 1, friction = 0;
  SofteningCurve curve{};

  [[nodiscard]] double critical() const { return curve.criticalOpening(kStrength, kEnergy); }
};

BodySpec specOf(const Law& law) {
  BodySpec spec;
  spec.friction = law.friction;
  spec.brittle.shearFactor = law.beta;
  spec.brittle.shearEnergyFactor = law.kappa;
  spec.brittle.softening = law.curve;
  return spec;
}

/// Hardly stretched.
DrivenPair pairOf(const Law& law) { return {specOf(law), kStep, kWeak}; }

void step(DrivenPair& pair, Vec2 speed, double pressure = 0) {
  pair.drive(speed, pressure);
  pair.step();
}

// --- fixed ratios of opening and slip

/// (of Gc) What is spent when the faces part in the direction `angle` (rad) from the normal.
double spentAt(const Law& law, double angle) {
  DrivenPair pair = pairOf(law);
  const Vec2 speed = kSpeed * Vec2{std::cos(angle), std::sin(angle)};
  for (int n = 0; n < 100 * kSteps && !pair.world.fracture.cohesion.edge.empty(); ++n)
    step(pair, speed);
  EXPECT_TRUE(pair.world.fracture.cohesion.edge.empty());
  EXPECT_LT(pair.worstEnergy, 1e-6 * kEnergy * kArea);
  return pair.world.ledger.fracture / (kEnergy * kArea);
}

/// The integral of T·dδ along a ray: of what δ² has of the opening, Gc, and of the slip, κGc.
double expectedAt(const Law& law, double angle) {
  const double normal = std::cos(angle), shear = law.beta / law.kappa * std::sin(angle);
  return (normal * normal + law.kappa * shear * shear) / (normal * normal + shear * shear);
}

// Work is a trapezoid sum below a straight line; forces keep the direction within a part of δ that
// is what the tractions move in a step, 3·10⁻⁵ of what the faces part in it. Mixed modes share the
// energy in the same parts for any curve. Long tails need more steps.
TEST(CrackShear, SpendsGcByTensionAndKappaGcByShear) {
  const auto check = [](const Law& law, double degrees, const std::string& name) {
    const double angle = degrees * std::numbers::pi / 180;
    EXPECT_NEAR(spentAt(law, angle) / expectedAt(law, angle), 1, .01)
        << name << ' ' << law.beta << ' ' << law.kappa << ' ' << degrees;
  };
  for (const Law& law : {Law{}, Law{2, 1}, Law{1, 4}, Law{2, 3}, Law{.7, .5}, Law{3, 9}}) {
    EXPECT_NEAR(spentAt(law, 0), 1, 1e-3);
    for (const double degrees : {10., 30., 45., 60., 80., 90., -45.}) check(law, degrees, "line");
    EXPECT_NEAR(expectedAt(law, std::numbers::pi / 2), law.kappa, 1e-12);
  }
  for (const auto& [name, curve] : softeningCurves())
    for (const double degrees : {0., 45., 90.}) check({2, 3, 0, curve}, degrees, name);
}

// --- pressed faces

/// (Pa) What the law gives in a step that ends at the slip `end` (m); `largest`: δmax.
double lawfulShear(const Law& law, double& largest, double end) {
  const double most = law.beta * envelope({law.curve, kStrength, law.critical()}, largest);
  const double opening = law.beta / law.kappa * end;
  const double shear = largest > 0 && std::abs(opening) < largest ? most * opening / largest
                                                                  : std::copysign(most, opening);
  largest = std::max(largest, std::abs(opening));
  return shear;
}

struct Rub {
  double worstShear = 0, worstPressure = 0;  // of σc + p
  double first = 0, last = 0;                // Pa, total shear
  double path = 0;                           // m
};

/// Slips to the wanted values in turn (of δc), pressed by `pressure`.
Rub rub(DrivenPair& pair, const Law& law, double pressure, std::initializer_list<double> turns) {
  std::array<double, 2> largest{};
  Rub result;
  for (const double turn : turns) {
    const double sign = turn * kCritical > pair.opening(0).y ? 1 : -1;
    for (int n = 0; n < 100 * kSteps && sign * (turn * kCritical - pair.opening(0).y) > 0; ++n) {
      const std::array<double, 2> begin{pair.opening(0).y, pair.opening(1).y};
      step(pair, {0, sign * kSpeed}, pressure);
      double wanted = sign * law.friction * pressure;
      for (std::size_t end = 0; end < 2; ++end) {
        wanted += lawfulShear(law, largest[end], pair.opening(end).y) / 2;
        result.path += std::abs(pair.opening(end).y - begin[end]) / 2;
      }
      const double whole = kStrength + pressure;
      result.worstShear = std::max(result.worstShear, std::abs(pair.traction.y - wanted) / whole);
      result.worstPressure =
          std::max(result.worstPressure, std::abs(pair.traction.x + pressure) / whole);
      if (result.first == 0) result.first = pair.traction.y;
      result.last = pair.traction.y;
    }
  }
  return result;
}

// βσc + μp at opening, to 10⁻⁵; then a straight line to μp at the slip κδc/β, step by step to 0.2
// %: what presses and holds the edge does not act on the triangles' tips, so that the faces turn by
// some 10⁻³. Its work is κGc and μp times the slip, each in its own entry.
TEST(CrackShear, PressedFacesHaveFrictionBesideCohesion) {
  for (const Law& law : {Law{1, 1, .5}, Law{2, 3, .5}, Law{1, 1, 0}, Law{.5, 1, 2}})
    for (const double part : {.1, 1., 3.}) {
      const double pressure = part * kStrength;
      DrivenPair pair = pairOf(law);
      const double rest = law.kappa / law.beta;  // of δc
      const Rub result = rub(pair, law, pressure, {.98 * rest});
      EXPECT_LT(result.worstShear, 2e-3);
      EXPECT_LT(result.worstPressure, 2e-3);
      EXPECT_NEAR(result.first, law.beta * kStrength + law.friction * pressure, 1e-5 * kStrength);
      EXPECT_NEAR(result.last, .02 * law.beta * kStrength + law.friction * pressure,
                  .005 * (law.beta * kStrength + pressure));
      EXPECT_LT(pair.worstEnergy, 1e-6 * kEnergy * kArea);
      const EnergyLedger& ledger = pair.world.ledger;
      const double rubbed = law.friction * pressure * result.path;
      EXPECT_NEAR(ledger.friction / kArea, rubbed, 3e-3 * rubbed);
      EXPECT_NEAR(ledger.fracture / kArea, law.kappa * kEnergy, 2e-3 * law.kappa * kEnergy);
    }
}

// The law goes back by its line to the origin and beyond; friction turns with the slip at once.
TEST(CrackShear, FrictionTurnsWithTheSlip) {
  const Law law{1, 1, .5};
  const double pressure = kStrength;
  DrivenPair pair = pairOf(law);
  const Rub result = rub(pair, law, pressure, {.4, -.3, .6, -.7, .2});
  EXPECT_LT(result.worstShear, 3e-3);
  EXPECT_LT(pair.worstEnergy, 1e-6 * kEnergy * kArea);
  const double rubbed = law.friction * pressure * result.path;
  EXPECT_NEAR(pair.world.ledger.friction / kArea, rubbed, .01 * rubbed);
}

// What friction and the law can hold does not move: below βσc + μp an edge that has cracked stays
// as it is, also after the law alone has given way.
TEST(CrackShear, RestsBelowWhatHoldsIt) {
  const Law law{1, 1, .5};
  for (const double slipped : {0., .5}) {
    DrivenPair pair = pairOf(law);
    if (slipped > 0) rub(pair, law, kStrength, {slipped});
    step(pair, {}, kStrength);  // what was kinetic energy is gone
    const Vec2 before = pair.opening(0);
    for (int n = 0; n < 200; ++n) step(pair, {}, kStrength);
    EXPECT_NEAR(norm(pair.opening(0) - before), 0, 1e-3 * kCritical) << slipped;
  }
}

// Nodes that are held in one direction, oblique to the edge: what pushes the faces apart moves them
// along the edge as well. Pressed by a force that swings they stay where they are, and friction
// gives nothing.
TEST(CrackShear, ObliqueHoldingIsNoException) {
  const Vec2 normal = std::sqrt(.5) * Vec2{1, 1}, along{-normal.y, normal.x};
  TriangleMesh mesh;
  mesh.nodes = {-kHalf * along, kHalf * along, -kHalf * normal, kHalf * normal};
  mesh.triangles = {{0, 1, 2}, {0, 3, 1}};
  mesh.loops = mesh.loopVertices = {{0, 3, 1, 2}};
  BodySpec spec = brittle(kStiff, kStrength, kEnergy);
  spec.friction = .5;
  spec.held = {kHeldY, kHeldY, 0, 0};
  for (const Vec2 x : mesh.nodes)
    spec.displacement.push_back(1.3 * kWeak * kStrength / 275e11 * dot(x, normal) * normal);
  World world;
  world.addBody(mesh, spec);
  world.fracture.edges.strength[0] *= kWeak;
  world.step(kStep);
  ASSERT_EQ(world.fracture.numCracks(), 1U);
  world.fracture.edges.strength[0] /= kWeak;
  const auto& left = world.model.triangles.nodes[0];
  const auto& right = world.model.triangles.nodes[1];
  for (int n = 0; n < 400; ++n) {
    const double force = 3 * kStrength * kHalf * (1 + .5 * std::sin(n / 5.));
    world.loads.outerForces.assign(world.model.nodes.size(), {});
    for (const std::size_t end : {0, 1}) {
      world.loads.outerForces[left[end].value].x = force;
      world.loads.outerForces[right[end == 0 ? 0 : 2].value].x = -force;
    }
    world.step(kStep);
    for (const std::size_t end : {0, 1})
      ASSERT_NEAR(norm(openingOf(world, end)), 0, 1e-6 * kCritical) << n;
    ASSERT_GT(world.ledger.friction, -1e-6 * kEnergy * kArea) << n;
  }
}

struct SpinLaw {
  double beta = 1, kappa = 1, energy = 2000, friction = 0;
  const char* curve = "linear";
};

double spinOf(const World& world) { return momentsOf(world.model.nodes).angular; }

/// A free block tears by its velocities, apart and along the line between its halves (m/s).
struct Torn {
  Torn(const SpinLaw& law, Vec2 apart) {
    const TriangleMesh mesh =
        triangulate(rectangle({-.01, -.01}, {.01, .01}), 2.5e-3, {NodeLayout::kScattered, 1});
    BodySpec spec = brittle({1e9, .2, 2000, false}, 1e6, law.energy);
    spec.friction = law.friction;
    spec.brittle.shearFactor = law.beta;
    spec.brittle.shearEnergyFactor = law.kappa;
    spec.brittle.softening = softeningNamed(law.curve);
    for (const Vec2 x : mesh.nodes) spec.velocity.push_back((x.y > 0 ? 1. : -1.) * apart);
    world.addBody(mesh, spec);
    dt = .5 * world.criticalTimeStep();
    world.step(dt);
    spin = spinOf(world), energy = totalEnergy(world), counted = world.ledger.spin;
    size = sumOfSpins(world.model.nodes);
  }

  void run(double duration) {
    while (world.time < duration) {
      world.step(dt);
      worstSpin = std::max(worstSpin, std::abs(spinOf(world) - spin));
      worstEnergy = std::max(worstEnergy, std::abs(totalEnergy(world) - energy));
    }
  }

  World world;
  double dt, spin, energy, counted, size, worstSpin = 0, worstEnergy = 0;
};

// Two triangles part obliquely, with and without friction: nothing but the law acts, so that only
// rounding is left.
TEST(CrackSpin, AnEdgeThatOpensObliquelyKeepsTheAngularMomentum) {
  for (const auto& [name, curve] : softeningCurves())
    for (const Law& law : {Law{1}, Law{3}, Law{.5}, Law{3, 4}, Law{3, 1, .6}}) {
      Law curved = law;
      curved.curve = curve;
      World world;
      addTwoTriangles(world, specOf(curved), 1.3);
      world.step(1e-11);
      Nodes& nodes = world.model.nodes;
      for (std::size_t element = 0; element < 2; ++element)
        for (const NodeId node : world.model.triangles.nodes[element])
          nodes.velocity[node.value] += (element == 0 ? -1. : 1.) * Vec2{30, 60};
      const double spin = spinOf(world), size = sumOfSpins(nodes), energy = totalEnergy(world);
      double worst = 0;
      for (int n = 0; n < 3000; ++n) {
        world.step(1e-11);
        worst = std::max(worst, std::abs(spinOf(world) - spin));
      }
      EXPECT_GT(world.ledger.fracture, .1 * kEnergy * kArea) << name;
      EXPECT_LT(worst, 1e-11 * size) << name << ' ' << law.beta << ' ' << law.kappa;
      EXPECT_NEAR(totalEnergy(world), energy, 1e-6 * kEnergy * kArea) << name;
    }
}

// Fragments that collide: their contact alone, without a fracture energy, creates up to 2.4·10⁻⁶ of
// Σ m r v; without the couple it was 3·10⁻⁴ with β = 1 and Gc = 500, 5·10⁻² with 3 and 2000.
TEST(CrackSpin, AFreeBlockThatTearsKeepsItsAngularMomentum) {
  for (const SpinLaw& law :
       {SpinLaw{}, SpinLaw{1, 1, 500}, SpinLaw{3}, SpinLaw{.5}, SpinLaw{3, 4},
        SpinLaw{1, 1, 2000, .6}, SpinLaw{3, 1, 500, .6}, SpinLaw{3, 1, 2000, 0, "petersson"},
        SpinLaw{3, 1, 2000, .6, "exponential"}}) {
    Torn torn(law, {3, 10});
    torn.run(4e-4);
    EXPECT_GT(torn.world.fracture.numCracks(), 50U);
    EXPECT_LT(torn.worstSpin, 3e-6 * torn.size)
        << law.beta << ' ' << law.energy << ' ' << law.curve;
    EXPECT_LT(torn.worstEnergy, 1e-4 * torn.energy) << law.beta << ' ' << law.energy;
    EXPECT_TRUE(torn.world.warnings.empty());
    // What the ledger counts is what is there.
    EXPECT_NEAR(torn.world.ledger.spin - torn.counted, spinOf(torn.world) - torn.spin,
                1e-9 * torn.size);
  }
}

TEST(EnergyWatch, TellsOfCreatedAngularMomentumOnce) {
  EnergyLedger ledger;
  EnergyWatch watch;
  const WatchedStep step{8, 1e-6, 1e-7, 0, 1e-3, 1e-3, ledger};
  EXPECT_FALSE(watch.mayHaveSpun(step));
  ledger.spin = 5e-4;
  EXPECT_TRUE(watch.mayHaveSpun(step));
  EXPECT_EQ(watch.spinMessage(step, 1), "");
  EXPECT_FALSE(watch.mayHaveSpun(step));  // nothing is evaluated again
  ledger.spin = -2e-3;
  EXPECT_TRUE(contains(watch.spinMessage(step, 1),
                       "0.2 % of the sum of m r v; take a shorter step, "
                       "which helps in about half"));
  EXPECT_FALSE(watch.mayHaveSpun(step));
  ledger.spin = -5e-3;
  EXPECT_NE(watch.spinMessage(step, 1), "");
}

}  // namespace
}  // namespace yadefrag::test
