// Random small scenes: nothing crashes, nothing is lost, every refusal is a sentence.
// YADEFRAG_SCENES / 50 of them (2000 by default), a million with YADEFRAG_LONG. Damaged saves.

#include <gtest/gtest.h>

#include <algorithm>
#include <boost/archive/binary_oarchive.hpp>
#include <cmath>
#include <cstdlib>

#include "core/checks.hpp"
#include "extremes/any_world.hpp"
#include "extremes/limits.hpp"
#include "fracture/random_cracks.hpp"
#include "step/bodies.hpp"
#include "step/eventful_scenes.hpp"

namespace yadefrag::test {
namespace {

std::uint64_t numScenes() {
  if (longRun()) return 1000000;
  const char* text = std::getenv("YADEFRAG_SCENES");
  return (text != nullptr ? std::strtoull(text, nullptr, 10) : 100000) / 50;
}

/// (of the energy) What no scene may gain in silence, but for what comes between two looks; and
/// where the step changes all the time, which few steps do not show.
constexpr double kMostGrowth = .01, kBetweenLooks = .005, kVaryingGrowth = 2;

struct Tally {
  std::uint64_t scenes = 0, steps = 0, refused = 0, givenUp = 0, cracked = 0, touched = 0;
  double momentum = 0;      ///< largest error, of Σm|v|
  std::uint64_t saved = 0;  ///< runs that went on from a saved state, too
  std::uint64_t grown = 0;  ///< stretches whose energy grew, all of them reported
  double growth = 0;        ///< of the energy, where nothing was reported
};

/// A scene from its first body to its last step.
class SceneRun {
 public:
  SceneRun(std::uint64_t seed, Tally& tally) : any_(seed), tally_(tally) {}

  void all() {
    for (int bodies = 1 + any_.chance().below(4); bodies > 0; --bodies)
      attempt([&] { any_.addBody(); });
    for (int stretches = 1 + any_.chance().below(3); stretches > 0 && goesOn_; --stretches) {
      move();
      if (goesOn_) attempt([&] { any_.change(); });
    }
    look();
    ++tally_.scenes, tally_.cracked += any_.world.fracture.numCracks() > 0 ? 1 : 0;
    tally_.touched += touched_ ? 1 : 0;
  }

 private:
  /// Refusals leave the scene as it was.
  template <class Call>
  bool attempt(Call call) {
    const World& world = any_.world;
    const std::size_t nodes = world.model.nodes.size(), bodies = world.model.components.size();
    const std::vector<Vec2> position = world.model.nodes.position;
    const std::string sentence = sentenceOf(call);
    if (sentence.empty()) return true;
    // A run that gives out goes back to the last good state.
    if (sentence.starts_with("Step ")) return goesOn_ = false;
    ++tally_.refused;
    EXPECT_EQ(world.model.nodes.size(), nodes) << sentence;
    EXPECT_EQ(world.model.components.size(), bodies) << sentence;
    EXPECT_TRUE(position == world.model.nodes.position) << sentence;
    return false;
  }

  void move() {
    World& world = any_.world;
    const double dt = any_.anyStep();
    const bool varies = any_.chance().oneIn(3);
    const double least = varies ? dt * any_.chance().power(-1.5, 0) : dt;
    const int steps = 5 + any_.chance().below(30);
    const Sums start = sumsOf(world.model);
    // The leapfrog's energy belongs to a step: that of the first one is the start.
    double energy = 0, growth = 0;
    double flow = 0;  // kg m/s
    for (int i = 0; i < steps && goesOn_; ++i) {
      if (i == 0 && !attempt([&] { world.step(dt); })) return;  // a step that is refused
      const double length = varies && i > 0 ? any_.chance().from(least, dt) : dt;
      if (i > 0) goesOn_ = step(length);
      ++tally_.steps;
      touched_ = touched_ || !world.contact.rows().empty();
      const Nodes& nodes = world.model.nodes;
      double now = 0;
      for (std::size_t n = 0; n < nodes.size(); ++n) now += nodes.mass[n] * norm(nodes.velocity[n]);
      for (const Vec2 force : world.contact.forces()) now += norm(force) * length;
      flow = std::max(flow, now);
      const double present = world.kineticEnergy() + world.strainEnergy();
      if (i == 0)
        energy = present + stored(), most_ = std::max({most_, energy, totalEnergy(world)});
      growth = std::max(growth, (present - energy) / most_);
    }
    tally_.givenUp += goesOn_ ? 0 : 1;
    if (!any_.isFree || flow == 0) return;
    const double lost = norm(sumsOf(world.model).momentum - start.momentum) / flow;
    tally_.momentum = std::max(tally_.momentum, lost);
    EXPECT_LT(lost, 1e-11);
    if (growth >= kMostGrowth) ++tally_.grown;
    if (!hasSaidSo() && !varies) tally_.growth = std::max(tally_.growth, growth);
    const double most = varies ? kVaryingGrowth : kMostGrowth + kBetweenLooks;
    EXPECT_TRUE(growth < most || hasSaidSo()) << growth;
  }

