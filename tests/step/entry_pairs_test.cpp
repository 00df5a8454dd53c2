// From boxes to slaves in their masters' halo: nothing is lost on the way.

#include "step/halo_watch.hpp"

#include <gtest/gtest.h>
#include <algorithm>
#include <cmath>

#include <set>

#include "contact/contact_scenes.hpp"

namespace yadefrag::test {
namespace {

using Pairs = std::set<SlaveMaster>;

/// Bodies of random shape, in part over one another; each third of the scenes is straight, smooth
/// or mixed.
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
  [[nodiscard]] bool mayTouch(SlaveMaster pair) const {
    const ContactSurfaces& s = scene.surfaces;
    const ComponentId owner = s.component[pair.slave.value];
    if (owner == s.component[pair.master.value] && !model.components[owner.value].selfContact)
      return false;
    return pair.slave != pair.master && s.prev[pair.slave.value] != pair.master;
  }
};

class EntryPairs : public testing::TestWithParam<int> {};

/// Every slave that is in a master's halo, none that may not touch it, each pair
/// once; and the same set with every search.
TEST_P(EntryPairs, AllSlavesInTheHaloForEverySearch) {
  Random random(80 + GetParam());
  std::size_t found = 0;
  for (int scene = 0; scene < 60; ++scene) {
    const RandomBodies bodies(random, GetParam());
    const double halo = even(random, .01, .2);
    PassRule rule;
    rule.update(bodies.scene.surfaces, bodies.scene.at, {.passes = 1 + scene % 2});
    const std::size_t count = bodies.scene.surfaces.entries();
    Pairs wanted;
    for (std::size_t s = 0; s < count; ++s)
      for (std::size_t m = 0; m < count; ++m) {
        const SlaveMaster pair{EntryId(s), EntryId(m)};
        if (bodies.mayTouch(pair) && bodies.distance(pair) <= halo &&
            rule.mayBeSlave(bodies.model, bodies.scene.surfaces, pair.slave, pair.master))
          wanted.insert(pair);
      }
    std::vector<SlaveMaster> brute = bodies.select(rule, halo, SearchMethod::kBruteForce);
    const Pairs all(brute.begin(), brute.end());
    ASSERT_EQ(all.size(), brute.size()) << "each pair once";
    for (const SlaveMaster pair : wanted) ASSERT_TRUE(all.contains(pair)) << "scene " << scene;
    for (const SlaveMaster pair : all) {
      ASSERT_TRUE(bodies.mayTouch(pair));
      ASSERT_TRUE(rule.mayBeSlave(bodies.model, bodies.scene.surfaces, pair.slave, pair.master));
    }
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

/// The guarantee of the halo: if no node has moved by more than δ/2, everything that touches was a
/// pair. Backwards: a point is put on a master, then all nodes go away from each other by up to δ/2
/// at random.
TEST_P(EntryPairs, AllThatTouchWithinTheHaloWerePairs) {
  Random random(90 + GetParam());
  int far = 0;
  for (int scene = 0; scene < 1000; ++scene) {
    RandomBodies bodies(random, GetParam());
    const double halo = even(random, .02, .15);
    const EntryId master(random() % bodies.scene.surfaces.entries());
    const PieceRange range = pieceRange(bodies.scene.surfaces.piece[master.value]);
    const double xi = even(random, range.begin, range.end);
    const EntryId tip = bodies.scene.addNeedle({even(random, -1, 1), 1});
    bodies.model.components.emplace_back();
    bodies.scene.moveNeedle(tip, bodies.scene.geometry().point(master, xi));
    for (Vec2& point : bodies.scene.at) {
      const double angle = even(random, 0, 7);
      point += .5 * halo * Vec2{std::cos(angle), std::sin(angle)};
    }
    PassRule rule;
    rule.update(bodies.scene.surfaces, bodies.scene.at, {.passes = 2});
    const auto pairs = bodies.select(rule, halo, SearchMethod::kLebesgue);
    far += bodies.distance({tip, master}) > halo / 2;
    ASSERT_TRUE(std::ranges::count(pairs, SlaveMaster{tip, master}) == 1) << "scene " << scene;
  }
  EXPECT_GT(far, 200);
}

/// The box is that of the piece, wider by half the halo on every side, flat.
TEST_P(EntryPairs, BoxCoversThePieceAndHalfTheHalo) {
  Random random(100 + GetParam());
  for (int scene = 0; scene < 50; ++scene) {
    const RandomBodies bodies(random, GetParam());
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

INSTANTIATE_TEST_SUITE_P(Surfaces, EntryPairs, testing::Values(0, 1, 2), smoothName);

}  // namespace
}  // namespace yadefrag::test
