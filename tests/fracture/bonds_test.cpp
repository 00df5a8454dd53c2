// Bodies that are bonded along the sides that they have in common. Joints: lines with a strength
// and a fracture energy of their own, or open from the start.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "core/checks.hpp"
#include "extremes/limits.hpp"
#include "fracture/laboratory.hpp"
#include "step/bodies.hpp"

namespace yadefrag::test {
namespace {

// --- grains

TEST(Bonds, ABrickOfGrainsHoldsAndFallsApart) {
  // Four squares meet at a point; pulled apart, then driven against a wall.
  World world;
  for (int k = 0; k < 4; ++k) {
    const Vec2 low{k % 2 == 0 ? 0 : .02, k < 2 ? 0 : .02};
    addMoving(world, structuredRectangle(low, low + Vec2{.02, .02}, 4, 4), kMaterial, {0, -30});
  }
  const auto id = [](int k) { return ComponentId(static_cast<std::size_t>(k)); };
  for (const auto& [a, b] : {std::pair{0, 1}, {0, 2}, {1, 3}, {2, 3}})
    EXPECT_EQ(world.bond(id(a), id(b), 5e6, 50), 4U);
  const std::string text = sentenceOf([&] { world.bond(id(0), id(3), 5e6, 50); });
  EXPECT_TRUE(contains(text, "No sides of the bodies 0 and 3"));
  const TriangleMesh ground = structuredRectangle({-.02, -.0301}, {.035, -.0001}, 8, 4);
  BodySpec spec = moving(ground, kMaterial, {});
  hold(spec, ground, kHeldXY, [](Vec2 at) { return at.y < -.03; });
  world.addBody(ground, spec);
  const double dt = .5 * world.criticalTimeStep();
  const double start = totalEnergy(world);
  double deepest = 0;
  for (int i = 0; i < 2000; ++i) {
    world.step(dt);
    deepest = std::max(deepest, world.contact.maxPenetration());
  }
  EXPECT_LT(world.fracture.cohesion.edge.size(), 16U);  // some broke
  EXPECT_LT(deepest, 1e-2 * .005);
  EXPECT_NEAR(totalEnergy(world) / start, 1, .01);
}

TEST(Bonds, SmallFragmentsAroundABondAreNotTakenOut) {
  World world;
  const TriangleMesh left = barFrom(0, .04, 4), right = barFrom(.04, .08, 4);
  BodySpec spec = resting(left);
  world.addBody(left, spec);
  spec = moving(right, kMaterial, {20, 0});
  spec.brittle.tensileStrength = 1e9;
  world.addBody(right, spec);
  world.bond(kFirst, kSecond, 1e5, 1);
  world.fracture.minFragmentArea = 1e-5;
  stepFor(world, .5, 200);
  EXPECT_TRUE(world.fracture.cohesion.edge.empty());
  EXPECT_EQ(world.dropped.count, 0U);
}

TEST(Bonds, LeaveWithABody) {
  World world;
  for (const double begin : {0., .04, .08})
    addMoving(world, barFrom(begin, begin + .04, 4), kMaterial, begin > .05 ? Vec2{3, 1} : Vec2{});
  world.bond(kFirst, kSecond, 5e6, 50);
  world.bond(kSecond, kThird, 5e6, 50);
  const double dt = .5 * world.criticalTimeStep();
  for (int i = 0; i < 100; ++i) world.step(dt);
  world.removeBody(kFirst);
  EXPECT_EQ(world.fracture.edges.size(), 4U);
  for (const EdgeId edge : world.fracture.cohesion.edge) EXPECT_LT(edge.value, 4U);
  for (int i = 0; i < 100; ++i) world.step(dt);
}

TEST(Bonds, ImpossibleArgumentsAreRefusedAndTheWorldIsUnchanged) {
  const TriangleMesh left = barFrom(0, .04, 4), right = barFrom(.04, .08, 4);
  World world;
  for (const TriangleMesh& mesh : {left, right, barFrom(.09, .1, 4)})
    world.addBody(mesh, resting(mesh));
  const auto complaint = [&](ComponentId a, ComponentId b, double strength, double energy) {
    return sentenceOf([&] { world.bond(a, b, strength, energy); });
  };
  const ComponentId none(std::size_t{3});
  for (const auto& [text, words] : {std::pair{complaint(kFirst, kSecond, 0, 1), "strength is 0 Pa"},
                                    {complaint(kFirst, kSecond, 1, 0), "energy is 0 J/m²"},
                                    {complaint(kFirst, kSecond, INFINITY, 1), "strength is inf"},
                                    {complaint(kSecond, kThird, 1, 1), "No sides"},
                                    {complaint(kFirst, kFirst, 1, 1), "to itself"},
                                    {complaint(kFirst, none, 1, 1), "no body 3"}})
    EXPECT_TRUE(contains(text, words));
  EXPECT_EQ(world.fracture.edges.size(), 0U);
  EXPECT_TRUE(world.fracture.cohesion.edge.empty());
  world.bond(kFirst, kSecond, 1e6, 1);
  EXPECT_TRUE(contains(complaint(kFirst, kSecond, 1, 1), "not bonded yet"));
}

TEST(Bonds, AStepThatDoesNotResolveABondIsRefused) {
  World world;
  for (const double begin : {0., .04})
    addMoving(world, barFrom(begin, begin + .04, 4), kMaterial, {});
  world.bond(kFirst, kSecond, 1e8, .1);
  const double dt = .5 * world.criticalTimeStep();
  const std::string text = sentenceOf([&] { world.step(dt); });
  EXPECT_TRUE(contains(text, "energy is 0.1 J/m² of the bond between the bodies 0 and 1 at (0.04"));
  EXPECT_EQ(world.steps, 0U);
}

const MeshLayout kScattered{NodeLayout::kScattered, 1};

std::vector<JointEdge> withStrength(const TriangleMesh& mesh, double strength, double energy) {
  std::vector<JointEdge> edges;
  for (const auto& [a, b, joint] : mesh.joints) edges.push_back({{a, b}, strength, energy});
  return edges;
}

// --- a plate with a crack through its middle, of unit modulus, density and half width

constexpr ElasticMaterial kUnit{1, .3, 1, true};
constexpr double kHalfWidth = 1, kHalfHeight = 2, kHalfCrack = .4;

/// ∫ of G = K²/E over both tips for a unit stress, K = σ√(πa)·√(sec πa/2W) (Tada, Paris and Irwin,
/// The Stress Analysis of Cracks Handbook; 0.3 % for a/W = 0.4): the energy that the crack adds at
/// a given load.
double addedEnergy() {
  constexpr int kParts = 10000;
  double sum = 0;
  for (int i = 0; i < kParts; ++i) {
    const double a = kHalfCrack * (i + .5) / kParts;
    sum += 2 * M_PI * a / std::cos(M_PI * a / (2 * kHalfWidth)) * kHalfCrack / kParts;
  }
  return sum;
}

/// Ends that move apart by `strain` times the height, slowly enough, and then are at rest.
World plateAtRest(double size, const JointLines& joints, double strain) {
  const TriangleMesh mesh =
      triangulate(rectangle({-kHalfWidth, -kHalfHeight}, {kHalfWidth, kHalfHeight}), size,
                  kScattered, INFINITY, joints);
  BodySpec spec = moving(mesh, kUnit, {0, 0});
  for (const Vec2 node : mesh.nodes)
    spec.displacement.push_back({-kUnit.poisson * strain * node.x, strain * node.y});
  hold(spec, mesh, kHeldY, [](Vec2 at) { return std::abs(at.y) > kHalfHeight - 1e-9; });
  spec.brittle.tensileStrength = 1e6;
  spec.places.joints = withStrength(mesh, 0, NAN);
  World world;
  world.addBody(mesh, spec);
  world.dynamicsSettings.damping = 1.5;  // 1/s, nearly aperiodic for the longest wave
  const double dt = .8 * world.criticalTimeStep();
  while (world.time < 40) world.step(dt);
  return world;
}

/// Over theory's.
double addedCompliance(double size) {
  const JointLines crack{{{{-kHalfCrack, 0}, {kHalfCrack, 0}}}};
  constexpr double kStrain = 1e-4;
  const double whole = plateAtRest(size, {}, kStrain).strainEnergy();
  const World cracked = plateAtRest(size, crack, kStrain);
  EXPECT_LT(cracked.kineticEnergy(), 1e-6 * whole);
  EXPECT_EQ(cracked.fracture.numCracks(), 0);
  // At a given way U = w²/2C; at a unit stress, of the load 2W, the crack adds ΔC/2·(2W)².
  const double way = 2 * kHalfHeight * kStrain;
  const double compliance = way * way / 2 * (1 / cracked.strainEnergy() - 1 / whole);
  return compliance * 2 * kHalfWidth * kHalfWidth / addedEnergy();
}

TEST(Joints, APlateWithAnOpenJointHasTheComplianceOfACrackedOne) {
  const double coarse = addedCompliance(.1), fine = addedCompliance(.05);
  // Linear triangles around the tips make the crack shorter by a third of a side, and the
  // compliance goes with its square: what is left of the error at size 0 is that of two random
  // meshes.
  figure("added_compliance", fine, 1, .11);
  figure("added_compliance_at_size_0", 2 * fine - coarse, 1, .03);
}

TEST(Joints, AnOpenJointIsClosedByPressure) {
  const JointLines crack{{{{-kHalfCrack, .1}, {kHalfCrack, .1}}}};
  constexpr double kStrain = -1e-4;
  const World cracked = plateAtRest(.1, crack, kStrain);
  // Even strain: E ε²/2 in all of the area.
  const double wanted = kStrain * kStrain / 2 * 4 * kHalfWidth * kHalfHeight;
  EXPECT_NEAR(cracked.strainEnergy() / wanted, 1, 1e-3);
  EXPECT_GT(cracked.contact.rows().size(), 4);
}

TEST(Joints, OpenJointsCutABodyBeforeTheFirstStep) {
  const TriangleMesh mesh =
      triangulate(rectangle({0, 0}, {2, 1}), .1, kScattered, INFINITY, {{{{.8, -1}, {.8, 2}}}});
  BodySpec spec = moving(mesh, kUnit, {.1, 0});
  spec.brittle.tensileStrength = 1;
  spec.places.joints = withStrength(mesh, 0, NAN);
  World world;
  const ComponentId body = world.addBody(mesh, spec);
  EXPECT_EQ(world.model.nodes.size(), mesh.nodes.size() + mesh.joints.size() + 1);
  EXPECT_EQ(world.model.nodes.reference.size(), world.model.nodes.size());
  EXPECT_NEAR(mass(world, body), 2, 1e-12);
  EXPECT_NEAR(totalEnergy(world), .01, 1e-12);
  EXPECT_EQ(world.fracture.numCracks(), 0);
  // Half of it is stopped: the other one leaves.
  std::vector<NodeId> left;
  for (std::uint32_t e = 0; e < world.model.triangles.size(); ++e)
    if (middleOf(world, e).x < .8)
      for (const NodeId node : world.model.triangles.nodes[e]) left.push_back(node);
  world.prescribe(left, kHeldXY, {0, 0});
  stepFor(world, .5, 200);
  for (std::uint32_t n = 0; n < world.model.nodes.size(); ++n)
    EXPECT_NEAR(world.model.nodes.velocity[n].x, std::ranges::count(left, NodeId(n)) > 0 ? 0 : .1,
                1e-12);
}

// --- a bar with a joint across

constexpr ElasticMaterial kBar{1e9, 0, 1000, true};
constexpr double kLength = .1, kHeight = .02, kThickness = .01, kSection = .07;  // m
constexpr double kStrength = 2e6, kRate = 2;                                     // Pa, 1/s

struct Broken {
  double stress = 0;    ///< Pa, at the first crack
  double spent = 0;     ///< J, at the end
  double farthest = 0;  ///< m, of all cracks, from the section
  std::uint64_t cracks = 0;
  std::size_t joints = 0;
};

Broken breakBar(double jointStrength, double jointEnergy, double size) {
  const TriangleMesh mesh = triangulate(rectangle({0, 0}, {kLength, kHeight}), size, kScattered,
                                        INFINITY, {{{{kSection, 0}, {kSection, kHeight}}}});
  BodySpec spec = brittle(kBar, kStrength, 100);
  draw(spec, mesh, kLength, kRate);
  spec.thickness = kThickness;
  spec.places.joints = withStrength(mesh, jointStrength, jointEnergy);
  World world;
  world.addBody(mesh, spec);
  const double dt = .5 * world.criticalTimeStep();
  Broken broken;
  broken.joints = mesh.joints.size();
  while (world.time < .0025) {
    world.step(dt);
    if (broken.stress == 0 && world.fracture.numCracks() > 0)
      broken.stress = kBar.young * kRate * world.time;
  }
  for (const CrackLine& crack : cracksOf(world))
    for (const Vec2 end : {crack.first, crack.last})
      broken.farthest = std::max(broken.farthest, std::abs(end.x - kSection));
  broken.spent = world.ledger.fracture;
  broken.cracks = world.fracture.numCracks();
  return broken;
}

TEST(Joints, AJointOfHalfTheStrengthBreaksAtHalfTheLoadAndTakesItsOwnEnergy) {
  constexpr double kEnergy = 20;
  const Broken half = breakBar(kStrength / 2, kEnergy, .003);
  // To the last step before, and to the strain's square.
  EXPECT_NEAR(half.stress / (kStrength / 2), 1, 5e-3);
  EXPECT_LT(half.farthest, 1e-9);
  EXPECT_EQ(half.cracks, half.joints);
  EXPECT_NEAR(half.spent / (kEnergy * kHeight * kThickness), 1, 1e-3);
  // One as strong as the rest is none: the first edges to crack are any that lie across the load.
  EXPECT_NEAR(breakBar(kStrength, NAN, .003).stress / kStrength, 1, 5e-3);
  EXPECT_NEAR(breakBar(10 * kStrength, NAN, .003).stress / kStrength, 1, .03);
}

}  // namespace
}  // namespace yadefrag::test