  /// False where the run gives out. At times it is saved and loaded, and goes on as if it were not.
  bool step(double dt) {
    World& world = any_.world;
    if (!any_.chance().oneIn(40)) return sentenceOf([&] { world.step(dt); }).empty();
    ++tally_.saved;
    World loaded = copyOf(world);
    loaded.threads = world.threads;
    std::string sentence;
    for (int i = 1 + any_.chance().below(10); i > 0 && sentence.empty(); --i) {
      sentence = sentenceOf([&] { world.step(dt); });
      EXPECT_EQ(sentenceOf([&] { loaded.step(dt); }), sentence);
      EXPECT_EQ(whatDiffers(stateOf(world), stateOf(loaded)), "");
      EXPECT_EQ(world.warnings, loaded.warnings);
    }
    world = std::move(loaded);
    return sentence.empty();
  }

  /// (J) What cracks that still hold may give back, and more.
  [[nodiscard]] double stored() const { return std::max(0., any_.world.ledger.fracture); }

  /// In a complaint, or at the end of the run, mostly about an inverted element.
  [[nodiscard]] bool hasSaidSo() const { return !goesOn_ || !any_.world.warnings.empty(); }

  /// Masses: checkFans.
  void look() {
    const World& world = any_.world;
    EXPECT_TRUE(std::ranges::all_of(world.model.nodes.position, isFinite));
    EXPECT_TRUE(std::ranges::all_of(world.model.nodes.velocity, isFinite));
    EXPECT_TRUE(!goesOn_ || std::isfinite(totalEnergy(world)));
    checkLaws(world.model, world.fracture.edges, world.surfaces);
  }

