// The four searches without YADE: time of one search (update and findPairs) of boxes that have
// moved a little since the last one. The counters come from a run of their own, so that the time is
// that of a search that counts nothing.
//
// Names: search/<dimensions>D/1:<longest over shortest side>/<method>/<boxes>.
#include <benchmark/benchmark.h>

#include <cmath>
#include <random>
#include <string>
#include <vector>

#include "search/contact_search.hpp"

namespace yadefrag {
namespace {

constexpr double kFill = .3;  // volume of all boxes over that of the cube they are in
constexpr double kStep = .1;  // longest way of a box between two searches, in its own sides

/// Boxes with sides log-uniform in 1..ratio, which move back and forth.
class MovingBoxes {
 public:
  MovingBoxes(std::size_t count, int dimensions, double ratio) : dimensions_(dimensions) {
    std::uniform_real_distribution<double> unit(0, 1);
    std::vector<double> sides(count);
    double volume = 0;
    for (double& side : sides) {
      side = std::pow(ratio, unit(random_));
      volume += std::pow(side, dimensions);
    }
    std::uniform_real_distribution<double> place(0, std::pow(volume / kFill, 1. / dimensions));
    for (const double side : sides) {
      std::array<double, 3> low{};
      for (int axis = 0; axis < dimensions; ++axis) low[axis] = place(random_);
      here_.push_back(boxAt(low, side));
      for (int axis = 0; axis < dimensions; ++axis)
        low[axis] += (2 * unit(random_) - 1) * kStep * side;
      there_.push_back(boxAt(low, side));
    }
  }

  /// The boxes of the next moment; each call gives the other of two arrays.
  const std::vector<Box>& next() {
    isHere_ = !isHere_;
    return isHere_ ? here_ : there_;
  }

 private:
  [[nodiscard]] Box boxAt(const std::array<double, 3>& low, double side) const {
    Box box{low, low};
    for (int axis = 0; axis < dimensions_; ++axis) box.max[axis] += side;
    return box;
  }

  int dimensions_;
  std::mt19937_64 random_{7};
  std::vector<Box> here_, there_;
  bool isHere_ = false;
};

/// Comparisons of one search after the first, by stage and per box.
void countComparisons(benchmark::State& state, SearchMethod method, MovingBoxes boxes) {
  const auto search = makeSearch(method, true);
  std::vector<BoxPair> pairs;
  search->update(boxes.next());
  search->findPairs(pairs);
  const Comparisons before = search->comparisons();
  pairs.clear();
  search->update(boxes.next());
  search->findPairs(pairs);
  const Comparisons after = search->comparisons();
  const auto perBox = [&](std::uint64_t n) {
    return static_cast<double>(n) / static_cast<double>(state.range(0));
  };
  state.counters["pairs/box"] = perBox(pairs.size());
  state.counters["move/box"] = perBox(after.move - before.move);
  state.counters["resort/box"] = perBox(after.resort - before.resort);
  state.counters["range/box"] = perBox(after.range - before.range);
  state.counters["test/box"] = perBox(after.test - before.test);
  state.counters["comparisons/box"] = perBox(after.total() - before.total());
}

void runSearch(benchmark::State& state, SearchMethod method, int dimensions, double ratio) {
  const MovingBoxes start(static_cast<std::size_t>(state.range(0)), dimensions, ratio);
  MovingBoxes boxes = start;
  const auto search = makeSearch(method);
  std::vector<BoxPair> pairs;
  search->update(boxes.next());
  search->findPairs(pairs);
  for ([[maybe_unused]] auto once : state) {
    pairs.clear();
    search->update(boxes.next());
    search->findPairs(pairs);
    benchmark::DoNotOptimize(pairs.data());
  }
  state.SetItemsProcessed(state.iterations() * state.range(0));
  countComparisons(state, method, start);
}

struct Method {
  SearchMethod method;
  const char* name;
  std::int64_t most;  // boxes
};
constexpr Method kMethods[] = {{SearchMethod::kLebesgue, "Lebesgue", 1000000},
                               {SearchMethod::kLinearCode, "LinearCode", 1000000},
                               {SearchMethod::kHierarchy, "Hierarchy", 1000000},
                               {SearchMethod::kBruteForce, "BruteForce", 10000}};

void registerAll() {
  for (const int dimensions : {2, 3})
    for (const int ratio : {1, 50})
      for (const Method& m : kMethods) {
        const std::string name =
            "search/" + std::to_string(dimensions) + "D/1:" + std::to_string(ratio) + "/" + m.name;
        benchmark::RegisterBenchmark(
            name.c_str(),
            [=](benchmark::State& state) { runSearch(state, m.method, dimensions, ratio); })
            ->RangeMultiplier(10)
            ->Range(1000, m.most)
            ->Unit(benchmark::kMillisecond);
      }
}

}  // namespace
}  // namespace yadefrag

int main(int argc, char** argv) {
  yadefrag::registerAll();
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 1;
  benchmark::RunSpecifiedBenchmarks();
}
