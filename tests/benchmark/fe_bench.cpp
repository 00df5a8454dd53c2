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

/// All triangles of a block flow: its nodes are held, and it is sheared at a constant rate.
void flowingStep(benchmark::State& state, const PlasticMaterial& plastic, ElementKind element) {
  Model model = spinningBlock(50000);
  Component& body = model.components.front();
  body.plastic = plastic, body.element = element;
  model.triangles.plastic.resize(model.triangles.size());
  for (std::size_t e = 0; e < model.triangles.size(); ++e)
    model.triangles.plastic.begin(e, model.triangles.inverseEdges[e], plastic.startTemperature);
  for (std::size_t n = 0; n < model.nodes.size(); ++n) {
    model.nodes.velocity[n] = {300 * model.nodes.position[n].x, -300 * model.nodes.position[n].y};
    model.nodes.held[n] = kHeldXY;
  }
  ExplicitDynamics dynamics;
  dynamics.rebuild(model);
  const double dt = .3 * criticalTimeStep(model);
  for (int i = 0; i < 60; ++i) dynamics.predict(model, dt, {}, {}, 1);
  for ([[maybe_unused]] auto once : state) dynamics.predict(model, dt, {}, {}, 1);
  state.counters["time/element"] =
      benchmark::Counter(static_cast<double>(model.triangles.size() * state.iterations()),
                         benchmark::Counter::kIsRate | benchmark::Counter::kInvert);
}

void idealStep(benchmark::State& state) {
  flowingStep(state, {.yieldStress = 400e6}, ElementKind::kSmoothed);
}
void johnsonCookStep(benchmark::State& state) {
  PlasticMaterial m{.yieldStress = 400e6, .hardening = 500e6, .hardeningExponent = .3};
  m.rateFactor = .02, m.thermalExponent = 1.03, m.meltTemperature = 1800, m.heatCapacity = 480;
  flowingStep(state, m, ElementKind::kSmoothed);
}

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

BENCHMARK(idealStep)->Name("step, ideal plasticity, all flow")->Unit(benchmark::kMillisecond);
BENCHMARK(johnsonCookStep)->Name("step, Johnson-Cook, all flow")->Unit(benchmark::kMillisecond);
BENCHMARK(baselineStep)
    ->Name("step without AVX")
    ->Args({100000, 1})
    ->Unit(benchmark::kMillisecond)
    ->UseRealTime();
}  // namespace
}  // namespace yadefrag
