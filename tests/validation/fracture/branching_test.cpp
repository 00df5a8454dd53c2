// A crack that starts, runs and branches on irregular meshes, beside the same crack on a straight
// line, so that its path does not depend on the mesh.

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <numbers>
#include <vector>

#include "core/checks.hpp"
#include "fracture/laboratory.hpp"
#include "step/bodies.hpp"

namespace yadefrag::test {
namespace {

/// The plate of 100 × 40 mm with a notch to its middle whose long sides are pulled by 1 MPa from
/// the first step on, in plane strain (Borden et al. 2012, Comput. Methods Appl. Mech. Eng. 217,
/// 77; Song, Wang and Belytschko 2008, Comput. Mech. 42, 239).
struct PulledPlate {
  static constexpr double kLong = .1, kHigh = .04, kTip = kLong / 2;  // m
  static constexpr double kTraction = 1e6;                            // Pa
  static constexpr double kStrength = 3.08e6;                         // Pa
  static constexpr double kFractureEnergy = 3;                        // J/m²
  static constexpr double kRayleigh = 2125;                           // m/s
  static constexpr ElasticMaterial kMaterial{32e9, .2, 2450, false};

  static Polygon outline(double size) {
    return plateWithNotch({0, 0}, {kLong, kHigh}, {kTip, kHigh / 2}, size);
  }

  static BodySpec spec() { return brittle(kMaterial, kStrength, kFractureEnergy); }

  /// Adds the body and pulls it.
  static void add(World& world, const TriangleMesh& mesh, const BodySpec& spec) {
    world.addBody(mesh, spec);
    std::vector<Vec2> loads(mesh.nodes.size());
    for (const double y : {0., kHigh})
      addTraction(
          mesh, {0, y > 0 ? kTraction : -kTraction},
          [=](Vec2 x) { return std::abs(x.y - y) < 1e-9; }, loads);
    world.setLoads(loads);
  }
};

constexpr double kTip = PulledPlate::kTip;

struct Moment {
  double time = 0;  // s
  double tip = 0;   // m, of the foremost edge that holds nothing any more
  double work = 0;  // J/m, spent by the cohesive law
};

struct Growth {
  std::vector<Moment> moments;  // from the first edge that is through
  std::vector<CrackLine> open;  // at the end
  double lost = 0;              // of all energies, over the work of the loads
  double owed = 0;              // J/m, energies of the open edges

  [[nodiscard]] double start() const { return moments.front().time; }

