// When the world searches, and that nothing is missed until it does.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <set>

#include "contact/contact_scenes.hpp"
#include "core/checks.hpp"
#include "core/tolerances/step.hpp"
#include "fracture/overlaps.hpp"
#include "step/bodies.hpp"
#include "step/search_schedule.hpp"

namespace yadefrag::test {
namespace {

/// Blocks in a row, fast enough that a step takes a good part of the halo.
World row(double speed, int passes) {
  World world = inPasses(passes);
  for (int k = 0; k < 4; ++k) {
    const Vec2 low{1.2 * k, .13 * k};
    addMoving(world, structuredRectangle(low, low + Vec2{1, 1}, 4 + k, 4 + k), rubber(),
              {k < 2 ? speed : -speed, 0});
  }
  return world;
}

/// (m) How far the farthest surface node is from where it was at the last search.
double farthest(const World& world) {
  double most = 0;
  for (std::size_t i = 0; i < world.search.nodes.size(); ++i)
    most = std::max(most, norm(world.model.nodes.position[world.search.nodes[i].value] -
                               world.search.positions[i]));
  return most;
}

/// (m) The farthest that contact moves a node by in a step.
double largestCorrection(const World& world, double dt) {
  double most = 0;
  for (std::size_t n = 0; n < world.model.nodes.size(); ++n)
    most = std::max(most, dt * dt / world.model.nodes.mass[n] * norm(world.contact.forces()[n]));
  return most;
}

/// Speeds up to 50 m/s, where sound is at 116 m/s, under forces that throw every node about at
/// random; at 60 m/s elements are pressed to a sixth of their area, which needs shorter steps. A
/// second world, put into the first one's state before each step, searches each time.
TEST(SearchInterval, NothingIsMissedAtTheLargestVelocities) {
  for (const double speed : {10., 40., 50.})
    for (const int passes : {1, 2}) {
      SCOPED_TRACE(testing::Message() << speed << ' ' << passes);
      World seldom = row(speed, passes), often = row(speed, passes);
      const double dt = .3 * seldom.criticalTimeStep();
      std::mt19937 random(7);
      std::uniform_real_distribution<double> any(-1, 1);
      const int steps = static_cast<int>(.25 / (speed * dt)) + 8;
      std::size_t touched = 0;
      for (int i = 0; i < steps; ++i) {
        std::vector<Vec2> forces(seldom.model.nodes.size());
        for (std::size_t n = 0; n < forces.size(); ++n)
          forces[n] =
              .02 * speed / dt * seldom.model.nodes.mass[n] * Vec2{any(random), any(random)};
        seldom.loads.outerForces = often.loads.outerForces = forces;
        often.search.makeDue();
        seldom.step(dt);
        often.step(dt);
        ASSERT_EQ(activesOf(seldom), activesOf(often)) << "step " << i;
        touched += seldom.contact.rows().size();
        // Only what is left of a penetration depends on the shortest segment at the search.
        for (std::size_t n = 0; n < seldom.model.nodes.size(); ++n)
          ASSERT_LE(norm(seldom.model.nodes.position[n] - often.model.nodes.position[n]), 1e-8);
        often.model.nodes.position = seldom.model.nodes.position;
        often.model.nodes.velocity = seldom.model.nodes.velocity;
      }
      EXPECT_GT(touched, 50U);
      EXPECT_LT(seldom.numSearches(), often.numSearches());
    }
}

/// δ is at most half the shortest segment, at least a twentieth, and wide enough for some dozen
/// steps at the largest velocity if that is less; only a motion of more than that in one step
/// widens it. The first step searches.
TEST(SearchInterval, WidthOfTheHalo) {
  for (const double speed : {.001, 1., 5., 10., 40., 100.}) {
    World world = row(speed, 1);
    const double dt = .3 * world.criticalTimeStep();
    const double shortest = shortestSide(world);
    world.step(dt);
    EXPECT_EQ(world.numSearches(), 1U);
    EXPECT_NEAR(world.search.shortest, shortest, 1e-15);
    const double move = 2 * tolerance::kHaloSpare * speed * dt;
    EXPECT_GE(world.search.halo, .05 * shortest * (1 - 1e-12));
    EXPECT_GE(world.search.halo, 2 * move * (1 - 1e-12));
    EXPECT_LE(world.search.halo, std::max(.5 * shortest, 2 * move) * (1 + 1e-12));
    const double steps = tolerance::kHaloSteps;
    if (steps * move > .05 * shortest && steps * move < .5 * shortest) {
      EXPECT_NEAR(world.search.halo / (steps * move), 1, 1e-12);
    }
  }
  World resting = row(0, 2);
  stepFor(resting, .5, 500);
  EXPECT_EQ(resting.numSearches(), 1U);
}

/// During a run: the halo is half the shortest segment at most, no node leaves it by more than the
/// correction of the step at hand, and bounds with the margin of any moment contain all surface
/// nodes until the next search. It is renewed no more often than the motion requires, hardly ever
/// in a step for which the one before has not foreseen it.
TEST(SearchInterval, HaloAndMarginHoldUntilTheNextSearch) {
  for (const double speed : {1., 10.}) {
    World world = row(speed, 2);
    EXPECT_EQ(world.search.boundMargin(), 0);
    const double dt = .5 * world.criticalTimeStep();
    const int steps = std::max(300, static_cast<int>(.6 / (speed * dt)));
    std::vector<std::pair<std::vector<Vec2>, double>> made;  // positions and margins
    std::uint64_t searches = 0, foreseen = 0;
    double most = 0;
    for (int i = 0; i < steps; ++i) {
      const bool isDue = world.search.isDue();
      world.step(dt);
      const double correction = largestCorrection(world, dt);
      const bool hasSearched = std::exchange(searches, world.numSearches()) != searches;
      if (hasSearched) made.clear();
      EXPECT_TRUE(hasSearched || !isDue);
      foreseen += isDue ? 1 : 0;
      ASSERT_LE(world.search.halo, .5 * world.search.shortest * (1 + 1e-12));
      ASSERT_LE(farthest(world), world.search.halo / 2 + correction);
      for (const auto& [position, margin] : made)
        for (const NodeId node : world.search.nodes) {
          const double moved = norm(world.model.nodes.position[node.value] - position[node.value]);
          ASSERT_LE(moved, margin + correction) << "step " << i;
          most = std::max(most, moved / margin);
        }
      made.emplace_back(world.model.nodes.position, world.search.boundMargin());
    }
    EXPECT_GT(most, .5);
    EXPECT_GT(searches, 1U);
    // k = δ/(2 u) steps (§4.1) hold at the fastest; blows make some nodes faster for a while.
    EXPECT_LE(searches, steps / 4U) << speed;
    EXPECT_LE(searches - foreseen, foreseen / 4);
  }
}

/// A collider has bounds of a body that is not searched itself.
TEST(SearchInterval, BodyThatTouchesNothingHasAMargin) {
  World world;
  const TriangleMesh mesh = structuredRectangle({0, 0}, {1, 1}, 4, 4);
  BodySpec spec = moving(mesh, rubber(), {1, 0});
  spec.selfContact = false;
  world.addBody(mesh, spec);
  world.step(.5 * world.criticalTimeStep());
  EXPECT_EQ(world.numSearches(), 0U);
  EXPECT_NEAR(world.search.shortest, .25, 1e-15);
  EXPECT_GE(world.search.boundMargin(), tolerance::kNarrowestHalo / 2 * .25);
}

/// The width of the halo decides how often it is searched; not where the nodes go: SameBits.
TEST(SearchInterval, WidthOfTheHaloMayBeSet) {
  std::vector<std::uint64_t> searches;
  for (const double width : {.5, .2, .05, 0.}) {
    World world = row(5, 2);
    world.contactSettings.halo = width;
    const double dt = .3 * world.criticalTimeStep();
    std::size_t touching = 0;
    for (int i = 0; i < 1200; ++i) {
      world.step(dt);
      if (i == 0 && width > 0) {
        EXPECT_NEAR(world.search.halo / world.search.shortest, width, 1e-12);
      }
      touching = std::max(touching, world.contact.rows().size());
    }
    EXPECT_GT(touching, 4U);
    searches.push_back(world.numSearches());
  }
  EXPECT_GT(searches[1], searches[0]);
  EXPECT_GT(searches[2], searches[1]);
}

/// A force throws nodes across the halo before a search is due: the step itself searches, at x*.
TEST(SearchInterval, EmergencySearch) {
  World world = twoPasses();
  world.contactSettings.constants.stop = 1e-6, world.contactSettings.constants.rowSweeps = 1000;
  addMoving(world, structuredRectangle({0, 0}, {1, 1}, 4, 4), rubber(), {});
  const ComponentId thrown =
      addMoving(world, structuredRectangle({1.03, .1}, {2.03, 1.1}, 5, 5), rubber(), {});
  const double dt = .5 * world.criticalTimeStep();
  world.step(dt);
  EXPECT_LT(world.search.halo, .03) << "too narrow for the gap";
  EXPECT_EQ(world.numSearches(), 1U);
  EXPECT_FALSE(world.search.isDue());
  EXPECT_EQ(world.contact.candidates.size(), 0U);
  world.loads.outerForces.assign(world.model.nodes.size(), {});
  for (std::size_t n = 0; n < world.model.nodes.size(); ++n)
    if (world.model.nodes.component[n] == thrown)
      world.loads.outerForces[n] = {-world.model.nodes.mass[n] * .05 / (dt * dt), 0};
  world.step(dt);
  EXPECT_EQ(world.numSearches(), 2U);
  EXPECT_FALSE(world.contact.rows().empty());
  EXPECT_LE(deepestNode(world), 1e-6);
  EXPECT_GE(world.search.halo, 2 * .05) << "as wide as the motion demands";
}

// --- From boxes to slaves in their masters' halo: nothing is lost on the way.

using Pairs = std::set<SlaveMaster>;

/// Random bodies, in part over one another; a third each are straight, smooth and mixed.
struct RandomBodies {
  SurfaceScene scene;
  Model model;