  AnyWorld any_;
  Tally& tally_;
  bool goesOn_ = true, touched_ = false;
  double most_ = 0;  // J, largest energy that the scene has had, as in the messages
};

TEST(ExtremeScenes, RunOrAreRefused) {
  Tally tally;
  for (std::uint64_t seed = 0; tally.scenes < numScenes(); ++seed) {
    SCOPED_TRACE("scene " + std::to_string(seed));
    SceneRun(seed, tally).all();
    if (HasFailure()) return;
  }
  const auto share = [&](std::uint64_t count) { return double(count) / double(tally.scenes); };
  record("steps", double(tally.steps)), record("saved", share(tally.saved));
  record("refused", share(tally.refused)), record("given_up", share(tally.givenUp));
  record("cracked", share(tally.cracked)), record("touched", share(tally.touched));
  record("momentum_error", tally.momentum), record("silent_growth", tally.growth);
  record("grown", share(tally.grown));
  EXPECT_GT(share(tally.touched), .2);
  EXPECT_GT(share(tally.cracked), .1);
}

// 48778: a state that was loaded cracked before its first search, when no roles of slave and master
// were known. 98693: a loaded state did not have the last step's largest correction, on which the
// reach of the first scan depends, and in rubble the order in which rows are found. 583913: at .73
// of the critical step the energy of a strongly deformed body varies by 2.4 %, without contact.
TEST(ExtremeScenes, ThatOnceFailed) {
  for (const std::uint64_t seed : {48778U, 98693U, 583913U}) {
    Tally tally;
    SceneRun(seed, tally).all();
    EXPECT_GT(tally.cracked, 0U);
    EXPECT_GT(tally.saved, 0U);
  }
}

// --- A damaged save is refused with a sentence: cut off anywhere, or with any bit turned.

/// Boost writes its own signature before all that is ours.
std::size_t headerSize() {
  std::ostringstream text;
  const boost::archive::binary_oarchive archive(text, boost::archive::no_codecvt);
  return text.str().size();
}

/// The critical step is computed when bodies are added or the step grows, not after loading.
TEST(ExtremeSaveOf, ARunGoesOnWithTheStepItHas) {
  World world;
  const TriangleMesh mesh = structuredRectangle({}, {1, 1}, 2, 2);
  world.addBody(mesh, moving(mesh, {1e9, .2, 1000, false}, {1, 0}));
  const double dt = .999 * world.criticalTimeStep();
  world.step(dt);
  // A stiffer material, for which the step is too long.
  world.model.components[0].material.young *= 1.1;
  ASSERT_LT(world.criticalTimeStep(), dt);
  World loaded;
  load(saved(world), loaded);
  EXPECT_EQ(sentenceOf([&] { loaded.step(dt); }), "");
  EXPECT_EQ(loaded.steps, 2U);
  EXPECT_NE(sentenceOf([&] { loaded.step(1.001 * dt); }), "");
}

/// The nodes of an elastic body take the numbers of those of a brittle one.
TEST(ExtremeSaveOf, AWorldThatABrittleBodyHasLeft) {
  World world = eventfulWorld(true);
  const TriangleMesh mesh = structuredRectangle({.04, 0}, {.05, .01}, 2, 2);
  world.addBody(mesh, moving(mesh, {1e9, .2, 1000, false}, {}));
  world.removeBody(ComponentId(1));
  for (std::size_t n = 0; n < world.fracture.edges.ofNode.size(); ++n)
    if (!world.model.components[world.model.nodes.component[n].value].brittle.cracks()) {
      EXPECT_EQ(world.fracture.edges.ofNode[n], ElementId::none()) << n;
    }
  World loaded;
  EXPECT_EQ(sentenceOf([&] { load(saved(world), loaded); }), "");
}

/// Of every byte that is looked at one bit, so that each place in a word has its turn.
TEST(ExtremeSaveOf, DamageAnywhereIsRefused) {
  World world = eventfulWorld(true);
  const std::string bytes = saved(world);
  // Loading these gives a sentence that names the part with the error.
  const auto isRefused = [](const std::string& damaged) {
    World loaded;
    const std::string sentence = sentenceOf([&] { load(damaged, loaded); });
    return sentence.starts_with("The saved state of FESolver is damaged");
  };
  const std::size_t header = headerSize();
  for (std::size_t size = header; size < bytes.size(); size += longRun() ? 1 : 97)
    ASSERT_TRUE(isRefused(bytes.substr(0, size))) << size << " of " << bytes.size() << " bytes";
  for (std::size_t at = header; at < bytes.size(); at += longRun() ? 1 : 53)
    for (int bit = longRun() ? 0 : static_cast<int>(at % 8); bit < 8; bit += longRun() ? 1 : 8) {
      std::string damaged = bytes;
      damaged[at] = static_cast<char>(damaged[at] ^ (1 << bit));
      ASSERT_TRUE(isRefused(damaged)) << "bit " << bit << " of byte " << at;
    }
}

// --- A release build and one for debugging give the same: both are held to the same figures.

/// (relative) Both give the same bits with Debian's compiler; another one's √ and sums may round
/// otherwise, and 300 steps of contact make some hundred times that of it.
constexpr double kAgreement = 1e-12;

// Cracks, cohesion, friction, smooth surfaces, two passes.
TEST(ExtremeBuilds, DebugAndReleaseAgree) {
  World world = eventfulWorld();
  for (int i = 0; i < 300; ++i) world.step(world.lastDt);
  const Nodes& nodes = world.model.nodes;
  ASSERT_EQ(nodes.size(), 291U);
  EXPECT_EQ(world.fracture.numCracks(), 113U);
  Vec2 places;
  double speeds = 0;
  for (std::size_t n = 0; n < nodes.size(); ++n)
    places += nodes.position[n], speeds += norm(nodes.velocity[n]);
  const auto expectNear = [](double value, double wanted) {
    EXPECT_NEAR(value, wanted, kAgreement * wanted);
  };
  expectNear(places.x, 3.6430002001557953);
  expectNear(places.y, 1.4470867826392377);
  expectNear(speeds, 4588.9575169372056);
  expectNear(totalEnergy(world), 89.999577295195351);
  expectNear(world.ledger.contact, 5.4998862107108364);
}

}  // namespace
}  // namespace yadefrag::test
