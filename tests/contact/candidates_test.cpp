// Rows of candidates, and where their outside flags come from (fig. 8).

#include "contact/candidates.hpp"

#include <gtest/gtest.h>
#include <algorithm>

#include <map>

#include "contact/contact_scenes.hpp"

namespace yadefrag::test {
namespace {

constexpr std::uint8_t kOutside = 1, kInside = 0;

std::vector<Vec2> square(Vec2 low, double edge) {
  return {low, low + Vec2{edge, 0}, low + Vec2{edge, edge}, low + Vec2{0, edge}};
}

std::map<SlaveMaster, std::uint8_t> flags(const Candidates& candidates) {
  std::map<SlaveMaster, std::uint8_t> found;
  for (std::size_t row = 0; row < candidates.slaves.size(); ++row)
    for (std::uint32_t c = candidates.offsets[row]; c < candidates.offsets[row + 1]; ++c)
      found[{candidates.slaves[row], candidates.masters[c]}] = candidates.outside[c];
  return found;
}

void expectRows(const Candidates& candidates) {
  ASSERT_EQ(candidates.offsets.size(), candidates.slaves.size() + 1);
  ASSERT_EQ(candidates.offsets.back(), candidates.masters.size());
  ASSERT_EQ(candidates.outside.size(), candidates.masters.size());
  ASSERT_TRUE(std::is_sorted(candidates.slaves.begin(), candidates.slaves.end()));
  for (std::size_t row = 0; row < candidates.slaves.size(); ++row) {
    const auto begin = candidates.masters.begin() + candidates.offsets[row];
    const auto end = candidates.masters.begin() + candidates.offsets[row + 1];
    ASSERT_LT(begin, end);
    ASSERT_EQ(std::adjacent_find(begin, end, std::greater_equal<>()), end);
  }
}

TEST(Candidates, FlagsOfNewPairsComeFromTheSideBefore) {
  SurfaceScene scene;
  const EntryId body = scene.addBody(square({0, 0}, 1));
  const EntryId tip = scene.addNeedle({0, -1});
  scene.moveNeedle(tip, {.5, 1.1});
  Candidates candidates;
  std::vector<SlaveMaster> pairs{{tip, body + 3}, {tip, body + 2}, {tip, body}, {tip, body + 1}};
  replaceCandidates(candidates, pairs, scene.surfaces, scene.at);
  expectRows(candidates);
  EXPECT_EQ(candidates.size(), 4U);
  // A point above the square is behind the lines of all other faces (B of fig. 8).
  EXPECT_EQ(candidates.outside, (std::vector<std::uint8_t>{kInside, kInside, kOutside, kInside}));
}

TEST(Candidates, LaidExactlyOnOneAnotherCountsAsOutside) {
  SurfaceScene scene;
  const EntryId body = scene.addBody(square({0, 0}, 1));
  const EntryId tip = scene.addNeedle({0, -1});
  for (const double gap : {0., -1e-16, -1e-10, -1e-8}) {
    scene.moveNeedle(tip, {.3, 1 + gap});
    Candidates candidates;
    std::vector<SlaveMaster> pairs{{tip, body + 2}};
    replaceCandidates(candidates, pairs, scene.surfaces, scene.at);
    EXPECT_EQ(candidates.outside.front(), gap > -1e-9 ? kOutside : kInside) << gap;
  }
}

TEST(Candidates, AnArcsFlagIsThatOfItsCurve) {
  SurfaceScene scene;
  const EntryId body = scene.addBody({{2, 0}, {0, 2}, {-2, 0}, {0, -2}}, {1, 1, 1, 1});
  const EntryId tip = scene.addNeedle({0, -1});
  const EntryId arc = body;  // around (0, 2), its summit at y = 2·h₂(½) = 1.375
  for (const double y : {1.38, 1.37}) {
    scene.moveNeedle(tip, {0, y});
    Candidates candidates;
    std::vector<SlaveMaster> pairs{{tip, arc}};
    replaceCandidates(candidates, pairs, scene.surfaces, scene.at);
    EXPECT_EQ(candidates.outside.front(), y > 1.375 ? kOutside : kInside);
  }
}

/// Whatever pairs come, go and stay: the flags of those that stay are kept though they contradict
/// the positions, the others' are from the positions.
TEST(Candidates, FlagsAreKeptOverNewSearches) {
  Random random(5);
  SurfaceScene scene;
  scene.addBody(star(random, {0, 0}, 1, 9, .4));
  scene.addBody(star(random, {1.5, .2}, 1, 7, .4), {1, 1, 0, 1, 0, 0, 1});
  const std::vector<SlaveMaster> all = allPairs(scene.surfaces, true);
  Candidates candidates;
  for (int round = 0; round < 200; ++round) {
    std::vector<SlaveMaster> pairs;
    for (const SlaveMaster& pair : all)
      if (random() % 3 != 0) pairs.push_back(pair);
    if (round % 20 == 7) pairs.clear();
    std::shuffle(pairs.begin(), pairs.end(), random);
    const auto former = flags(candidates);
    const std::size_t count = pairs.size();
    replaceCandidates(candidates, pairs, scene.surfaces, scene.at);
    expectRows(candidates);
    const auto now = flags(candidates);
    ASSERT_EQ(now.size(), count);
    for (const auto& [pair, flag] : now) {
      const auto known = former.find(pair);
      const double gap = scene.geometry().foot(pair.master, scene.geometry().slave(pair.slave)).gap;
      ASSERT_EQ(flag, known != former.end() ? known->second : gap >= -1e-12 ? kOutside : kInside);
    }
    for (std::uint8_t& flag : candidates.outside) flag = random() % 2;
  }
}

TEST(Candidates, NoneAtAll) {
  SurfaceScene scene;
  scene.addBody(square({0, 0}, 1));
  Candidates candidates;
  std::vector<SlaveMaster> pairs;
  replaceCandidates(candidates, pairs, scene.surfaces, scene.at);
  expectRows(candidates);
  EXPECT_EQ(candidates.size(), 0U);
}

}  // namespace
}  // namespace yadefrag::test
