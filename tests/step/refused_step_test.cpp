// A step that is refused has not been: all state is as before, to the last bit, and the run goes on
// as that of a copy that did not try the step, in any scene, at any moment, for any reason. What
// must not change a run, in every eventful scene: the number of threads, saving and loading at any
// moment, making anew what is not saved, and how often is searched and looked at what is apart. The
// bits are the same.

#include <gtest/gtest.h>

#include <algorithm>
#include <deque>
#include <new>
#include <set>
#include <utility>
#include <vector>

#include "core/checks.hpp"
#include "extremes/any_world.hpp"
#include "extremes/limits.hpp"
#include "step/bodies.hpp"
#include "step/eventful_scenes.hpp"

namespace yadefrag::test {
namespace {

/// A world that tries impossible steps, and one that does not.
class Twins {
 public:
  Twins(const Scene& scene, std::uint64_t seed)
      : asked_(scene()), spared_(scene()), chance_(seed), dt_(.3 * asked_.criticalTimeStep()) {}

  std::map<std::string, int> refusals;

  void run(int steps) {
    for (int i = 0; i < steps && !testing::Test::HasFailure(); ++i) {
      if (chance_.oneIn(8)) askForSteps();
      if (chance_.oneIn(8)) askWithForces();
      if (chance_.oneIn(8)) askWithBrittleCracks();
      if (chance_.oneIn(8)) askWithoutMemory();
      both(dt_);
      rows_ += asked_.contact.rows().size();
    }
  }
  [[nodiscard]] const World& world() const { return asked_; }
  [[nodiscard]] std::size_t rows() const { return rows_; }

 private:
  /// The sentence of the step, "" if it was taken.
  std::string attempt(const char* reason, double dt) {
    const State before = stateOf(asked_);
    std::string sentence = sentenceOf([&] { asked_.step(dt); });
    if (sentence.empty()) return sentence;
    ++refusals[reason];
    EXPECT_EQ(whatDiffers(before, stateOf(asked_)), "") << sentence;
    return sentence;
  }

  void both(double dt) {
    asked_.step(dt), spared_.step(dt);
    EXPECT_EQ(whatDiffers(stateOf(spared_), stateOf(asked_)), "") << "step " << asked_.steps;
  }

  void askForSteps() {
    const double critical = asked_.criticalTimeStep();
    for (const double dt : {1.01 * critical, 1e9 * critical, -dt_, 0., double(NAN)})
      EXPECT_NE(attempt("step", dt), "") << dt;
  }

  /// Cracks that would break within a step, before what they spend is resolved.
  void askWithBrittleCracks() {
    for (Component& component : asked_.model.components) {
      double& energy = component.brittle.fractureEnergy;
      if (energy == 0 || component.brittleByPlace) continue;
      const double kept = energy;
      energy = 1e-12 * kept;
      const double stable = std::exchange(asked_.stableStep, 0.);  // looked at anew
      EXPECT_TRUE(contains(attempt("opening", dt_), "does not resolve"));
      energy = kept;
      asked_.stableStep = stable;
    }
  }

  void askWithForces() {
    for (const double force : {double(NAN), double(INFINITY), -double(INFINITY), 1e308, 1e200})
      push("wild force", force, anyNode());
    // From hardly too much to far too much: too fast, inverted, through one another, jammed.
    for (int i = 0; i < 4; ++i) {
      const std::size_t node = anyNode();
      push("strong force", chance_.power(-1, 3) * asked_.model.nodes.mass[node] / (dt_ * dt_),
           node);
    }
  }

  std::size_t anyNode() {
    return static_cast<std::size_t>(chance_.below(static_cast<int>(asked_.model.nodes.size())));
  }

  void push(const char* reason, double force, std::size_t node) {
    std::vector<Vec2> forces(asked_.model.nodes.size());
    forces[node] = force * Vec2{1, chance_.from(-1, 1)};
    if (isAccepted(forces)) return;
    asked_.loads.outerForces = std::move(forces);
    std::string sentence = attempt(reason, dt_);
    EXPECT_NE(sentence, "") << force;
    for (const char* part : {"is inverted", "be missed", "a node moves by", "range of numbers",
                             "not finite", "contact moves", "is pressed to"})
      if (sentence.find(part) != std::string::npos) ++refusals[part];
    if (sentence.find("is inverted") != std::string::npos) {
      EXPECT_TRUE(contains(sentence, " of component "));
    }
    asked_.loads.outerForces.clear();
  }

  /// Tried on a copy: such a step would spoil the scene.
  bool isAccepted(const std::vector<Vec2>& forces) {
    World copy = copyOf(asked_);
    copy.loads.outerForces = forces;
    return sentenceOf([&] { copy.step(dt_); }).empty();
  }

  /// At every place of the step where memory is allocated, up to the last possible one.
  void askWithoutMemory() {
    for (std::size_t count = 0; count < 1000; ++count) {
      const State before = stateOf(asked_);
      const std::uint64_t steps = asked_.steps;
      try {
        const FailingMemory memory(count);
        asked_.step(dt_);
      } catch (const std::bad_alloc&) {
        ++refusals["memory"];
        if (asked_.steps == steps) {
          EXPECT_EQ(whatDiffers(before, stateOf(asked_)), "") << count;
          continue;
        }
        // The step stands, but not all that follows from it, as cracks: there is no going on.
        ++refusals["memory for cracks"];
        EXPECT_TRUE(contains(sentenceOf([&] { asked_.step(dt_); }), "state is incomplete"));
        spared_.step(dt_);
        asked_ = copyOf(spared_);
        return;
      }
      break;
    }
    spared_.step(dt_);
  }

