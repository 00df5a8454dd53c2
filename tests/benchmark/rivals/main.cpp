// Compares searches: yadefrag_rivals SCENE DIMENSIONS COUNT THREADS ROUNDS MOST_SECONDS
//
// Prints a line of JSON per method: processor time in ms (with several threads, elapsed time) of
// the first search (build), and of the later ones the least of ROUNDS (update, query), and how many
// pairs there are. All methods see the same boxes; those whose pairs differ from the first one's
// fail. A method that takes longer than MOST_SECONDS in all ends there.
#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <limits>

#include "benchmark/rivals/box_scenes.hpp"
#include "benchmark/rivals/rival.hpp"

namespace yadefrag {
namespace {

double now(bool elapsed) {
  timespec t;
  clock_gettime(elapsed ? CLOCK_MONOTONIC : CLOCK_PROCESS_CPUTIME_ID, &t);
  return 1e3 * static_cast<double>(t.tv_sec) + 1e-6 * static_cast<double>(t.tv_nsec);
}

/// Number and a checksum of pairs, in any order.
struct Sum {
  std::size_t count = 0;
  std::uint64_t mixed = 0;
  explicit Sum(const std::vector<BoxPair>& pairs) : count(pairs.size()) {
    for (const BoxPair& pair : pairs) {
      std::uint64_t x = (std::uint64_t{pair.first.value} << 32) | pair.second.value;
      x = (x ^ (x >> 31)) * 0x9e3779b97f4a7c15ULL;
      mixed += x ^ (x >> 29);
    }
  }
  friend bool operator==(const Sum&, const Sum&) = default;
};

struct Task {
  std::string scene;
  int dimensions;
  std::size_t count;
  int threads;
  int rounds;
  double most;  // ms
};

struct Times {
  double build = 0;
  double update = std::numeric_limits<double>::infinity(), query = update;
  std::vector<Sum> sums;
};

Times measure(const Task& task, const std::string& name) {
  BoxScene scene(task.scene, task.dimensions, task.count);
  const auto rival = makeRival(name, task.dimensions, task.threads);
  const bool elapsed = task.threads > 1;
  const double start = now(elapsed);
  std::vector<BoxPair> pairs;
  rival->build(scene.boxes());
  rival->findPairs(pairs);
  Times times;
  times.build = now(elapsed) - start;
  times.sums.emplace_back(pairs);
  for (int round = 0; round < task.rounds && now(elapsed) - start < task.most; ++round) {
    const auto& moved = scene.step();
    pairs.clear();
    const double before = now(elapsed);
    rival->update(moved);
    const double between = now(elapsed);
    rival->findPairs(pairs);
    times.update = std::min(times.update, between - before);
    times.query = std::min(times.query, now(elapsed) - between);
    times.sums.emplace_back(pairs);
  }
  return times;
}

int run(const Task& task) {
  std::vector<Sum> expected;
  for (const RivalName& rival : rivalNames()) {
    const std::string name = rival.name;
    const bool own = name != "cell list" && name != "CGAL" && name != "Boost R-tree" &&
                     name != "Bullet" && name != "Box2D";
    if (rival.dimensions != 0 && rival.dimensions != task.dimensions) continue;
    if (task.scene == "sizes" && !rival.uneven && task.count > 10000) continue;
    if (task.threads > 1 && !own) continue;
    const Times times = measure(task, name);
    if (!(times.update < std::numeric_limits<double>::infinity())) {
      std::fprintf(stderr, "%s: the first search took too long\n", rival.name);
      continue;
    }
    if (expected.empty()) expected = times.sums;
    for (std::size_t i = 0; i < std::min(times.sums.size(), expected.size()); ++i)
      if (!(times.sums[i] == expected[i])) {
        std::fprintf(stderr, "%s finds other pairs: %zu instead of %zu\n", rival.name,
                     times.sums[i].count, expected[i].count);
        return 1;
      }
    std::printf(
        "{\"scene\": \"%s\", \"dimensions\": %d, \"n\": %zu, \"threads\": %d, \"method\": "
        "\"%s\", \"build\": %.4g, \"update\": %.4g, \"query\": %.4g, \"pairs\": %zu}\n",
        task.scene.c_str(), task.dimensions, task.count, task.threads, rival.name, times.build,
        times.update, times.query, times.sums.front().count);
    std::fflush(stdout);
  }
  return 0;
}

}  // namespace
}  // namespace yadefrag

int main(int argc, char** argv) {
  if (argc != 7) {
    std::fprintf(stderr, "usage: %s SCENE DIMENSIONS COUNT THREADS ROUNDS MOST_SECONDS\n", argv[0]);
    return 2;
  }
  return yadefrag::run({argv[1], std::atoi(argv[2]), std::strtoull(argv[3], nullptr, 10),
                        std::atoi(argv[4]), std::atoi(argv[5]), 1e3 * std::atof(argv[6])});
}
