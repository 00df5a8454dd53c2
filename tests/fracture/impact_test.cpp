// Impacts on brittle bodies.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "core/checks.hpp"
#include "fracture/overlaps.hpp"
#include "step/bodies.hpp"

namespace yadefrag::test {
namespace {

// --- An elastic cylinder on a brittle block (fig. 15 of the paper, small): what must hold while a
// body falls to pieces.

struct ImpactCase {
  const char* name;
  ImpactSetting setting;
  double growth, given = .003;  ///< least of the segments, most that contact may give
};

/// Cohesion takes its energy, and a free block keeps the momentum. The irregular mesh is that with
/// which `addPolygon` meshes what can crack; it is hit fastest.
const ImpactCase kImpacts[] = {
    {"InstantCracks", {.size = 8e-4}, 7},
    {"IrregularMesh", {.speed = 200, .nodes = NodeLayout::kScattered}, 7},
    // The tractions that keep the faces of a crack apart do not include what contact does
    // afterwards in the same step: one gives what the other takes. 0.013 measured, a third and a
    // ninth of it with half and a quarter of the step.
    {"Cohesion", {.fractureEnergy = 500}, 2, .02},
    {"FreeBlock", {.held = false}, 1}};

class Impact : public testing::TestWithParam<ImpactCase> {};

TEST_P(Impact, ABlockFallsToPieces) {
  const auto& [name, setting, growth, given] = GetParam();
  const ImpactResult result = runImpact(setting);
  record("cracks", static_cast<double>(result.cracks));
  record("growth", result.growth);
  EXPECT_GT(result.growth, growth);
  // What sweeps leave that end before all is solved, a part of a step's motion; up to 2e-4 of a
  // segment counts as touching.
  figure("deepest_in_segments", result.deepest, 0, 5e-4);
  figure("deepest_triangles_in_segments", result.triangles, 0, 5e-4);
  figure("energy_drift", result.drift, 0, .01);
  // Rounding of some 10⁴ sums; forces are summed by node in any order of size, 10³ nodes and 500
  // steps.
  figure("mass_error", result.massError, 0, 1e-12);
  if (!setting.held) figure("momentum_error", result.momentumError, 0, 1e-12);
  // Contact takes energy. It gives a little where it lets old overlaps out.
  figure("given_by_contact", result.given, 0, given);
  EXPECT_GT(result.contact, 0);
  record("contact", result.contact);
  record("fracture", result.fracture);
  EXPECT_EQ(result.fracture > 0, setting.fractureEnergy > 0);
}

INSTANTIATE_TEST_SUITE_P(Blocks, Impact, testing::ValuesIn(kImpacts),
                         [](const auto& test) { return test.param.name; });

// A block under compression that is weak along its diagonal and slides there. In the very step
// after the first faces come to light they push each other.
TEST(ImpactOn, NewFacesTouchInTheNextStep) {
  World world;
  const TriangleMesh mesh = structuredRectangle({0, 0}, {.01, .01}, 10, 10, QuadPattern::kCrossed);
  BodySpec spec = moving(mesh, {370e9, .22, 3900, false}, {0, 0});
  spec.brittle.tensileStrength = 50e6;
  hold(spec, mesh, kHeldXY, [](Vec2 at) { return at.y < 1e-9 || at.y > .01 - 1e-9; });
  for (const Vec2 at : mesh.nodes) spec.displacement.push_back({0, -1e-3 * at.y});
  world.addBody(mesh, spec);
  crackOnly(world, [](Vec2 x) { return std::abs(x.x - x.y) < 1e-9; });
  const double dt = .8 * world.criticalTimeStep();
  const std::size_t segments = world.surfaces.segments();
  int faces = -1;  // step in which the first ones came
  double deepest = 0;
  for (int i = 0; i < 1000; ++i) {
    world.step(dt);
    if (faces >= 0 && i == faces + 1) {
      EXPECT_TRUE(
          std::ranges::any_of(world.contact.forces().known, [](Vec2 f) { return norm(f) > 0; }));
    }
    // First the held corners part, which do not move.
    if (faces < 0 && world.surfaces.segments() > segments + 10) faces = i;
    deepest = std::max(deepest, deepestNode(world));
  }
  ASSERT_GE(faces, 0);
  EXPECT_EQ(world.fracture.numCracks(), 20U);
  // What a correction leaves of a step's motion.
  figure("deepest_in_segments", deepest / shortestSide(world), 0, 1e-3);
}

// --- Spall: a thin flyer strikes a thick brittle plate, in one dimension (ν = 0, lateral faces
// held in y). The compression, as long as twice the flyer, comes back from the free rear face as
// tension.
//
//   x from the rear face; the pulse's head is there at t = 0, its tail 2h/c later. Coming back, the
//   tensile head has reached x at t = x/c, but the tail of the compression is still passing until
//   t = 2h/c − x/c: there is net tension where both have gone by, first at x = h: the flyer's
//   thickness.
//
// An ideal pulse is a box: any strength below ρcv/2 is reached at x = h, there and then. Below half
// of it the plate fails in shear under the pulse itself.

const ElasticMaterial kCeramic{370e9, 0, 3900, false};
constexpr double kPlate = .020, kHeight = .0012;  // m

struct Spall {
  double firstCrack = -1;  ///< m, of the first crack's middle from the rear face
  double firstTime = -1;   ///< s, after the impact
  double energyError = 0;
  double momentumError = 0;  ///< of x
  double massError = 0;
  std::uint64_t cracks = 0;
};

ComponentId addPlate(World& world, double begin, double end, double size, double speed,
                     double strength, double share) {
  const int nx = static_cast<int>(std::lround((end - begin) / size));
  const int ny = static_cast<int>(std::lround(kHeight / size));
  TriangleMesh mesh =
      structuredRectangle({begin, 0}, {end, kHeight}, nx, ny, QuadPattern::kCrossed);
  jitter(mesh, share * Vec2{size, size}, std::mt19937(1), [=](Vec2 x) {
    const bool inside = x.x > begin + size / 8 && x.x < end - size / 8 && x.y > size / 8 &&
                        x.y < kHeight - size / 8;
    return inside ? Vec2{1, 1} : Vec2{};
  });
  BodySpec spec = moving(mesh, kCeramic, {speed, 0});
  spec.brittle.tensileStrength = strength;
  hold(spec, mesh, kHeldY, [](Vec2 at) { return at.y < 1e-9 || at.y > kHeight - 1e-9; });
  return world.addBody(mesh, spec);
}

/// `relative`: strength over the pulse's amplitude; `share`: of an element, by which nodes inside
/// are moved each way.
Spall strike(double size, double flyer, double relative, double share = 0) {
  constexpr double speed = 40;  // m/s
  World world;
  const double c = std::sqrt(kCeramic.waveModulus() / kCeramic.density);
  const double pulse = kCeramic.density * c * speed / 2;
  addPlate(world, -flyer, 0, size, speed, 0, share);
  const ComponentId plate = addPlate(world, 0, kPlate, size, 0, relative * pulse, share);
  const double energy = totalEnergy(world), start = momentum(world, ComponentId(0)).x;
  const double weight = mass(world, plate);
  const double dt = .8 * world.criticalTimeStep();
  Spall spall;
  while (world.time < 1.5 * kPlate / c + 2 * flyer / c) {
    world.step(dt);
    if (spall.firstTime >= 0 || world.fracture.numCracks() == 0) continue;
    spall.firstTime = world.time;
    const auto cracks = cracksOf(world);
    double sum = 0;
    for (const CrackLine& crack : cracks) sum += crack.middle().x;
    spall.firstCrack = kPlate - sum / static_cast<double>(cracks.size());
  }
  spall.cracks = world.fracture.numCracks();
  spall.energyError = totalEnergy(world) / energy - 1;
  spall.momentumError = (momentum(world, ComponentId(0)).x + momentum(world, plate).x) / start - 1;
  spall.massError = mass(world, plate) / weight - 1;
  return spall;
}

class SpallOf : public testing::TestWithParam<std::tuple<double, double, double, double>> {};

// A front is some elements wide, and a node's stress the mean of the elements around it: the first
// crack opens up to three elements' travel later than behind ideal fronts (1.9 and 2.2 measured),
// and at most one from the place where they part. On an irregular mesh lone elements are faster
// than the whole: with the critical step of the whole one of the shards was inverted.
TEST_P(SpallOf, OpensWhereTheWavesPart) {
  const auto [size, flyer, relative, share] = GetParam();
  const Spall spall = strike(size, flyer, relative, share);
  ASSERT_GT(spall.cracks, 0U);
  const double c = std::sqrt(kCeramic.waveModulus() / kCeramic.density);
  figure("place_in_elements", (spall.firstCrack - flyer) / size, 0, 1);
  figure("time_in_elements", (spall.firstTime - (kPlate + flyer) / c) * c / size, 1.5, 1.5);
  // The leapfrog's own error, and that of sums of some thousand values.
  figure("energy_error", spall.energyError, 0, 1e-5);
  figure("momentum_error", spall.momentumError, 0, 1e-12);
  figure("mass_error", spall.massError, 0, 1e-12);
}

INSTANTIATE_TEST_SUITE_P(SizesFlyersStrengthsShares, SpallOf,
                         testing::Combine(testing::Values(4e-4, 2e-4),
                                          testing::Values(.0028, .004, .006),
                                          testing::Values(.7, .9), testing::Values(0., .2)));

// Two fronts that meet ring: 1.44 was seen.
TEST(Spall, APlateStrongerThanThePulseHolds) { EXPECT_EQ(strike(4e-4, .004, 1.6).cracks, 0U); }

}  // namespace
}  // namespace yadefrag::test
