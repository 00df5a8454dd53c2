#include "core/disjoint_sets.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

namespace yadefrag::test {
namespace {

/// Against sets whose members are all renamed with each join.
TEST(DisjointSets, AreThoseOfAllThatHasBeenJoined) {
  std::mt19937_64 random(1);
  DisjointSets sets;
  for (int scene = 0; scene < 200; ++scene) {
    const std::size_t count = 1 + random() % 60;
    std::vector<std::uint32_t> name(count);
    for (std::uint32_t i = 0; i < count; ++i) name[i] = i;
    sets.reset(count);
    for (std::size_t k = random() % (2 * count); k > 0; --k) {
      const auto a = static_cast<std::uint32_t>(random() % count);
      const auto b = static_cast<std::uint32_t>(random() % count);
      sets.join(a, b);
      std::ranges::replace(name, std::uint32_t{name[a]}, std::uint32_t{name[b]});
    }
    for (std::uint32_t a = 0; a < count; ++a)
      for (std::uint32_t b = 0; b < count; ++b)
        ASSERT_EQ(sets.find(a) == sets.find(b), name[a] == name[b]);
  }
}

TEST(DisjointSets, LongChainsAreNoDeepCalls) {
  constexpr std::uint32_t kCount = 1'000'000;
  DisjointSets sets(kCount);
  for (std::uint32_t i = kCount - 1; i > 0; --i) sets.join(i - 1, i);
  EXPECT_EQ(sets.find(0), sets.find(kCount - 1));
  sets.reset(2);
  EXPECT_NE(sets.find(0), sets.find(1));
}

}  // namespace
}  // namespace yadefrag::test
