// Whole surfaces: smooth, straight, mixed, against another body or themselves; what the scan and
// the halo leave out is compared with every slave against every master.

#include <gtest/gtest.h>
#include <algorithm>
#include <cmath>

#include <map>

#include "contact/point_against_body.hpp"
#include "step/entry_pairs.hpp"

namespace yadefrag::test {
namespace {

std::vector<Vec2> circle(int count) {
  Random none;
  return star(none, {}, 1, count, 0);
}

/// §5.3: the normal of a smooth master is always there.
TEST(LocalSearch, ArcsHoldPointsUpToADepth) {
  const std::vector<std::uint8_t> smooth(12, 1);
  for (int i = 0; i < 100; ++i) {
    const double angle = .0628 * i + .01;
    const Vec2 out{std::cos(angle), std::sin(angle)};
    PointAgainstBody point(circle(12), smooth, -out, 1.1 * out);
    point.halo = .2;
    EXPECT_TRUE(point.masters(1.01 * out).empty());
    const std::vector<Active> actives = point.step(.95 * out, 1.1 * out);
    ASSERT_EQ(actives.size(), 1U) << angle;
    EXPECT_TRUE(actives[0].foot.inside);
    EXPECT_GT(dot(actives[0].foot.normal, out), .99);
    PointAgainstBody deep(circle(12), smooth, -out, 1.1 * out);
    deep.halo = .2;
    EXPECT_TRUE(deep.masters(.6 * out).empty()) << "deeper than the halo is on another side";
  }
}

std::vector<Active> find(LocalSearch& search, Candidates& candidates, const SurfaceScene& scene,
                         const std::vector<Vec2>& before, double reach, double halo,
                         double moved = INFINITY) {
  std::vector<Active> actives;
  const PathStart start{before, {}, PointAgainstBody::kDepth, 0};
  search.scan(candidates, scene.surfaces, scene.at, start, reach, 1, moved);
  search.findActives(candidates, scene.surfaces, scene.at, halo, actives);
  return actives;
}

/// Straight, smooth and mixed boundaries: what goes through a piece is active on it, by its depth.
TEST(LocalSearch, EveryPieceOfAnySurfaceKeepsPointsOut) {
  Random random(41);
  std::map<Piece, int> seen;
  for (int scene = 0; scene < 300; ++scene) {
    SurfaceScene s;
    const EntryId body = s.addBody(star(random, {}, 1, 9, .3), smoothFlags(random, 9, scene % 3));
    const std::size_t pieces = s.surfaces.entries() - body.value;
    for (std::size_t k = 0; k < pieces; ++k) {
      SurfaceScene with = s;
      const PieceRange range = pieceRange(s.surfaces.piece[k]);
      const double xi = range.begin + even(random, .1, .9) * (range.end - range.begin);
      const Vec2 on = s.geometry().point(body + k, xi), normal = s.geometry().normal(body + k, xi);
      const EntryId tip = with.addNeedle(-normal);
      with.moveNeedle(tip, on + 1e-4 * normal);
      std::vector<SlaveMaster> pairs = nearPairs(with, false, .1);
      std::erase_if(pairs, [&](SlaveMaster pair) { return pair.slave != tip; });
      Candidates candidates;
      replaceCandidates(candidates, pairs);
      const std::vector<Vec2> before = with.at;
      with.moveNeedle(tip, on - 1e-5 * normal);
      LocalSearch search;
      const std::vector<Active> actives = find(search, candidates, with, before, 2.2e-4, .1);
      ASSERT_EQ(actives.size(), 1U) << "scene " << scene << ", piece " << k;
      EXPECT_EQ(actives[0].pair.master, body + k);
      EXPECT_NEAR(actives[0].foot.gap, -1e-5, 1e-12);
      EXPECT_NEAR(actives[0].foot.xi, xi, 1e-7);
      ++seen[s.surfaces.piece[k]];
    }
  }
  for (const Piece piece : {Piece::kSegment, Piece::kFirstHalf, Piece::kSecondHalf, Piece::kArc})
    EXPECT_GT(seen[piece], 100);
}

/// Where pieces meet smoothly, at halfpoints, there is no gap through which a point could pass.
TEST(LocalSearch, JointsAtHalfpointsAreTight) {
  Random random(42);
  for (int scene = 0; scene < 200; ++scene) {
    SurfaceScene s;
    const EntryId body =
        s.addBody(star(random, {}, 1, 9, .3), smoothFlags(random, 9, 1 + scene % 2));
    const std::size_t pieces = s.surfaces.entries();
    for (std::size_t k = 0; k < pieces; ++k) {
      if (s.surfaces.slave(body + k).count != 2) continue;
      for (const double beside : {0., 1e-16, -1e-16, 1e-12, -1e-12, 1e-8, -1e-8}) {
        SurfaceScene with = s;
        const Vec2 normal = s.geometry().normal(body + k, s.geometry().range(body + k).begin);
        const Vec2 on = s.geometry().slave(body + k) + beside * rightOf(normal);
        const EntryId tip = with.addNeedle(-normal);
        with.moveNeedle(tip, on + 1e-4 * normal);
        std::vector<SlaveMaster> pairs = nearPairs(with, false, .1);
        std::erase_if(pairs, [&](SlaveMaster pair) { return pair.slave != tip; });
        Candidates candidates;
        replaceCandidates(candidates, pairs);
        const std::vector<Vec2> before = with.at;
        with.moveNeedle(tip, on - 1e-6 * normal);
        LocalSearch search;
        const std::vector<Active> actives = find(search, candidates, with, before, 2.2e-4, .1);
        ASSERT_GE(actives.size(), 1U) << "scene " << scene << ", piece " << k << ' ' << beside;
        for (const Active& active : actives) EXPECT_NEAR(active.foot.gap, -1e-6, 1e-9);
      }
    }
  }
}

/// Two searches of one course of events. One looks at every slave and every master in each step;
/// the other as World does: candidates in the halo, renewed when a node may have left it.
class TwoSearches {
 public:
  TwoSearches(SurfaceScene& scene, bool selfContact, double halo) : scene_(scene), halo_(halo) {
    for (std::uint32_t c = 0; c < scene.components; ++c) {
      model_.components.emplace_back();
      model_.components.back().selfContact = selfContact;
    }
    std::vector<SlaveMaster> pairs = allPairs(scene.surfaces, selfContact);
    replaceCandidates(all_, pairs);
    rule_.update(scene.surfaces, scene.at, {.passes = 2});
    renew();
  }