  /// From the start until the tip has reached x = `end` (m).
  [[nodiscard]] std::vector<Moment> until(double end) const {
    std::vector<Moment> part;
    for (const Moment& moment : moments)
      if (moment.tip <= end) part.push_back(moment);
    return part;
  }
};

double tipOf(const World& world) {
  double tip = kTip;
  for (const CrackLine& edge : cracksOf(world, true))
    tip = std::max({tip, edge.first.x, edge.last.x});
  return tip;
}

/// Follows the crack until it has arrived at the far side, or until `enough`.
Growth follow(World& world, const std::function<bool(const Moment&)>& enough) {
  Growth run;
  const double dt = .8 * world.criticalTimeStep();
  while (world.time < 90e-6) {
    world.step(dt);
    if (world.fracture.cohesion.released.empty() && run.moments.empty()) continue;
    const Moment now{world.time, tipOf(world), world.ledger.fracture};
    run.moments.push_back(now);
    if (now.tip > .98 * PulledPlate::kLong || enough(now)) break;
  }
  run.open = cracksOf(world, true);
  run.lost = totalEnergy(world) / world.ledger.external;
  for (const CrackLine& line : run.open)
    run.owed += world.fracture.edges.fractureEnergy[line.edge.value] * norm(line.last - line.first);
  return run;
}

/// (m/s) Of a straight line through the tip's places.
double meanSpeed(const std::vector<Moment>& part) {
  double time = 0, tip = 0, along = 0, square = 0;
  const double n = static_cast<double>(part.size());
  for (const Moment& m : part) time += m.time / n, tip += m.tip / n;
  for (const Moment& m : part) {
    along += (m.time - time) * (m.tip - tip);
    square += (m.time - time) * (m.time - time);
  }
  return along / square;
}

/// Largest speed in 12 µs, over that of Rayleigh's waves. A crack goes ten to eighteen edges on in
/// that time; in 4 µs it goes three to six, and a jump across a side crack counts as speed.
double limitSpeed(const std::vector<Moment>& part) {
  constexpr double kWindow = 12e-6;  // s
  double fastest = 0;
  for (auto first = part.begin(); first != part.end(); ++first) {
    auto last = first;
    while (last != part.end() && last->time < first->time + kWindow) ++last;
    if (last == part.end()) break;
    fastest = std::max(fastest, meanSpeed({first, last}));
  }
  return fastest / PulledPlate::kRayleigh;
}

/// Spent over Gc, by length of the way.
double workByLength(const std::vector<Moment>& part) {
  return part.back().work / (PulledPlate::kFractureEnergy * (part.back().tip - kTip));
}

/// The crack on a line of edges, strength `factor` times the plate's; all other edges hold.
Growth straightCrack(double size, double factor, const std::function<bool(const Moment&)>& enough,
                     const RateEffect& speed = {}) {
  const JointLines line{
      {Vec2{kTip, PulledPlate::kHigh / 2}, Vec2{PulledPlate::kLong, PulledPlate::kHigh / 2}}};
  const TriangleMesh mesh =
      triangulate(PulledPlate::outline(size), size, {NodeLayout::kScattered, 1}, INFINITY, line);
  BodySpec spec = PulledPlate::spec();
  const double strength = factor * spec.brittle.tensileStrength;
  for (const auto& [a, b, joint] : mesh.joints)
    spec.places.joints.push_back({{a, b}, strength, spec.brittle.fractureEnergy});
  // A thousand times as strong, and as ductile, so that the step resolves its opening.
  spec.brittle.tensileStrength *= 1e3;
  spec.brittle.fractureEnergy *= 1e6;
  spec.brittle.speed = speed;
  World world;
  PulledPlate::add(world, mesh, spec);
  return follow(world, enough);
}

Growth freeCrack(std::uint64_t seed) {
  constexpr double kSize = 1e-3;  // m, ten elements in a cohesive zone
  World world;
  PulledPlate::add(world,
                   triangulate(PulledPlate::outline(kSize), kSize, {NodeLayout::kScattered, seed}),
                   PulledPlate::spec());
  return follow(world, [](const Moment&) { return false; });
}

/// (m) The first place from which on two cracks, 3 mm apart or more, run side by side for 2 mm;
/// infinite without.
double branchOf(const std::vector<CrackLine>& open) {
  constexpr double kApart = 3e-3, kStrip = 1e-3;  // m
  bool former = false;
  for (double x = kTip; x < PulledPlate::kLong - kStrip / 2; x += kStrip) {
    double low = INFINITY, high = -INFINITY;
    for (const CrackLine& edge : open) {
      const Vec2 at = edge.middle();
      if (at.x < x || at.x >= x + kStrip) continue;
      low = std::min(low, at.y);
      high = std::max(high, at.y);
    }
    const bool apart = high - low >= kApart;
    if (apart && former) return x - kStrip;
    former = apart;
  }
  return INFINITY;
}

/// (s) When the energy release rate at the notch is Gc. Waves from both sides arrive at H/2c and
/// pull the notch open with 2p. Until waves come back from the sides K = 2(2p)√(c t(1 − 2ν)/π)/(1 −
/// ν) (Freund 1990, Dynamic Fracture Mechanics, Cambridge, ch. 2), and G = K²(1 − ν²)/E.
double griffithStart() {
  const auto& [young, poisson, density, planeStress] = PulledPlate::kMaterial;
  const double speed = std::sqrt(PulledPlate::kMaterial.waveModulus() / density);
  const double perRoot = 4 * PulledPlate::kTraction / (1 - poisson) *
                         std::sqrt(speed * (1 - 2 * poisson) / std::numbers::pi);
  const double rate = perRoot * perRoot * (1 - poisson * poisson) / young;
  return PulledPlate::kHigh / 2 / speed + PulledPlate::kFractureEnergy / rate;
}

/// A cohesive zone takes longer to open than a sharp crack takes to start: 3.7, 1.8, 1.0 µs with 1,
/// 2, 4 times the strength, which is inverse to it. So twice the second less the first is the limit
/// of a short zone: 10.69 µs, where theory has 10.75. With elements twice as large it is 11.05 µs,
/// from the second and third 10.91: the tolerance of 5 % is half an element at the speed of a wave.
TEST(Branching, StartsWhenTheReleasedEnergySuffices) {
  const auto atOnce = [](const Moment&) { return true; };
  const double weak = straightCrack(.5e-3, 1, atOnce).start();
  const double strong = straightCrack(.25e-3, 2, atOnce).start();
  record("start_us", 1e6 * weak);
  record("start_twice_as_strong_us", 1e6 * strong);
  figure("start_over_theory", (2 * strong - weak) / griffithStart(), 1, .05);
}

/// On a straight line a crack of constant Gc, which spends Gc and nothing beside it, runs at .73 of
/// Rayleigh's speed, with any mesh (.5, 1 mm: .728, .724), and as two bodies that a bond holds,
/// without a criterion for edges (.730): the part that the plate's energy requires.
/// Free cracks are slower, as the next test has it.
TEST(Branching, StraightCrackSpendsItsFractureEnergy) {
  const Growth run = straightCrack(1e-3, 1, [](const Moment&) { return false; });
  figure("speed_over_rayleigh", limitSpeed(run.moments), .73, .03);
  figure("work_by_length", workByLength(run.moments), 1, .03);
  EXPECT_NEAR(run.lost, 0, 1e-5);
}

/// An energy that is four times as large at 2000 m/s as at 400 m/s slows the crack down, and is
/// spent edge by edge: the zone before the tip has spent a part, too, which is some percent. Edges
/// crack at uneven times, so that the mean of their factors is 11 % above the factor of the mean
/// speed.
TEST(Branching, StraightCrackSpendsTheEnergyOfItsSpeed) {
  const RateEffect effect({{400, 1}, {2000, 4}}, kCrackSpeed);
  const auto never = [](const Moment&) { return false; };
  const Growth run = straightCrack(1e-3, 1, never, effect);
  const Moment& end = run.moments.back();
  const double speed = (end.tip - kTip) / (end.time - run.start());
  const double mean = run.owed / (PulledPlate::kFractureEnergy * (end.tip - kTip));
  figure("work_over_energies", end.work / run.owed, 1, .05);
  figure("mean_factor_over_that_of_mean_speed", mean / effect.factor(speed), 1.07, .07);
  EXPECT_LT(limitSpeed(run.moments), .65);
  EXPECT_NEAR(run.lost, 0, 1e-5);
}

/// Free cracks: start, speed before they branch, place of the branch, on three meshes.
///   All that ten meshes of 1 mm, three of 0.7 and three of 0.5 mm have in common: through from
/// 14.8 to 15.9 µs (straight: 14.5, 14.8), .40 to .47 of Rayleigh's speed on the way until they
/// branch, at most .47 to .62 in 12 µs, at a cost of 1.4 to 2.1 Gc by length, since edges at the
/// side open in part: so they are slower than the straight crack. Ten of the sixteen branch, at 66
/// to 86 mm; which do, and where, changes with any detail (half the step, a scatter of 10 %).
TEST(Branching, FreeCracksOnThreeMeshes) {
  int branched = 0;
  std::array<double, 3> speed{};
  for (const std::uint64_t seed : {1, 2, 3}) {
    const std::string mesh = "_mesh_" + std::to_string(seed);
    const Growth run = freeCrack(seed);
    const double branch = branchOf(run.open);
    const std::vector<Moment> single = run.until(std::min(branch, .98 * PulledPlate::kLong));
    figure("start_us" + mesh, 1e6 * run.start(), 15.4, .7);
    speed[seed - 1] =
        (single.back().tip - kTip) / (single.back().time - run.start()) / PulledPlate::kRayleigh;
    record("mean_speed" + mesh, speed[seed - 1]);
    figure("limit_speed" + mesh, limitSpeed(single), .55, .1);
    figure("work_by_length" + mesh, workByLength(single), 1.75, .4);
    EXPECT_NEAR(run.lost, 0, 1e-5);
    if (branch == INFINITY) continue;
    ++branched;
    record("branch_mm" + mesh, 1e3 * branch);
    record("branch_us" + mesh, 1e6 * single.back().time);
    EXPECT_GT(branch, kTip + .01) << "one crack first";
  }
  EXPECT_GT(branched, 0);
  const auto [slow, fast] = std::ranges::minmax(speed);
  EXPECT_GT(slow, .38);
  EXPECT_LT(fast, 1.15 * slow) << "meshes agree";
}

// --- A crack that branches on a mesh that is symmetric about its line.

constexpr double kLong = PulledPlate::kLong, kHigh = PulledPlate::kHigh, kElement = 1e-3;  // m
constexpr double kRayleigh = PulledPlate::kRayleigh;                                       // m/s

/// One crack along the middle until two thirds of the way, then two that mirror each other, and a
/// tip that is slower than Rayleigh's waves. Measured: branches from x = 84 mm on (74 mm with half
/// the size), at the far side y = 13 and 29 mm, 5 µs means up to 1.4 km/s. Which of the branches
/// wins depends on the least of changes: of seven steps from 0.3 to 1 critical, both arrive at
/// four, with half the size at two of four; elsewhere one is left behind.
TEST(NotchedPlate, CrackBranchesSymmetrically) {
  World world;
  PulledPlate::add(world, triangulate(PulledPlate::outline(kElement), kElement),
                   PulledPlate::spec());
  const double dt = world.criticalTimeStep();
  double former = kLong / 2, next = 0, fastest = 0;
  while (world.time < 80e-6) {
    world.step(dt);
    if (world.time < next) continue;
    // Means over 5 µs: a tip that moves edge by edge has no speed at a moment.
    next += 5e-6;
    const double tip = tipOf(world);
    fastest = std::max(fastest, (tip - former) / 5e-6);
    former = tip;
  }
  EXPECT_LT(fastest, kRayleigh);
  EXPECT_GT(fastest, .3 * kRayleigh);
  const auto open = cracksOf(world, true);
  double upper = 0, lower = kHigh, stray = 0;
  for (const CrackLine& edge : open) {
    const Vec2 at = edge.middle();
    if (at.x < .07) stray = std::max(stray, std::abs(at.y - kHigh / 2));
    if (at.x < .095) continue;
    upper = std::max(upper, at.y);
    lower = std::min(lower, at.y);
  }
  EXPECT_LE(stray, 1.5 * kElement) << "one crack";
  EXPECT_GT(upper, .026) << "the upper branch arrives";
  EXPECT_LT(lower, .014) << "the lower branch arrives";
  EXPECT_NEAR(upper + lower, kHigh, 3 * kElement) << "symmetric, but for the mesh";
  EXPECT_NEAR(totalEnergy(world), 0, 1e-6 * world.ledger.external);
}

}  // namespace
}  // namespace yadefrag::test