  RandomBodies(Random& random, int kind) {
    for (int body = 0; body < 4; ++body) {
      const int corners = 5 + static_cast<int>(random() % 12);
      const Vec2 centre{even(random, -1, 1), even(random, -1, 1)};
      scene.addBody(star(random, centre, even(random, .3, 1), corners, .4),
                    smoothFlags(random, corners, kind));
      model.components.emplace_back();
      model.components.back().selfContact = random() % 2 == 0;
    }
  }

  [[nodiscard]] std::vector<Box> boxes(double halo) const {
    std::vector<Box> found;
    for (std::size_t e = 0; e < scene.surfaces.entries(); ++e)
      found.push_back(entryBox(scene.surfaces, scene.at, EntryId(e), halo));
    return found;
  }

  [[nodiscard]] std::vector<SlaveMaster> select(const PassRule& rule, double halo,
                                                SearchMethod method) const {
    const std::vector<Box> all = boxes(halo);
    const auto search = makeSearch(method);
    std::vector<BoxPair> overlapping;
    search->update(all);
    search->findPairs(overlapping);
    std::vector<SlaveMaster> pairs;
    selectPairs(model, scene.surfaces, rule, scene.at, halo, overlapping, pairs);
    return pairs;
  }

  /// (m) The least distance of a slave from points all along a master.
  [[nodiscard]] double distance(SlaveMaster pair) const {
    const PieceGeometry geometry = scene.geometry();
    const PieceRange range = pieceRange(scene.surfaces.piece[pair.master.value]);
    double least = INFINITY;
    for (int i = 0; i <= 40; ++i) {
      const double xi = range.begin + i * (range.end - range.begin) / 40;
      least = std::min(least, norm(geometry.slave(pair.slave) - geometry.point(pair.master, xi)));
    }
    return least;
  }

