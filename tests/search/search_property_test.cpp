// Every search finds exactly the pairs of brute force, in random scenes whose boxes move, jump,
// appear and vanish. YADEFRAG_SCENES sets the number of scenes (default 30,000).
#include <gtest/gtest.h>
#include <memory>

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "random_scenes.hpp"
#include "search/contact_search.hpp"

namespace yadefrag {
namespace {

std::uint64_t sceneCount() {
  const char* text = std::getenv("YADEFRAG_SCENES");
  return text ? std::strtoull(text, nullptr, 10) : 30000;
}

std::vector<BoxPair> sortedPairs(ContactSearch& search, const std::vector<Box>& boxes) {
  std::vector<BoxPair> pairs;
  search.update(boxes);
  search.findPairs(pairs);
  std::sort(pairs.begin(), pairs.end());
  return pairs;
}

constexpr SearchMethod kMethods[] = {SearchMethod::kLebesgue, SearchMethod::kLinearCode,
                                     SearchMethod::kSweptRows, SearchMethod::kFastest,
                                     SearchMethod::kHierarchy};

TEST(SearchProperty, SamePairsAsBruteForce) {
  const std::uint64_t scenes = sceneCount();
  std::uint64_t found = 0;
  for (std::uint64_t seed = 0; seed < scenes; ++seed) {
    RandomScene scene(seed);
    const auto brute = makeSearch(SearchMethod::kBruteForce);
    std::vector<std::unique_ptr<ContactSearch>> searches;
    for (const SearchMethod method : kMethods) searches.push_back(makeSearch(method, seed % 2));
    for (int step = 0; step < 4; ++step) {
      const std::vector<BoxPair> expected = sortedPairs(*brute, scene.boxes());
      found += expected.size();
      for (std::size_t k = 0; k < searches.size(); ++k)
        ASSERT_EQ(sortedPairs(*searches[k], scene.boxes()), expected)
            << "seed " << seed << ", step " << step << ", method " << k;
      scene.step();
    }
  }
  EXPECT_GT(found, 10 * scenes) << "scenes too empty to prove anything";
}

TEST(SearchProperty, SameOverlapsAsBruteForce) {
  const std::uint64_t scenes = std::max<std::uint64_t>(sceneCount() / 50, 100);
  for (std::uint64_t seed = 0; seed < scenes; ++seed) {
    RandomScene scene(seed), probes(seed + 1);
    const auto brute = makeSearch(SearchMethod::kBruteForce);
    brute->update(scene.boxes());
    for (const SearchMethod method : kMethods) {
      const auto search = makeSearch(method);
      search->update(scene.boxes());
      for (const std::vector<Box>& from : {scene.boxes(), probes.boxes()})
        for (const Box& box : from) {
          std::vector<BoxId> expected, found;
          brute->findOverlaps(box, expected);
          search->findOverlaps(box, found);
          std::sort(found.begin(), found.end());
          ASSERT_EQ(found, expected) << "seed " << seed;
        }
    }
  }
}

TEST(SearchProperty, SameOrderForAnyNumberOfThreads) {
  std::mt19937_64 random(9);
  std::uniform_real_distribution<double> place(0, 30);
  std::vector<Box> boxes(20000);
  for (std::size_t i = 0; i < boxes.size(); ++i)
    for (int axis = 0; axis < 3; ++axis) {
      boxes[i].min[axis] = place(random);
      boxes[i].max[axis] = boxes[i].min[axis] + (i % 8 == 0 ? 1.9 : .7);  // two levels
    }
  for (const SearchMethod method : kMethods) {
    std::vector<BoxPair> first;
    for (const int threads : {1, 2, 3, 8}) {
      const auto search = makeSearch(method);
      search->setThreads(threads);
      std::vector<BoxPair> pairs;
      search->update(boxes);
      search->findPairs(pairs);
      if (threads == 1) first = pairs;
      ASSERT_EQ(pairs, first) << threads << " threads";
    }
    EXPECT_GT(first.size(), 1000U);
  }
}

TEST(SearchProperty, StopsWhereThereAreTooManyPairs) {
  constexpr std::size_t kBoxes = 800, kMost = 20000;
  for (const bool finite : {true, false}) {
    const double side = finite ? 1 : INFINITY;
    const std::vector<Box> boxes(kBoxes, Box{{0, 0, 0}, {side, 1, 1}});
    for (const SearchMethod method :
         {SearchMethod::kBruteForce, SearchMethod::kLebesgue, SearchMethod::kLinearCode,
          SearchMethod::kSweptRows, SearchMethod::kFastest, SearchMethod::kHierarchy}) {
      const auto search = makeSearch(method);
      search->setThreads(2);
      search->setMostPairs(kMost);
      std::vector<BoxPair> pairs;
      search->update(boxes);
      EXPECT_THROW(search->findPairs(pairs), TooManyPairs);
      EXPECT_LE(pairs.size(), kMost + kBoxes);
      pairs.clear();
      search->setMostPairs(kBoxes * (kBoxes - 1) / 2);
      search->findPairs(pairs);
      EXPECT_EQ(pairs.size(), kBoxes * (kBoxes - 1) / 2);
    }
  }
}

TEST(SearchProperty, ClearRemovesEverything) {
  for (const SearchMethod method : kMethods) {
    RandomScene before(1), after(2);
    const auto used = makeSearch(method), fresh = makeSearch(method);
    sortedPairs(*used, before.boxes());
    used->clear();
    std::vector<BoxPair> a, b;
    used->update(after.boxes());
    used->findPairs(a);
    fresh->update(after.boxes());
    fresh->findPairs(b);
    EXPECT_EQ(a, b);  // in the same order too
  }
}

}  // namespace
}  // namespace yadefrag
