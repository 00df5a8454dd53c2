// The paper's search of slaves in halos: all methods find what brute force finds; the orderings and
// the growth of its figure 14. Scenes, counting rules and all figures: examples/figure14/README.md.
#include "figure14/point_search.hpp"

#include <gtest/gtest.h>
#include <memory>

#include <algorithm>
#include <cmath>
#include <random>

#include "figure14/scenes.hpp"

namespace yadefrag {
namespace {

struct Variant {
  SearchMethod method;
  bool directory;
  const char* name;
};
constexpr Variant kPrinted = {SearchMethod::kLebesgue, false, "SPC as printed"};
constexpr Variant kShipped = {SearchMethod::kLebesgue, true, "SPC with a directory"};
constexpr Variant kLinear = {SearchMethod::kLinearCode, false, "LPC"};
constexpr Variant kTree = {SearchMethod::kHierarchy, false, "HO"};
constexpr Variant kAll[] = {kPrinted, kShipped, kLinear, kTree};

std::unique_ptr<PointSearch> make(const Variant& variant, PointSearchPlan plan) {
  plan.directory = variant.directory;
  return makePointSearch(variant.method, std::move(plan));
}

/// Candidates as (master, slave), sorted.
using Pairs = std::vector<std::pair<std::size_t, std::uint32_t>>;

Pairs candidatesOf(PointSearch& search, std::span<const Vec2> points,
                   std::span<const Rectangle> masters, double halo) {
  Csr<EntryId> found;
  search.update(points);
  search.find(masters, halo, found);
  Pairs pairs;
  EXPECT_EQ(found.rows(), masters.size());
  for (std::size_t r = 0; r < found.rows(); ++r)
    for (const EntryId slave : found.row(r)) pairs.emplace_back(r, slave.value);
  std::sort(pairs.begin(), pairs.end());
  return pairs;
}

/// Entries of many sizes, some on the borders of boxes; they drift, jump, appear and vanish.
class RandomEntries {
 public:
  explicit RandomEntries(std::uint64_t seed) : random_(seed) {
    plan_.edge = std::pow(10., static_cast<int>(random_() % 7) - 3);
    plan_.origin = {unit() - .5, random_() % 2 ? 0 : 1e9 * plan_.edge};
    wide_ = std::pow(10., static_cast<int>(random_() % 5) - 1);
    if (random_() % 8 == 0) wide_ = 1e12;  // more boxes than there are codes
    longest_ = std::pow(10., static_cast<int>(random_() % 4) - 2);
    halo = random_() % 4 ? .5 * plan_.edge * unit() : 0;
    resize(random_() % 120);
    for (std::uint32_t start = 0; start < points.size(); start += 1 + random_() % 9)
      plan_.loopStart.push_back(start);
  }

  [[nodiscard]] const PointSearchPlan& plan() const { return plan_; }

  void step() {
    for (std::size_t i = 0; i < points.size(); ++i) {
      if (random_() % 10 == 0) {
        place(i);
      } else if (random_() % 2) {
        const Vec2 by = plan_.edge * Vec2{unit() - .5, unit() - .5};
        const Rectangle old = masters[i];
        points[i] += by;
        masters[i] = {old.low + by, old.high + by};
      }
    }
    if (random_() % 4 == 0) resize(random_() % 120);
  }

  std::vector<Vec2> points;
  std::vector<Rectangle> masters;
  double halo = 0;

 private:
  double unit() { return static_cast<double>(random_() >> 11) * 0x1p-53; }
  double coordinate() {
    const double x = wide_ * (unit() - .5);
    return plan_.edge * (random_() % 4 ? x : std::round(x));
  }
  void place(std::size_t i) {
    const Vec2 a = plan_.origin + Vec2{coordinate(), coordinate()};
    const double length = plan_.edge * longest_ * (random_() % 20 ? 1 : 30);
    const Vec2 b = a + length * Vec2{unit() - .5, random_() % 5 ? unit() - .5 : 0};
    points[i] = a;
    masters[i] = {{std::min(a.x, b.x), std::min(a.y, b.y)},
                  {std::max(a.x, b.x), std::max(a.y, b.y)}};
  }
  void resize(std::size_t count) {
    const std::size_t before = std::min(count, points.size());
    points.resize(count);
    masters.resize(count);
    for (std::size_t i = before; i < count; ++i) place(i);
  }