  /// From the scene's positions to `now`; the actives, which must be the same. None may be left
  /// from a step before.
  std::vector<Active> step(const std::vector<Vec2>& now) {
    const std::vector<Vec2> before = std::exchange(scene_.at, now);
    double moved = 0, left = 0;
    for (std::size_t n = 0; n < now.size(); ++n) {
      moved = std::max(moved, norm(now[n] - before[n]));
      left = std::max(left, norm(now[n] - searched_[n]));
    }
    if (left > halo_ / 2) renew();
    std::vector<Active> actives =
        find(search_, candidates_, scene_, before, 2 * moved + 1e-9, halo_, moved);
    const std::vector<Active> wanted =
        find(searchAll_, all_, scene_, before, 2 * moved + 1e-9, halo_);
    EXPECT_EQ(pairsOf(actives), pairsOf(wanted));
    return actives;
  }

  int searches = 0;

 private:
  void renew() {
    std::vector<Box> boxes;
    for (std::size_t e = 0; e < scene_.surfaces.entries(); ++e)
      boxes.push_back(entryBox(scene_.surfaces, scene_.at, EntryId(e), halo_));
    const auto brute = makeSearch(SearchMethod::kBruteForce);
    std::vector<BoxPair> overlapping;
    brute->update(boxes);
    brute->findPairs(overlapping);
    std::vector<SlaveMaster> pairs;
    selectPairs(model_, scene_.surfaces, rule_, scene_.at, halo_, overlapping, pairs);
    replaceCandidates(candidates_, pairs);
    searched_ = scene_.at;
    ++searches;
  }

