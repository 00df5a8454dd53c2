// Corners of bodies on one another: which of their pieces are masters, by their directions.

#include "contact/local_search.hpp"

#include <gtest/gtest.h>
#include <cmath>

#include "contact/point_against_body.hpp"

namespace yadefrag::test {
namespace {

/// After a step in which some nodes have moved from `before` to the scene's positions.
std::vector<Active> actives(const SurfaceScene& scene, std::vector<SlaveMaster> pairs,
                            const std::vector<Vec2>& before) {
  Candidates candidates;
  replaceCandidates(candidates, pairs);
  const PathStart start{before, {}, PointAgainstBody::kDepth, 0};
  LocalSearch search;
  std::vector<Active> found;
  search.scan(candidates, scene.surfaces, scene.at, start, kUnlimited, 1);
  search.findActives(candidates, scene.surfaces, scene.at, kUnlimited, found);
  return found;
}

const std::vector<Vec2> kSquare{{0, 0}, {1, 0}, {1, 1}, {0, 1}};

/// The lateral faces of blocks that lie on one another take no part.
TEST(LocalSearch, FacesThatDoNotOpposeAreNoMasters) {
  for (const double aside : {0., 1e-12, -1e-12, 1e-6, -1e-6}) {
    SurfaceScene scene;
    const EntryId low = scene.addBody(kSquare);
    scene.addBody({{aside, 1}, {1 + aside, 1}, {1 + aside, 2}, {aside, 2}});
    const std::vector<SlaveMaster> pairs = nearPairs(scene, false, .2);
    const std::vector<Vec2> before = scene.at;
    for (std::size_t n = 4; n < 8; ++n) scene.at[n].y -= .01;
    const std::vector<Active> found = actives(scene, pairs, before);
    ASSERT_FALSE(found.empty());
    for (const Active& active : found) {
      const bool down = active.pair.slave.value >= 4;
      EXPECT_EQ(active.pair.master, low + (down ? 2 : 4)) << aside;
    }
  }
}

class PassedTip : public testing::TestWithParam<std::pair<double, bool>> {};

/// Tips of 60° that have passed each other, sides along sides: no face of one opposes the face that
/// its tip is at, however the sides are turned to each other; but a corner that stands askew on a
/// face is held by it.
TEST_P(PassedTip, IsNoMatterOfTheFaceThatItGoesAlong) {
  const auto [turn, held] = GetParam();
  SurfaceScene scene;
  const EntryId left = scene.addBody({{0, 0}, {1, 0}, {.5, .87}});
  // From its tip the sides go at `turn` and `turn` + 60°, against the lower face of the left one.
  const auto at = [tip = Vec2{.05, -1e-3}](double angle) {
    return tip + Vec2{std::cos(angle), std::sin(angle)};
  };
  constexpr double kThird = std::numbers::pi / 3;
  const EntryId tip = scene.addBody({{.05, -1e-3}, at(turn), at(turn + kThird)});
  const std::vector<Vec2> before = scene.at;
  for (std::size_t n = 3; n < 6; ++n) scene.at[n].y += 2e-3;
  EXPECT_EQ(actives(scene, {{tip, left}}, before).size(), held ? 1U : 0U);
}

// Below the face the sides go at angles from -180° to 0.
INSTANTIATE_TEST_SUITE_P(
    Turns, PassedTip,
    testing::Values(std::pair{-2 * std::numbers::pi / 3, true}, std::pair{-std::numbers::pi, true},
                    std::pair{-std::numbers::pi / 3, true}, std::pair{-std::numbers::pi - .3, true},
                    std::pair{-std::numbers::pi / 3 + .3, true},
                    std::pair{-std::numbers::pi - .4, false},
                    std::pair{-std::numbers::pi / 3 + .4, false},
                    std::pair{2 * std::numbers::pi / 3, false}, std::pair{0., false}));

}  // namespace
}  // namespace yadefrag::test
