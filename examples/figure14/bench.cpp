// The paper's figure 14: comparisons and time of one global search in its three scenes. An
// iteration is a whole run; its time is the mean of the searches after the first, counted by a
// second search at its side. Drawn by figure14.py.
//
// Names: figure14/<scene>/<method>/<size>, and figure14/frames/<scene>/<size> where the environment
// variable FIGURE14_FRAMES names a folder: the boxes of all searches, for YADE's collider.
#include <benchmark/benchmark.h>
#include <memory>

#include <chrono>
#include <cstdlib>
#include <fstream>
#include <functional>
#include <sstream>
#include <string>
#include <vector>

#include "figure14/scenes.hpp"
#include "figure14/sweep.hpp"

namespace yadefrag::figure14 {
namespace {

using MakeScene = std::function<std::unique_ptr<MovingOutlines>(int)>;

struct SceneKind {
  const char* name;
  MakeScene make;
  std::vector<int> sizes;
  int searches;  // most
};

template <class Scene>
MakeScene maker() {
  return [](int size) { return std::make_unique<Scene>(size); };
}

const std::vector<SceneKind>& scenes() {
  static const std::vector<SceneKind> all = {
      {"squares", maker<Squares>(), {4, 8, 12, 16, 20, 24, 32, 40, 48}, 100},
      {"rings", maker<Rings>(), {4, 8, 12, 16, 20, 24, 32, 40, 48}, 100},
      {"bars", maker<Bars>(), {4, 8, 12, 16, 20, 24, 28, 32}, 1000}};
  return all;
}

/// Calls `visit(scene, halo)` for every search of a run; the nodes go up to half a halo between two
/// (k = δ/(2·u_max) steps, §4.1). Returns how many after the first.
template <class Visit>
int forEachSearch(MovingOutlines& scene, int most, Visit visit) {
  int done = -1;
  for (;;) {
    const double halo = .5 * scene.shortestSegment();
    visit(scene, halo);
    if (++done == most || !scene.advance(.5 * halo)) return done;
  }
}

using Clock = std::chrono::steady_clock;

class Tally {
 public:
  void add(double seconds, const Comparisons& sum, std::size_t candidates, double halo) {
    halo_ = halo;
    if (isFirst_) {
      isFirst_ = false;
      first_ = sum;
      return;
    }
    seconds_ += seconds;
    last_ = sum;
    candidates_ += candidates;
  }
  void report(benchmark::State& state, const MovingOutlines& scene, int searches) const {
    const auto segments = static_cast<double>(scene.points().size());
    const auto mean = [&](std::uint64_t n) { return static_cast<double>(n) / searches; };
    state.SetIterationTime(seconds_ / searches);
    state.counters["segments"] = segments;
    state.counters["searches"] = searches;
    state.counters["b"] = scene.plan().edge;
    state.counters["lastHalo"] = halo_;
    state.counters["candidates"] = mean(candidates_);
    state.counters["move"] = mean(last_.move - first_.move);
    state.counters["resort"] = mean(last_.resort - first_.resort);
    state.counters["range"] = mean(last_.range - first_.range);
    state.counters["test"] = mean(last_.test - first_.test);
    state.counters["comparisons"] = mean(last_.total() - first_.total());
  }