  SurfaceScene& scene_;
  double halo_;
  Model model_;
  PassRule rule_;
  Candidates all_, candidates_;
  LocalSearch searchAll_, search_;
  std::vector<Vec2> searched_;
};

class EverySlaveAndMaster : public testing::TestWithParam<int> {};

/// Bodies that deform and close in on one another at random, until something touches.
TEST_P(EverySlaveAndMaster, TwoBodies) {
  Random random(50 + GetParam());
  int touched = 0, searches = 0, steps = 0;
  for (int run = 0; run < 400; ++run) {
    SurfaceScene scene;
    const int corners = 5 + static_cast<int>(random() % 10);
    scene.addBody(star(random, {}, 1, corners, .4), smoothFlags(random, corners, GetParam()));
    const std::size_t others = scene.at.size();
    const double angle = even(random, 0, 7);
    const Vec2 way{std::cos(angle), std::sin(angle)};
    const double aside = even(random, -1.5, 1.5);
    scene.addBody(star(random, 2.1 * way + aside * rightOf(way), 1, 8, .4),
                  smoothFlags(random, 8, GetParam()));
    constexpr double kSpeed = .01;
    TwoSearches both(scene, false, .08);
    for (int i = 0; i < 150; ++i) {
      std::vector<Vec2> now = scene.at;
      for (std::size_t n = 0; n < now.size(); ++n) {
        if (n >= others) now[n] -= kSpeed * way;
        now[n] += .1 * kSpeed * Vec2{even(random, -1, 1), even(random, -1, 1)};
      }
      ++steps;
      if (!both.step(now).empty()) {
        ++touched;
        break;
      }
      ASSERT_FALSE(HasFailure()) << "run " << run << ", step " << i;
    }
    searches += both.searches;
    ASSERT_FALSE(HasFailure()) << "run " << run;
  }
  EXPECT_GT(touched, 250);
  EXPECT_GT(steps, 2 * searches);
}

/// Jaws of one body that close.
TEST_P(EverySlaveAndMaster, OneBodyAndItself) {
  Random random(60 + GetParam());
  for (int run = 0; run < 200; ++run) {
    SurfaceScene scene;
    std::vector<Vec2> points{{0, 0}, {3, 0}, {3, 1}};
    for (int k = 5; k > 0; --k) points.push_back({.5 * k, even(random, .8, 1)});
    for (int k = 1; k < 6; ++k) points.push_back({.5 * k, even(random, 1.2, 1.4)});
    points.insert(points.end(), {{3, 1.3}, {3, 2.2}, {0, 2.2}});
    scene.addBody(points, smoothFlags(random, points.size(), GetParam()));
    const std::vector<Vec2> start = scene.at;
    TwoSearches both(scene, true, .08);
    bool touched = false;
    for (int i = 1; i < 200 && !touched; ++i) {
      std::vector<Vec2> now = scene.at;
      for (std::size_t n = 0; n < now.size(); ++n) {
        if (start[n].y > 1.1) now[n].y -= .003 * start[n].x / 3;
        now[n] += 3e-4 * Vec2{even(random, -1, 1), even(random, -1, 1)};
      }
      for (const Active& active : both.step(now)) {
        touched = true;
        const Vec2 slave = scene.geometry().slave(active.pair.slave);
        EXPECT_GT(slave.x, .4);
        EXPECT_GT(slave.y, .4);
        EXPECT_LT(slave.y, 1.8);
      }
      ASSERT_FALSE(HasFailure()) << "run " << run << ", step " << i;
    }
    EXPECT_TRUE(touched);
  }
}

/// A body that trembles but does not touch itself has no actives.
TEST_P(EverySlaveAndMaster, NothingTouchesItselfAtRest) {
  Random random(70 + GetParam());
  for (int run = 0; run < 300; ++run) {
    SurfaceScene scene;
    const int corners = 6 + static_cast<int>(random() % 15);
    scene.addBody(star(random, {}, 1, corners, .6), smoothFlags(random, corners, GetParam()));
    const std::vector<Vec2> start = scene.at;
    TwoSearches both(scene, true, .1);
    for (int i = 0; i < 20; ++i) {
      std::vector<Vec2> now = start;
      for (Vec2& point : now) point += 5e-3 * Vec2{even(random, -1, 1), even(random, -1, 1)};
      ASSERT_TRUE(both.step(now).empty()) << "run " << run << ", step " << i;
      ASSERT_FALSE(HasFailure()) << "run " << run << ", step " << i;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Surfaces, EverySlaveAndMaster, testing::Values(0, 1, 2), smoothName);

}  // namespace
}  // namespace yadefrag::test
