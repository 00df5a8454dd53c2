// Finite-element bodies in contact: where the time of a step goes.
//
// Names: contact/<scene>/<size>/<threads>. Counters are ns per step and triangle (forces) or per
// step and surface entry (search, local search, correction), and ns per entry of one search. A
// first part of each run, until bodies have met, is not measured; of blocks, which touch from the
// start or stay apart, all of it is.
#include <benchmark/benchmark.h>

#include <functional>

#include "benchmark/fe_scenes.hpp"
#include "step/blocks.hpp"

namespace yadefrag {
namespace {

struct Scene {
  const char* name;
  void (*add)(World& world, int size);
  int toMeet = 300;  ///< steps
};

const Scene kScenes[] = {
    {"rings", [](World& world, int size) { fescenes::addRings(world, size, false); }},
    {"smooth rings", [](World& world, int size) { fescenes::addRings(world, size, true); }},
    {"squares", [](World& world, int size) { fescenes::addSquares(world, size); }},
    {"impact", [](World& world, int size) { fescenes::addImpact(world, 10e-3 / size, false); }},
    {"smooth impact",
     [](World& world, int size) { fescenes::addImpact(world, 10e-3 / size, true); }},
    {"touching blocks", [](World& world, int size) { test::addBlockWall(world, {size}); }, 0},
    // Joints that gravity does not close in the run.
    {"blocks apart",
     [](World& world, int size) {
       test::addBlockWall(world, {size, 5e-5});
     },
     0},
};

void report(benchmark::State& state, const World& world, std::uint64_t searches, double rows) {
  const StageTimes& t = world.times;
  const auto steps = static_cast<double>(state.iterations());
  const auto entries = static_cast<double>(world.surfaces.entries());
  const auto triangles = static_cast<double>(world.model.triangles.size());
  const auto candidates = static_cast<double>(world.contact.candidates.size());
  state.counters["triangles"] = triangles;
  state.counters["entries"] = entries;
  state.counters["candidates"] = candidates;
  state.counters["rows"] = rows / steps;
  state.counters["searches"] = static_cast<double>(searches);
  state.counters["forces"] = 1e9 * t.forces / steps / triangles;
  state.counters["search"] = 1e9 * t.search / steps / entries;
  state.counters["local"] = 1e9 * t.localSearch / steps / entries;
  state.counters["correction"] = 1e9 * t.correction / steps / entries;
  state.counters["share"] = t.contact() / (t.contact() + t.forces);
}

void contactSteps(benchmark::State& state, const Scene& scene) {
  World world;
  world.threads = static_cast<int>(state.range(1));
  scene.add(world, static_cast<int>(state.range(0)));
  const double dt = .8 * world.criticalTimeStep();
  for (int i = 0; i < scene.toMeet; ++i) world.step(dt);
  world.timing = true;
  const std::uint64_t searched = world.numSearches();
  double rows = 0;
  for ([[maybe_unused]] auto once : state) {
    world.step(dt);
    rows += static_cast<double>(world.contact.rows().size());
  }
  report(state, world, world.numSearches() - searched, rows);
}

void registerScene(const Scene& scene, std::int64_t size, std::int64_t threads) {
  benchmark::RegisterBenchmark((std::string("contact/") + scene.name).c_str(), contactSteps, scene)
      ->Args({size, threads})
      ->Iterations(300)
      ->Unit(benchmark::kMillisecond)
      ->UseRealTime();
}

[[maybe_unused]] const bool kRegistered = [] {
  for (const std::int64_t threads : {1, 2}) {
    for (const std::int64_t size : {12, 24, 48}) registerScene(kScenes[0], size, threads);
    registerScene(kScenes[1], 48, threads);
    for (const std::int64_t size : {12, 48}) registerScene(kScenes[2], size, threads);
    for (const std::int64_t size : {40, 160}) registerScene(kScenes[3], size, threads);
    registerScene(kScenes[4], 160, threads);
    for (const std::int64_t size : {5, 14, 32})
      for (const Scene* scene : {&kScenes[5], &kScenes[6]}) registerScene(*scene, size, threads);
  }
  return true;
}();

}  // namespace
}  // namespace yadefrag
