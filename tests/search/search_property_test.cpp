// Every search finds exactly the pairs of brute force, in random scenes whose boxes move, jump,
// appear and vanish, and so does one with a list of the changed boxes, after every change.
// YADEFRAG_SCENES sets the number of scenes (default 30,000; a hundredth of it for changes).
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <memory>
#include <random>
#include <vector>

#include "core/tolerances/search.hpp"
#include "search/contact_search.hpp"
#include "search/incremental_search.hpp"

namespace yadefrag {
namespace {

/// Random boxes of every kind that a search must get right.
class RandomScene {
 public:
  explicit RandomScene(std::uint64_t seed) : random_(seed) {
    scale_ = std::pow(10, static_cast<double>(random_() % 19) - 9);
    ratio_ = std::pow(10, unit() * 4);
    flatAxis_ = random_() % 3 == 0 ? static_cast<int>(random_() % 3) : -1;
    place_ = static_cast<Place>(random_() % 5);
    walls_ = random_() % 4 == 0;
    offset_ = random_() % 4 == 0 ? scale_ * 1e3 * (unit() - .5) : 0;
    const std::size_t most = random_() % 20 == 0 ? 300 : 40;
    resize(random_() % most);
  }

  [[nodiscard]] const std::vector<Box>& boxes() const { return boxes_; }

  /// Boxes drift, jump, vanish, appear and change size; the array changes its length.
  void step() {
    for (Box& box : boxes_) {
      const auto what = random_() % 16;
      if (what == 0) {
        box = Box::absent();
      } else if (what <= 2 || box.isAbsent()) {
        box = randomBox();
      } else if (what <= 10) {
        for (int axis = 0; axis < 3; ++axis) {
          const double by = (unit() - .5) * scale_ * .02;
          box.min[axis] += by;
          box.max[axis] += by;
        }
        for (int axis = 0; axis < 3; ++axis)
          if (box.min[axis] > box.max[axis]) box.max[axis] = box.min[axis];  // rounding of points
      }
    }
    if (random_() % 3 == 0)
      resize(boxes_.size() + random_() % 7 - std::min<std::size_t>(3, boxes_.size()));
  }

 private:
  enum Place { kEven, kClusters, kLattice, kCoincident, kLine };

  double unit() { return static_cast<double>(random_() >> 11) * 0x1p-53; }

  void resize(std::size_t count) {
    boxes_.resize(std::min(count, boxes_.size()));
    while (boxes_.size() < count) boxes_.push_back(random_() % 20 ? randomBox() : Box::absent());
  }

  double coordinate(int axis) {
    if (axis == flatAxis_) return 0;
    switch (place_) {
      case kClusters:
        return scale_ * ((random_() % 2 ? 100 : 0) + .1 * unit());
      case kLattice:
        return scale_ * .125 * static_cast<double>(random_() % 8);  // on borders
      case kCoincident:
        return scale_ * .5 * static_cast<double>(random_() % 2);
      case kLine:
        return axis == 0 ? scale_ * unit() : scale_ * .25;
      case kEven:
        break;
    }
    return scale_ * (unit() - .5);
  }

  Box randomBox() {
    Box box;
    const bool point = random_() % 8 == 0;
    const double size = point ? 0 : .15 * scale_ * std::pow(ratio_, -unit());
    const bool cube = random_() % 2;
    const double half = place_ == kLattice ? .0625 * scale_ : .5 * size;
    for (int axis = 0; axis < 3; ++axis) {
      const double at = coordinate(axis) + offset_;
      const double reach = point ? 0 : half * (cube ? 1 : unit());
      box.min[axis] = at - reach;
      box.max[axis] = at + reach;
    }
    if (walls_ && random_() % 10 == 0) {
      const auto axis = random_() % 3;
      box.min[axis] = -INFINITY;
      if (random_() % 2) box.max[axis] = INFINITY;
    }
    return box;
  }