  /// May they touch at all: other bodies, or the same one if it may, but not its own two pieces.
  [[nodiscard]] bool mayTouch(const PassRule& rule, SlaveMaster pair) const {
    const ContactSurfaces& s = scene.surfaces;
    const ComponentId owner = s.component[pair.slave.value];
    if (owner == s.component[pair.master.value] && !model.components[owner.value].selfContact)
      return false;
    return pair.slave != pair.master && s.prev[pair.slave.value] != pair.master &&
           rule.mayBeSlave(model, s, pair.slave, pair.master);
  }
};

/// Every slave in a master's halo, none that may not touch it, each once; with every search. So all
/// that touches after no node has moved by more than δ/2 was a pair.
TEST(EntryPairs, AllSlavesInTheHaloForEverySearch) {
  for (const int kind : kSmoothKinds) {
    SCOPED_TRACE(kind);
    Random random(80 + kind);
    std::size_t found = 0;
    for (int scene = 0; scene < 60; ++scene) {
      const RandomBodies bodies(random, kind);
      const double halo = even(random, .01, .2);
      PassRule rule;
      rule.update(bodies.scene.surfaces, bodies.scene.at, {.passes = 1 + scene % 2});
      const std::size_t count = bodies.scene.surfaces.entries();
      Pairs wanted;
      for (std::size_t s = 0; s < count; ++s)
        for (std::size_t m = 0; m < count; ++m) {
          const SlaveMaster pair{EntryId(s), EntryId(m)};
          if (bodies.mayTouch(rule, pair) && bodies.distance(pair) <= halo) wanted.insert(pair);
        }
      std::vector<SlaveMaster> brute = bodies.select(rule, halo, SearchMethod::kBruteForce);
      const Pairs all(brute.begin(), brute.end());
      ASSERT_EQ(all.size(), brute.size()) << "each pair once";
      for (const SlaveMaster pair : wanted) ASSERT_TRUE(all.contains(pair)) << "scene " << scene;
      for (const SlaveMaster pair : all) ASSERT_TRUE(bodies.mayTouch(rule, pair));
      for (const SearchMethod method :
           {SearchMethod::kLebesgue, SearchMethod::kLinearCode, SearchMethod::kHierarchy}) {
        const std::vector<SlaveMaster> other = bodies.select(rule, halo, method);
        ASSERT_EQ(other.size(), all.size());
        ASSERT_EQ(Pairs(other.begin(), other.end()), all);
      }
      found += all.size();
    }
    EXPECT_GT(found, 1000U);
  }
}

/// The box is that of the piece, wider by half the halo on every side, flat.
TEST(EntryPairs, BoxCoversThePieceAndHalfTheHalo) {
  for (const int kind : kSmoothKinds) {
    SCOPED_TRACE(kind);
    Random random(100 + kind);
    for (int scene = 0; scene < 50; ++scene) {
      const RandomBodies bodies(random, kind);
      const double halo = even(random, 0, .2);
      const std::vector<Box> boxes = bodies.boxes(halo);
      for (std::size_t e = 0; e < boxes.size(); ++e) {
        const PieceRange range = pieceRange(bodies.scene.surfaces.piece[e]);
        double room = INFINITY;
        for (int i = 0; i <= 50; ++i) {
          const double xi = range.begin + i * (range.end - range.begin) / 50;
          const Vec2 on = bodies.scene.geometry().point(EntryId(e), xi);
          room = std::min({room, on.x - boxes[e].min[0], boxes[e].max[0] - on.x,
                           on.y - boxes[e].min[1], boxes[e].max[1] - on.y});
        }
        ASSERT_GE(room, halo / 2 - 1e-14);
        // No wider than needed: tight for straight pieces, an arc's bulge at most for arcs.
        if (bodies.scene.surfaces.piece[e] != Piece::kArc) {
          ASSERT_LE(room, halo / 2 + 1e-14);
        }
        ASSERT_EQ(boxes[e].min[2], 0);
        ASSERT_EQ(boxes[e].max[2], 0);
      }
    }
  }
}

}  // namespace
}  // namespace yadefrag::test