 private:
  bool isFirst_ = true;
  double seconds_ = 0, halo_ = 0;
  Comparisons first_, last_;
  std::size_t candidates_ = 0;
};

void runPoints(benchmark::State& state, const SceneKind& kind, int size, SearchMethod method,
               bool directory) {
  for ([[maybe_unused]] auto once : state) {
    const auto scene = kind.make(size);
    PointSearchPlan plan = scene->plan();
    plan.directory = directory;
    const auto points = makePointSearch(method, plan);
    Csr<EntryId> found;
    Tally tally;
    const auto search = [&](const MovingOutlines& now, double halo) {
      const std::vector<Rectangle> masters = now.masters();
      const auto start = Clock::now();
      points->update(now.points());
      points->find(masters, halo, found);
      const std::chrono::duration<double> seconds = Clock::now() - start;
      tally.add(seconds.count(), points->comparisons(), found.values.size(), halo);
    };
    const int searches = forEachSearch(*scene, kind.searches, search);
    tally.report(state, *scene, searches);
  }
}

/// Boxes that overlap where a node of one may be in the halo of the other.
std::vector<Rectangle> boxesOf(const MovingOutlines& scene, double halo) {
  std::vector<Rectangle> boxes = scene.masters();
  for (Rectangle& box : boxes) box = enlarged(box, .5 * halo);
  return boxes;
}

void runSweep(benchmark::State& state, const SceneKind& kind, int size) {
  for ([[maybe_unused]] auto once : state) {
    const auto scene = kind.make(size);
    SweepAndPrune sweep;
    Tally tally;
    const auto search = [&](const MovingOutlines& now, double halo) {
      const std::vector<Rectangle> boxes = boxesOf(now, halo);
      const auto start = Clock::now();
      sweep.update(boxes);
      const std::chrono::duration<double> seconds = Clock::now() - start;
      tally.add(seconds.count(), sweep.comparisons(), sweep.pairs(), halo);
    };
    const int searches = forEachSearch(*scene, kind.searches, search);
    tally.report(state, *scene, searches);
  }
}

void writeFrames(benchmark::State& state, const SceneKind& kind, int size,
                 const std::string& folder) {
  for ([[maybe_unused]] auto once : state) {
    std::ostringstream name;
    name << folder << '/' << kind.name << '_' << size << ".f64";
    const std::string file = name.str();
    std::ofstream out(file, std::ios::binary);
    const auto scene = kind.make(size);
    forEachSearch(*scene, kind.searches, [&](const MovingOutlines& now, double halo) {
      for (const Rectangle& box : boxesOf(now, halo)) {
        const double row[] = {box.low.x, box.low.y, box.high.x, box.high.y};
        out.write(reinterpret_cast<const char*>(row), sizeof row);
      }
    });
    out.close();
    if (!out) state.SkipWithError(("cannot write " + file).c_str());
    state.counters["segments"] = static_cast<double>(scene->points().size());
  }
}

std::string nameOf(const char* first, const char* second, int size) {
  std::ostringstream name;
  name << "figure14/" << first << '/' << second << '/' << size;
  return name.str();
}

void add(const std::string& name, const std::function<void(benchmark::State&)>& run) {
  benchmark::RegisterBenchmark(name.c_str(), run)
      ->Iterations(1)
      ->UseManualTime()
      ->Unit(benchmark::kMillisecond);
}

bool registerAll() {
  using State = benchmark::State;
  struct Method {
    const char* name;
    SearchMethod method;
    bool directory;
  };
  constexpr Method kMethods[] = {{"SPC", SearchMethod::kLebesgue, false},
                                 {"SPC-directory", SearchMethod::kLebesgue, true},
                                 {"LPC", SearchMethod::kLinearCode, false},
                                 {"HO", SearchMethod::kHierarchy, false}};
  const char* folder = std::getenv("FIGURE14_FRAMES");
  for (const SceneKind& kind : scenes())
    for (const int size : kind.sizes) {
      for (const Method& m : kMethods)
        add(nameOf(kind.name, m.name, size), [&kind, size, m](State& state) {
          runPoints(state, kind, size, m.method, m.directory);
        });
      add(nameOf(kind.name, "sweep", size),
          [&kind, size](State& state) { runSweep(state, kind, size); });
      if (folder)
        add(nameOf("frames", kind.name, size),
            [&kind, size, folder = std::string(folder)](State& state) {
              writeFrames(state, kind, size, folder);
            });
    }
  return true;
}

const bool kRegistered = registerAll();

}  // namespace
}  // namespace yadefrag::figure14
