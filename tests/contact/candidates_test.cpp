// Rows of candidates.

#include "contact/candidates.hpp"

#include <gtest/gtest.h>
#include <algorithm>
#include <iterator>

#include "contact/contact_scenes.hpp"

namespace yadefrag::test {
namespace {

/// Ascending, if the rows are as they must be.
std::vector<SlaveMaster> pairsIn(const Candidates& candidates) {
  std::vector<SlaveMaster> pairs;
  EXPECT_EQ(candidates.offsets.size(), candidates.slaves.size() + 1);
  EXPECT_EQ(candidates.offsets.back(), candidates.masters.size());
  for (std::size_t row = 0; row < candidates.slaves.size(); ++row) {
    EXPECT_LT(candidates.offsets[row], candidates.offsets[row + 1]);
    for (std::uint32_t c = candidates.offsets[row]; c < candidates.offsets[row + 1]; ++c)
      pairs.push_back({candidates.slaves[row], candidates.masters[c]});
  }
  return pairs;
}

/// Whatever pairs come, go and stay.
TEST(Candidates, RowsContainTheGivenPairs) {
  Random random(5);
  SurfaceScene scene;
  scene.addBody(star(random, {0, 0}, 1, 9, .4));
  scene.addBody(star(random, {1.5, .2}, 1, 7, .4), {1, 1, 0, 1, 0, 0, 1});
  const std::vector<SlaveMaster> all = allPairs(scene.surfaces, true);
  const auto anyOf = [&](std::size_t one) {
    std::vector<SlaveMaster> pairs;
    for (const SlaveMaster& pair : all)
      if (random() % one != 0) pairs.push_back(pair);
    std::shuffle(pairs.begin(), pairs.end(), random);
    return pairs;
  };
  Candidates candidates;
  std::vector<SlaveMaster> former;
  for (int round = 0; round < 200; ++round) {
    std::vector<SlaveMaster> pairs = round % 20 == 7 ? anyOf(1) : anyOf(3), more = anyOf(2);
    const Candidates replaced = replaceCandidates(candidates, pairs);
    if (round > 0) {
      ASSERT_EQ(pairsIn(replaced), former);
    }
    ASSERT_EQ(pairsIn(candidates), pairs) << "sorted by the call";
    addCandidates(candidates, more);
    former.clear();
    std::set_union(pairs.begin(), pairs.end(), more.begin(), more.end(),
                   std::back_inserter(former));
    ASSERT_EQ(pairsIn(candidates), former);
  }
}

}  // namespace
}  // namespace yadefrag::test
