// Finite-element bodies without contact: time of one explicit step, per element.
//
// Names: step/<elements>/<threads>; ledger included.
#include <benchmark/benchmark.h>

#include <cmath>

#include "dynamics/critical_time_step.hpp"
#include "dynamics/explicit_dynamics.hpp"
#include "mesh/assembly.hpp"
#include "meshing/structured.hpp"

namespace yadefrag {
namespace {

/// A square block of about so many triangles that spins.
Model spinningBlock(std::int64_t elements) {
  const int side = static_cast<int>(std::lround(std::sqrt(static_cast<double>(elements) / 2)));
  Component steel;
  steel.material = {.young = 210e9, .poisson = .3, .density = 7800};
  Model model;
  appendBody(model, structuredRectangle({-.5, -.5}, {.5, .5}, side, side), steel);
  for (std::size_t n = 0; n < model.nodes.size(); ++n)
    model.nodes.velocity[n] = -100 * rightOf(model.nodes.position[n]);
  return model;
}

void stepBlock(benchmark::State& state, const StepSettings& settings,
               InstructionSet set = bestInstructionSet()) {
  Model model = spinningBlock(state.range(0));
  ExplicitDynamics dynamics(set);
  dynamics.rebuild(model);
  const double dt = .8 * criticalTimeStep(model, settings.viscosity);
  const int threads = static_cast<int>(state.range(1));
  EnergyLedger ledger;
  for ([[maybe_unused]] auto once : state) {
    dynamics.predict(model, dt, settings, {}, threads);
    dynamics.finish(model, dt, settings, {}, {}, ledger, threads);
  }
  const auto steps = static_cast<double>(model.triangles.size() * state.iterations());
  state.counters["time/element"] =
      benchmark::Counter(steps, benchmark::Counter::kIsRate | benchmark::Counter::kInvert);
}

void plainStep(benchmark::State& state) { stepBlock(state, {}); }
void viscousStep(benchmark::State& state) { stepBlock(state, {.viscosity = {.06, 1.2}}); }

void gravityStep(benchmark::State& state) { stepBlock(state, {.gravity = {0, -9.81}}); }

void baselineStep(benchmark::State& state) { stepBlock(state, {}, InstructionSet::kBaseline); }

BENCHMARK(plainStep)
    ->Name("step")
    ->ArgsProduct({{10000, 100000, 1000000}, {1, 2}})
    ->Unit(benchmark::kMillisecond)
    ->UseRealTime();
BENCHMARK(gravityStep)
    ->Name("step with gravity")
    ->ArgsProduct({{100000}, {1, 2}})
    ->Unit(benchmark::kMillisecond)
    ->UseRealTime();
BENCHMARK(viscousStep)
    ->Name("step with bulk viscosity")
    ->ArgsProduct({{100000}, {1, 2}})
    ->Unit(benchmark::kMillisecond)
    ->UseRealTime();

BENCHMARK(baselineStep)
    ->Name("step without AVX")
    ->Args({100000, 1})
    ->Unit(benchmark::kMillisecond)
    ->UseRealTime();
}  // namespace
}  // namespace yadefrag