  std::mt19937_64 random_;
  std::vector<Box> boxes_;
  double scale_ = 1, ratio_ = 1, offset_ = 0;
  int flatAxis_ = -1;
  Place place_ = kEven;
  bool walls_ = false;
};

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

constexpr SearchMethod kMethods[] = {SearchMethod::kLebesgue,  SearchMethod::kLinearCode,
                                     SearchMethod::kSweptRows, SearchMethod::kFastest,
                                     SearchMethod::kHierarchy, SearchMethod::kBruteForce};

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

/// `count` boxes of side 1, on average three neighbours each.
std::vector<Box> evenBoxes(std::size_t count, std::mt19937_64& random) {
  std::uniform_real_distribution<double> place(0, std::cbrt(static_cast<double>(count) * 2.7));
  std::vector<Box> boxes(count);
  for (Box& box : boxes)
    for (int axis = 0; axis < 3; ++axis) {
      box.min[axis] = place(random);
      box.max[axis] = box.min[axis] + 1;
    }
  return boxes;
}

TEST(SearchProperty, SameOrderForAnyNumberOfThreads) {
  std::mt19937_64 random(9);
  std::vector<Box> boxes = evenBoxes(20000, random);
  for (std::size_t i = 0; i < boxes.size(); i += 8)  // two levels
    for (int axis = 0; axis < 3; ++axis) boxes[i].max[axis] += 1.7;
  for (const SearchMethod method : kMethods) {
    if (method == SearchMethod::kBruteForce) continue;  // slow, and has no threads
    std::vector<BoxPair> first;
    for (const int threads : {1, 2, 3, 8}) {
      const auto search = makeSearch(method);
      search->setThreads(threads);
      std::vector<BoxPair> pairs;
      search->update(boxes);
      search->findPairs(pairs);
      if (threads == 1) first = pairs;
      EXPECT_EQ(pairs, first) << threads << " threads";
    }
    EXPECT_GT(first.size(), 1000U);
  }
}

TEST(SearchProperty, StopsWhereThereAreTooManyPairs) {
  constexpr std::size_t kBoxes = 800, kMost = 20000;
  for (const bool finite : {true, false}) {
    const double side = finite ? 1 : INFINITY;
    const std::vector<Box> boxes(kBoxes, Box{{0, 0, 0}, {side, 1, 1}});
    for (const SearchMethod method : kMethods) {
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

// --- A search with a list of the changed boxes.

std::vector<BoxId> changedSlots(const std::vector<Box>& before, const std::vector<Box>& now) {
  std::vector<BoxId> changed;
  for (std::size_t i = 0; i < now.size(); ++i)
    if (i >= before.size() || before[i].min != now[i].min || before[i].max != now[i].max)
      changed.push_back(BoxId(i));
  return changed;
}

/// The pairs that a caller keeps from one change to the next.
class KeptPairs {
 public:
  explicit KeptPairs(SearchMethod method, bool counts) : search_(method, counts) {}

  void look(const std::vector<Box>& before, const std::vector<Box>& now) {
    std::vector<BoxPair> found;
    if (now.size() < before.size() || before.empty()) {
      search_.update(now);
      search_.findPairs(found);
      pairs_ = found;
      std::sort(pairs_.begin(), pairs_.end());
      return;
    }
    const std::vector<BoxId> changed = changedSlots(before, now);
    const auto isChanged = [&](BoxId id) {
      return std::binary_search(changed.begin(), changed.end(), id);
    };
    const auto hasChanged = [&](const BoxPair& p) {
      return isChanged(p.first) || isChanged(p.second);
    };
    std::erase_if(pairs_, hasChanged);
    search_.change(now, changed);
    search_.findPairsOfChanged(found);
    EXPECT_TRUE(std::all_of(found.begin(), found.end(), hasChanged));
    pairs_.insert(pairs_.end(), found.begin(), found.end());
    std::sort(pairs_.begin(), pairs_.end());
  }

  [[nodiscard]] const std::vector<BoxPair>& pairs() const { return pairs_; }
  [[nodiscard]] const IncrementalSearch& search() const { return search_; }

 private:
  IncrementalSearch search_;
  std::vector<BoxPair> pairs_;
};

TEST(IncrementalSearch, SamePairsAsBruteForceWhileBoxesMoveComeAndGo) {
  const std::uint64_t scenes = std::max<std::uint64_t>(sceneCount() / 100, 100);
  std::uint64_t found = 0, aside = 0;
  const auto brute = makeSearch(SearchMethod::kBruteForce);
  for (std::uint64_t seed = 0; seed < scenes; ++seed) {
    RandomScene scene(seed);
    std::vector<KeptPairs> kept;
    for (const SearchMethod method : kMethods) kept.emplace_back(method, seed % 2);
    std::vector<Box> before;
    for (int step = 0; step < 6; ++step) {
      // Another array each time: what was given before may be gone.
      const std::vector<Box> now = scene.boxes();
      const std::vector<BoxPair> expected = sortedPairs(*brute, now);
      found += expected.size();
      for (std::size_t k = 0; k < kept.size(); ++k) {
        kept[k].look(before, now);
        ASSERT_EQ(kept[k].pairs(), expected) << "seed " << seed << ", step " << step << ", " << k;
        aside += kept[k].search().aside();
        if (now.empty()) continue;
        const Box& box = now[seed % now.size()];
        if (!box.isAbsent()) {
          std::vector<BoxId> overlapping;
          kept[k].search().findOverlaps(box, overlapping);
          std::size_t wanted = 0;
          for (const Box& other : now) wanted += overlaps(box, other);
          ASSERT_EQ(overlapping.size(), wanted) << "seed " << seed << ", step " << step;
        }
      }
      before = now;
      scene.step();
    }
  }
  EXPECT_GT(found, 10 * scenes) << "scenes too empty to prove anything";
  EXPECT_GT(aside, scenes) << "everything was always sorted in";
}

/// Comparisons of changes by one box among `count`.
double comparisonsOfOneMove(std::size_t count) {
  std::mt19937_64 random(5);
  std::vector<Box> boxes = evenBoxes(count, random);
  IncrementalSearch search(SearchMethod::kLebesgue, true);
  search.update(boxes);
  std::vector<BoxPair> pairs;
  search.findPairs(pairs);
  const auto before = search.comparisons().total();
  constexpr int kMoves = 20;
  for (int move = 0; move < kMoves; ++move) {
    const BoxId one(random() % count);
    boxes[one.value].max[1] += .1;
    search.change(boxes, {&one, 1});
    search.findPairsOfChanged(pairs);
  }
  return static_cast<double>(search.comparisons().total() - before) / kMoves;
}

TEST(IncrementalSearch, OneMoveCostsNoMoreAmongMany) {
  // Without `count`, a search of 4·10⁴ boxes takes 4·10⁴ looks at least.
  EXPECT_LT(comparisonsOfOneMove(40000), 1000);
  EXPECT_LT(comparisonsOfOneMove(40000), 2 * comparisonsOfOneMove(1000) + 100);
}

TEST(IncrementalSearch, SortsInWhatHasWaitedForLong) {
  std::mt19937_64 random(6);
  std::vector<Box> boxes = evenBoxes(2000, random);
  IncrementalSearch search(SearchMethod::kLebesgue);
  search.update(boxes);
  bool settled = false;
  for (std::size_t i = 0; i < boxes.size() && !settled; ++i) {
    const BoxId one(i);
    boxes[i].max[0] += .1;
    search.change(boxes, {&one, 1});
    settled = search.aside() == 0;
    // The sum 1 + 2 + … + k of the looks has reached the number of boxes.
    ASSERT_TRUE(settled || i * i / 2 <= tolerance::kAsideWork * boxes.size());
  }
  EXPECT_TRUE(settled);
}

TEST(IncrementalSearch, StopsWhereThereAreTooManyPairs) {
  std::vector<Box> boxes(800, Box{{0, 0, 0}, {1, 1, 1}});
  for (std::size_t i = 0; i < boxes.size(); ++i) boxes[i].min[0] = boxes[i].max[0] = 2. * double(i);
  IncrementalSearch search(SearchMethod::kLebesgue);
  search.setThreads(2);
  search.update(boxes);
  std::vector<BoxId> changed;
  for (std::size_t i = 0; i < boxes.size(); i += 2) {
    boxes[i] = {{0, 0, 0}, {2000, 1, 1}};
    changed.push_back(BoxId(i));
  }
  search.setMostPairs(20000);
  search.change(boxes, changed);
  std::vector<BoxPair> pairs;
  EXPECT_THROW(search.findPairsOfChanged(pairs), TooManyPairs);
  search.setMostPairs(1000000);
  search.findPairsOfChanged(pairs);
  EXPECT_EQ(pairs.size(), 400U * 399 / 2 + 400U * 400);
}

TEST(SearchMemory, MoreBoxesThanCanBeCountedAreRefused) {
  // None of them is looked at: there is one.
  const Box one{{0, 0, 0}, {1, 1, 1}};
  for (const std::size_t count : {kMostBoxes + 1, (std::size_t{1} << 32) + 1}) {
    const std::span<const Box> many(&one, count);
    for (const SearchMethod method : kMethods)
      EXPECT_THROW(makeSearch(method)->update(many), RunError);
    IncrementalSearch search(SearchMethod::kLebesgue);
    EXPECT_THROW(search.update(many), RunError);
    search.update({&one, 1});
    EXPECT_THROW(search.change(many, {}), RunError);
  }
}

}  // namespace
}  // namespace yadefrag