  World asked_, spared_;
  Chance chance_;
  double dt_;
  std::size_t rows_ = 0;
};

TEST(RefusedStep, ChangesNothing) {
  std::map<std::string, int> refusals;
  const std::set<std::string> whole{"alone", "apart",  "axis",    "bonded",     "contact",
                                    "crowd", "driven", "flowing", "flowingToo", "large",
                                    "rigid", "smooth", "stressed"};
  for (const auto& [name, scene] : scenes()) {
    SCOPED_TRACE(name);
    for (const std::uint64_t seed :
         longRun() ? std::vector<std::uint64_t>{2, 3, 4} : std::vector<std::uint64_t>{3}) {
      Twins twins(scene, seed);
      twins.run(longRun() ? 2000 : 150);
      for (const auto& [reason, count] : twins.refusals) refusals[reason] += count;
      // Of pieces that cohesion holds only deep rows have a force.
      EXPECT_GE(twins.rows(), name == "alone" ? 0U : name == "bonded" ? 30U : 50U);
      EXPECT_EQ(twins.world().fracture.numCracks() > 0, whole.count(name) == 0);
      EXPECT_EQ(twins.world().dropped.count > 0, name == "dropped");
      for (const Component& body : twins.world().model.components) {
        const auto& strain = twins.world().model.triangles.plastic.strain;
        if (!name.starts_with("flowing")) continue;
        EXPECT_GT(std::ranges::max(std::span(strain).subspan(
                      body.firstTriangle, body.lastTriangle - body.firstTriangle)),
                  .01);
      }
    }
    if (HasFailure()) return;
  }
  for (const char* reason : {"step", "wild force", "strong force", "memory", "is inverted",
                             "be missed", "a node moves by", "range of numbers", "not finite"})
    EXPECT_GT(refusals[reason], 10) << reason;
  EXPECT_GT(refusals["opening"], 10);
  for (const auto& [reason, count] : refusals) RecordProperty(reason, count);
}

/// A body leaves and another one comes.
void exchangeBodies(World& world) {
  world.removeBody(ComponentId(3));
  const TriangleMesh mesh = structuredRectangle({-1.3, 2}, {-.7, 2.6}, 4, 3);
  world.addBody(mesh, moving(mesh, {1e7, .3, 1000, false}, {12, 0}));
}

class SameBits : public testing::TestWithParam<std::pair<const std::string, Scene>> {};

TEST_P(SameBits, ForAnyThreadsCopiesAndSearches) {
  const ThreadsForFew few;
  // Of the shorter run every second scene has one pass.
  const int alone = 1 + static_cast<int>(GetParam().first.size() % 2);
  for (const int passes : longRun() ? std::vector<int>{1, 2} : std::vector<int>{alone}) {
    SCOPED_TRACE(passes);
    const auto make = [&] {
      World world = GetParam().second();
      world.contactSettings.passes = passes;
      return world;
    };
    World world = make();
    const double dt = .3 * world.criticalTimeStep();
    std::deque<World> whole, motion;  // with the state of `world`; with its motion
    for (const int threads : {2, 3}) whole.emplace_back(make()).threads = threads;
    for (const double halo : {.05, .5}) motion.emplace_back(make()).contactSettings.halo = halo;
    World& rebuilt = motion.emplace_back(make());
    World& searched = motion.emplace_back(make());
    World& detected = motion.emplace_back(make());
    const int steps = longRun() ? 1000 : 150, every = longRun() ? 10 : 60;
    for (int i = 0; i < steps; ++i) {
      if (i == steps / 2 && GetParam().first == "crowd") {
        exchangeBodies(world);
        for (auto* worlds : {&whole, &motion}) std::ranges::for_each(*worlds, exchangeBodies);
      }
      if (i % every == 3) whole.push_back(copyOf(world));
      if (i % 40 == 39) rebuilt.rebuild();
      searched.search.makeDue();
      detected.contact.candidates.distances.clear();
      world.step(dt);
      const State state = stateOf(world);
      for (std::size_t k = 0; k < whole.size(); ++k) {
        whole[k].step(dt);
        ASSERT_EQ(whatDiffers(state, stateOf(whole[k])), "") << "step " << i << ", world " << k;
      }
      for (std::size_t k = 0; k < motion.size(); ++k) {
        motion[k].step(dt);
        ASSERT_TRUE(sameBits(world.model.nodes.position, motion[k].model.nodes.position) &&
                    sameBits(world.model.nodes.velocity, motion[k].model.nodes.velocity))
            << "step " << i << ", world " << k;
        ASSERT_EQ(world.fracture.numCracks(), motion[k].fracture.numCracks());
        ASSERT_EQ(world.ledger.dropped, motion[k].ledger.dropped);
        ASSERT_EQ(world.ledger.contact, motion[k].ledger.contact);
        ASSERT_EQ(world.ledger.friction, motion[k].ledger.friction);
        ASSERT_EQ(activesOf(world), activesOf(motion[k]));
      }
    }
    EXPECT_GE(searched.numSearches(), world.numSearches());
  }
}

INSTANTIATE_TEST_SUITE_P(Scenes, SameBits, testing::ValuesIn(scenes()),
                         [](const auto& test) { return test.param.first; });

}  // namespace
}  // namespace yadefrag::test