  std::mt19937_64 random_;
  PointSearchPlan plan_;
  double wide_ = 1, longest_ = 1;
};

TEST(PointSearch, FindsWhatBruteForceFinds) {
  for (std::uint64_t seed = 0; seed < 400; ++seed) {
    RandomEntries scene(seed);
    const auto yardstick = makePointSearch(SearchMethod::kBruteForce, scene.plan());
    std::vector<std::unique_ptr<PointSearch>> searches;
    for (const Variant& v : kAll) searches.push_back(make(v, scene.plan()));
    for (int step = 0; step < 8; ++step) {
      const Pairs wanted = candidatesOf(*yardstick, scene.points, scene.masters, scene.halo);
      for (std::size_t v = 0; v < searches.size(); ++v)
        ASSERT_EQ(candidatesOf(*searches[v], scene.points, scene.masters, scene.halo), wanted)
            << kAll[v].name << ", seed " << seed << ", step " << step;
      scene.step();
    }
  }
}

/// The halo of a search: half the shortest segment (§4.1).
double haloOf(const figure14::MovingOutlines& scene) { return .5 * scene.shortestSegment(); }

template <class Scene>
void expectBruteForce(int size, int searches) {
  Scene scene(size);
  const auto yardstick = makePointSearch(SearchMethod::kBruteForce, scene.plan());
  std::vector<std::unique_ptr<PointSearch>> all;
  for (const Variant& v : kAll) all.push_back(make(v, scene.plan()));
  for (int k = 0; k < searches; ++k) {
    const double halo = haloOf(scene);
    const std::vector<Rectangle> masters = scene.masters();
    const Pairs wanted = candidatesOf(*yardstick, scene.points(), masters, halo);
    EXPECT_GT(wanted.size(), 2 * masters.size());  // at least its own two nodes
    for (std::size_t v = 0; v < all.size(); ++v)
      ASSERT_EQ(candidatesOf(*all[v], scene.points(), masters, halo), wanted)
          << kAll[v].name << ", size " << size << ", search " << k;
    for (int m = 0; m < 5; ++m) scene.advance(.5 * halo);
  }
}

TEST(Figure14, CandidatesAreBruteForces) {
  expectBruteForce<figure14::Squares>(8, 20);
  expectBruteForce<figure14::Rings>(8, 20);
  expectBruteForce<figure14::Bars>(6, 20);
}

TEST(Figure14, CandidatesAreBruteForcesInTheLargest) {
  expectBruteForce<figure14::Squares>(48, 2);
  expectBruteForce<figure14::Rings>(48, 2);
  expectBruteForce<figure14::Bars>(32, 2);
}

struct Cost {
  double segments = 0;
  double all = 0;     // comparisons per search and segment
  double locate = 0;  // of these, all but the look at the nodes found
};

/// Means over searches with motion between them; the first one, from nothing, is left out.
template <class Scene>
Cost costOf(int size, const Variant& variant, int searches = 40) {
  Scene scene(size);
  const auto search = make(variant, scene.plan());
  Csr<EntryId> found;
  Cost cost;
  cost.segments = static_cast<double>(scene.points().size());
  Comparisons first;
  int done = -1;
  do {
    search->update(scene.points());
    search->find(scene.masters(), haloOf(scene), found);
    if (++done == 0) first = search->comparisons();
  } while (done < searches && scene.advance(.5 * haloOf(scene)));
  const Comparisons last = search->comparisons();
  cost.all = static_cast<double>(last.total() - first.total()) / (done * cost.segments);
  cost.locate = cost.all - static_cast<double>(last.test - first.test) / (done * cost.segments);
  return cost;
}

constexpr int kWhole = 100000;  // searches: to the end of the motion

TEST(Figure14, FourComparisonsForANodeThatStays) {
  const figure14::Squares scene(8);
  for (const Variant& v : {kPrinted, kShipped, kLinear}) {
    const auto search = make(v, scene.plan());
    search->update(scene.points());
    search->update(scene.points());
    EXPECT_EQ(search->comparisons().total(), 4 * scene.points().size()) << v.name;
  }
}

TEST(Figure14, LebesgueIsNoWorseThanLinearOnSquaresAndBars) {
  for (const int size : {16, 24, 32}) {
    EXPECT_LE(costOf<figure14::Squares>(size, kPrinted).all,
              1.1 * costOf<figure14::Squares>(size, kLinear).all);
    EXPECT_LE(costOf<figure14::Squares>(size, kShipped).all,
              costOf<figure14::Squares>(size, kLinear).all);
  }
  for (const int size : {16, 32})
    for (const Variant& v : {kPrinted, kShipped})
      EXPECT_LE(costOf<figure14::Bars>(size, v).all, costOf<figure14::Bars>(size, kLinear).all);
}

TEST(Figure14, LebesgueBeatsLinearOnRingsMoreAndMore) {
  std::vector<double> printed, shipped;
  for (const int size : {16, 24, 48}) {
    const double linear = costOf<figure14::Rings>(size, kLinear).all;
    printed.push_back(linear / costOf<figure14::Rings>(size, kPrinted).all);
    shipped.push_back(linear / costOf<figure14::Rings>(size, kShipped).all);
  }
  EXPECT_GT(shipped[0], 1.15);
  EXPECT_GT(shipped[2], shipped[0] + .05);
  // With the printed exponential search the two are equal at some twenty rings.
  EXPECT_GT(printed[0], .95);
  EXPECT_GT(printed[1], 1);
  EXPECT_GT(printed[2], printed[1] + .05);
}

TEST(Figure14, HierarchyNeedsMoreOnBarsAndRings) {
  for (const int size : {16, 32}) {
    EXPECT_GE(costOf<figure14::Bars>(size, kTree, kWhole).all,
              1.1 * costOf<figure14::Bars>(size, kPrinted, kWhole).all);
    EXPECT_GE(costOf<figure14::Rings>(size, kTree).all,
              1.4 * costOf<figure14::Rings>(size, kPrinted).all);
  }
}

/// Exponent of all comparisons in the number of segments.
double exponent(const Cost& small, const Cost& large) {
  return 1 + std::log(large.all / small.all) / std::log(large.segments / small.segments);
}

// §4.5: LPC finds the beginning of each row in log N comparisons. The look at the nodes found, more
// than half of all its comparisons here, does not grow.
TEST(Figure14, GrowthFromNToFourNOnSquares) {
  const auto growth = [](const Variant& v) {
    const Cost small = costOf<figure14::Squares>(24, v), large = costOf<figure14::Squares>(48, v);
    EXPECT_TRUE(v.method == SearchMethod::kLinearCode || exponent(small, large) <= 1.05) << v.name;
    return Cost{0, large.all / small.all, large.locate / small.locate};
  };
  const Cost linear = growth(kLinear);
  EXPECT_GE(linear.locate, 1.10);
  for (const Variant& v : {kPrinted, kShipped}) {
    const Cost lebesgue = growth(v);
    EXPECT_LE(lebesgue.all, 1.05) << v.name;
    EXPECT_LE(lebesgue.locate, 1.05) << v.name;
    EXPECT_GE(linear.all - 1, 2 * (lebesgue.all - 1)) << v.name;
  }
}

TEST(Figure14, GrowthFromNToFourNOnBars) {
  // Without the directory: how many codes share one of its slots depends on how much of the square
  // of boxes around it the scene fills.
  const Cost small = costOf<figure14::Bars>(16, kPrinted),
             large = costOf<figure14::Bars>(64, kPrinted);
  EXPECT_LE(large.all, 1.05 * small.all);
  EXPECT_LE(large.locate, 1.05 * small.locate);
  EXPECT_LE(exponent(small, large), 1.05);
  EXPECT_GE(costOf<figure14::Bars>(64, kLinear).locate,
            1.10 * costOf<figure14::Bars>(16, kLinear).locate);
}

TEST(Figure14, ExponentOnRings) {
  EXPECT_LE(exponent(costOf<figure14::Rings>(24, kPrinted), costOf<figure14::Rings>(48, kPrinted)),
            1.055);
}

}  // namespace
}  // namespace yadefrag
