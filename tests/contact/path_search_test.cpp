// What the scan and its bounds leave out within a step, compared with a search
// that leaves out nothing.

#include <gtest/gtest.h>
#include <algorithm>
#include <cmath>

#include "contact/point_against_body.hpp"

namespace yadefrag::test {
namespace {

constexpr double kMove = .02, kCorrection = .01, kLeft = 2e-3;  // m

/// Four blocks around one point, whose corners and sides lie on one another, as after cracks; or
/// two stars that are about to meet, with straight, smooth and mixed boundaries.
SurfaceScene randomScene(Random& random, int kind) {
  SurfaceScene scene;
  if (kind == 0) {
    const Vec2 middle{even(random, -.3, .3), even(random, -.3, .3)};
    const Vec2 corner[4] = {{1, 1}, {-1, 1}, {-1, -1}, {1, -1}};
    const Vec2 side[4] = {{1, 0}, {0, 1}, {-1, 0}, {0, -1}};
    for (int k = 0; k < 4; ++k) scene.addBody({middle, side[k], corner[k], side[(k + 1) % 4]});
    return scene;
  }
  scene.addBody(star(random, {}, 1, 9, .3), smoothFlags(random, 9, kind - 1));
  scene.addBody(star(random, {2, 0}, 1, 9, .3), smoothFlags(random, 9, kind - 1));
  while (nearPairs(scene, false, kMove / 2).empty())
    for (std::size_t n = 9; n < 18; ++n) scene.at[n].x -= kMove / 2;
  return scene;
}

void moveAll(SurfaceScene& scene, Random& random, double most) {
  for (Vec2& place : scene.at) {
    const double angle = even(random, 0, 2 * std::numbers::pi);
    place += even(random, 0, most) * Vec2{std::cos(angle), std::sin(angle)};
  }
}

std::vector<Touch> someTouches(const std::vector<SlaveMaster>& pairs, Random& random) {
  std::vector<Touch> touches;
  for (const SlaveMaster& pair : pairs)
    if (random() % 4 == 0) touches.push_back({pair, 0, 0, 0});
  return touches;
}

struct Counts {
  std::size_t actives = 0, later = 0;
};

/// One step: the scan at x*, the actives there, then those after corrections.
void compareOneStep(Random& random, int kind, Counts& counts) {
  SurfaceScene scene = randomScene(random, kind);
  Candidates candidates;
  std::vector<SlaveMaster> pairs = allPairs(scene.surfaces, false);
  replaceCandidates(candidates, pairs);
  moveAll(scene, random, kLeft);
  const std::vector<Vec2> before = scene.at;
  const std::vector<Touch> touches = someTouches(nearPairs(scene, false, kLeft), random);
  double deepest = 0;
  for (const Touch& touch : touches)
    deepest = std::max(
        deepest,
        -scene.geometry().foot(touch.pair.master, scene.geometry().slave(touch.pair.slave)).gap);
  const PathStart start{before, touches, PointAgainstBody::kDepth, deepest};
  moveAll(scene, random, kMove);

  LocalSearch search, all;
  search.scan(candidates, scene.surfaces, scene.at, start, 2 * kMove, 1);
  double moved = 0;
  for (int detection = 0; detection < 3; ++detection) {
    std::vector<Active> found, wanted;
    search.findActives(candidates, scene.surfaces, scene.at, kUnlimited, found, {}, moved);
    Candidates fresh = candidates;
    all.scan(fresh, scene.surfaces, scene.at, start, kUnlimited, 1);
    all.findActives(fresh, scene.surfaces, scene.at, kUnlimited, wanted);
    ASSERT_EQ(pairsOf(found), pairsOf(wanted)) << "kind " << kind << ", detection " << detection;
    (detection == 0 ? counts.actives : counts.later) += found.size();
    moveAll(scene, random, kCorrection);
    moved += kCorrection;
  }
}

/// After some nodes have moved, slaves are tried again only where something near has moved: with
/// the actives of earlier detections, the result is that of a search that tries all.
void compareTriedAgain(Random& random, int kind, Counts& counts) {
  SurfaceScene scene = randomScene(random, kind);
  Candidates candidates;
  std::vector<SlaveMaster> pairs = allPairs(scene.surfaces, false);
  replaceCandidates(candidates, pairs);
  const std::vector<Vec2> before = scene.at;
  const PathStart start{before, {}, PointAgainstBody::kDepth, 0};
  moveAll(scene, random, kMove);
  LocalSearch search;
  // Twice as far as the nodes may move in all detections.
  const double reach = 2 * (kMove + 3 * kCorrection);
  search.scan(candidates, scene.surfaces, scene.at, start, reach, 1);
  std::vector<SlaveMaster> known;
  for (int detection = 0; detection < 3; ++detection) {
    std::vector<Active> found, wanted;
    search.findActives(candidates, scene.surfaces, scene.at, kUnlimited, found);
    LocalSearch all;
    Candidates fresh = candidates;
    fresh.idleDistance.clear();
    all.scan(fresh, scene.surfaces, scene.at, start, kUnlimited, 1);
    all.findActives(fresh, scene.surfaces, scene.at, kUnlimited, wanted);
    const std::vector<SlaveMaster> now = pairsOf(found), each = pairsOf(wanted);
    ASSERT_TRUE(std::ranges::includes(each, now)) << "kind " << kind << ", " << detection;
    known.insert(known.end(), now.begin(), now.end());
    std::ranges::sort(known);
    known.erase(std::unique(known.begin(), known.end()), known.end());
    ASSERT_TRUE(std::ranges::includes(known, each)) << "kind " << kind << ", " << detection;
    (detection == 0 ? counts.actives : counts.later) += each.size() - now.size();
    Vec2& one = scene.at[random() % scene.at.size()];
    one += kCorrection * Vec2{even(random, -1, 1), even(random, -1, 1)};
  }
}

template <class Compare>
Counts thousandScenes(Random& random, int kind, Compare compare) {
  Counts counts;
  for (int scene = 0; scene < 1000 && !testing::Test::HasFatalFailure(); ++scene)
    compare(random, kind, counts);
  return counts;
}

TEST(PathSearch, TriesAgainWhatHasMoved) {
  Random random(78);
  for (int kind = 0; kind < 4; ++kind) {
    const Counts counts = thousandScenes(random, kind, compareTriedAgain);
    EXPECT_EQ(counts.actives, 0U) << "the first detection tries all";
    EXPECT_GT(counts.later, 100U) << kind;
  }
}

TEST(PathSearch, LeavesOutNothingThatEnters) {
  Random random(77);
  for (int kind = 0; kind < 4; ++kind) {
    const Counts counts = thousandScenes(random, kind, compareOneStep);
    EXPECT_GT(counts.actives, 200U) << kind;
    EXPECT_GT(counts.later, 400U) << kind;
  }
}

}  // namespace
}  // namespace yadefrag::test
