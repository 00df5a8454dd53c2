// Bodies that crack: what a crack costs, in blocks of more and more triangles that crack alike.
//
// Names: fracture/<law>/<triangles, about>, and fracture/impact/<steps>/<threads>: the run of
// examples/impact with 21,791 triangles, whose block falls to pieces; 600 steps make 2,000 cracks.
// fracture/rubble/<threads>: the same with 220,000 triangles, from step 2,000 on.
// A steel cylinder hits a brittle block; the triangles' edges are the same in all sizes, only the
// block is larger.
// Counters: `crack` is the time of strength check, cracks, relinking and candidates (µs for each
// crack); `share` is its part in the step, `contact` that of search, local search and correction.
#include <benchmark/benchmark.h>

#include <cmath>

#include "benchmark/fe_scenes.hpp"

namespace yadefrag {
namespace {

constexpr double kSize = .4e-3;  // m
constexpr int kSteps = 400, kRubbleBegin = 2000;

void addBrittleImpact(World& world, double triangles, double fractureEnergy) {
  constexpr double kRadius = 2e-3;
  // An equilateral triangle takes √3/4·size².
  const double high = std::sqrt(triangles * .433 * kSize * kSize / 2);
  const TriangleMesh block =
      triangulate({{{-high, -high}, {high, -high}, {high, 0}, {-high, 0}}, {}}, kSize);
  BodySpec spec = fescenes::steelBody(block, {});
  spec.material = {370e9, .22, 3900, false};
  spec.brittle.tensileStrength = 300e6;
  spec.brittle.fractureEnergy = fractureEnergy;
  spec.brittle.strengthScatter = .1;
  spec.friction = .3;
  spec.held.assign(block.nodes.size(), kFree);
  for (std::size_t i = 0; i < block.nodes.size(); ++i)
    if (block.nodes[i].y < -high + 1e-9) spec.held[i] = kHeldXY;
  world.addBody(block, spec);
  const TriangleMesh cylinder =
      triangulate({fescenes::circle({0, kRadius * 1.001}, kRadius, kSize), {}}, kSize);
  world.addBody(cylinder, fescenes::steelBody(cylinder, {0, -50}));
}

constexpr double kImpactSize = 3.05e-4, kRubbleSize = .96e-4;  // m

void addImpact(World& world, double size) {
  constexpr double kRadius = 5e-3, kWide = 40e-3, kHigh = 20e-3;
  const TriangleMesh block =
      triangulate({{{0, 0}, {kWide, 0}, {kWide, kHigh}, {0, kHigh}}, {}}, size);
  BodySpec spec = fescenes::steelBody(block, {});
  spec.material = {370e9, .22, 3900, false};
  spec.brittle.tensileStrength = 300e6;
  spec.brittle.strengthScatter = .1;
  spec.brittle.seed = 1;
  spec.friction = std::tan(.3);
  spec.held.assign(block.nodes.size(), kFree);
  for (std::size_t i = 0; i < block.nodes.size(); ++i)
    if (block.nodes[i].y < 1e-9) spec.held[i] = kHeldXY;
  world.addBody(block, spec);
  const TriangleMesh cylinder =
      triangulate({fescenes::circle({kWide / 2, kHigh + kRadius + 2e-5}, kRadius, size), {}}, size);
  BodySpec steel = fescenes::steelBody(cylinder, {0, -50});
  steel.smoothNodes.assign(cylinder.nodes.size(), 1);
  world.addBody(cylinder, steel);
}

void timeSteps(benchmark::State& state, World& world) {
  const double dt = .8 * world.criticalTimeStep();
  world.step(dt);
  world.timing = true;
  const std::size_t segments = world.surfaces.segments();
  for ([[maybe_unused]] auto once : state) world.step(dt);
  const StageTimes& t = world.times;
  const double all = t.forces + t.contact() + t.fracture;
  const auto cracks = static_cast<double>(world.fracture.numCracks());
  state.counters["triangles"] = static_cast<double>(world.model.triangles.size());
  state.counters["cracks"] = cracks;
  state.counters["segments from"] = static_cast<double>(segments);
  state.counters["to"] = static_cast<double>(world.surfaces.segments());
  state.counters["crack"] = 1e6 * t.fracture / cracks;
  state.counters["share"] = t.fracture / all;
  state.counters["contact"] = t.contact() / all;
}

void crackSteps(benchmark::State& state, double fractureEnergy) {
  World world;
  addBrittleImpact(world, static_cast<double>(state.range(0)), fractureEnergy);
  timeSteps(state, world);
}

/// Arguments: steps, threads.
void impactSteps(benchmark::State& state) {
  World world;
  world.threads = static_cast<int>(state.range(1));
  addImpact(world, kImpactSize);
  timeSteps(state, world);
}

/// Argument: threads. All runs continue one world, so that each thread number sees like rubble.
void rubbleSteps(benchmark::State& state) {
  static World world;
  if (world.model.nodes.size() == 0) {
    addImpact(world, kRubbleSize);
    world.threads = 2;
    const double dt = .8 * world.criticalTimeStep();
    for (int i = 0; i < kRubbleBegin; ++i) world.step(dt);
  }
  world.threads = static_cast<int>(state.range(0));
  world.times = {};
  timeSteps(state, world);
  const StageTimes& t = world.times;
  const double all = t.forces + t.contact() + t.fracture;
  state.counters.erase("crack");  // most cracks are older
  state.counters["slaves"] = static_cast<double>(world.contact.candidates.slaves.size());
  for (const auto& [name, stage] :
       {std::pair{"forces", t.forces}, std::pair{"search", t.search},
        std::pair{"detection", t.localSearch}, std::pair{"correction", t.correction}})
    state.counters[name] = stage / all;
}

[[maybe_unused]] const bool kRegistered = [] {
  for (const auto& [name, energy] : {std::pair{"instant", 0.}, std::pair{"cohesive", 500.}})
    benchmark::RegisterBenchmark((std::string("fracture/") + name).c_str(), crackSteps, energy)
        ->Arg(2000)
        ->Arg(20000)
        ->Arg(200000)
        ->Arg(1000000)
        ->Iterations(kSteps)
        ->Unit(benchmark::kMillisecond)
        ->UseRealTime();
  for (const int steps : {600, 6000})
    for (const int threads : {1, 2})
      benchmark::RegisterBenchmark("fracture/impact", impactSteps)
          ->Args({steps, threads})
          ->Iterations(steps)
          ->Unit(benchmark::kMillisecond)
          ->UseRealTime();
  for (const int threads : {1, 2, 1, 2, 1, 2})
    benchmark::RegisterBenchmark("fracture/rubble", rubbleSteps)
        ->Arg(threads)
        ->Iterations(100)
        ->Unit(benchmark::kMillisecond)
        ->UseRealTime();
  return true;
}();

}  // namespace
}  // namespace yadefrag
