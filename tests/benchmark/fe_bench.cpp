// Finite-element bodies: time of one explicit step without contact, per element; where the time of
// a step goes in contact.
//
// Names: step/<elements>/<threads>, ledger included; contact/<scene>/<size>/<threads>. Counters are
// ns per step and triangle (forces) or per step and surface entry (search, local search,
// correction), and ns per entry of one search. A first part of each run, until bodies have met, is
// not measured; of blocks, which touch from the start or stay apart, all of it is.

#include <benchmark/benchmark.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

#include "elements/blocks.hpp"
#include "step/bodies.hpp"
#include "time/critical_time_step.hpp"
#include "time/explicit_dynamics.hpp"

namespace yadefrag {
namespace {

/// A square block of about so many triangles that spins.
Model spinningBlock(std::int64_t elements) {
  const int side = static_cast<int>(std::lround(std::sqrt(static_cast<double>(elements) / 2)));
  Model model = modelOf(structuredRectangle({-.5, -.5}, {.5, .5}, side, side), kSteel);
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

PlasticMaterial idealPlasticity() { return {.yieldStress = 400e6}; }
PlasticMaterial powerLaw() {
  return {.yieldStress = 400e6, .hardeningExponent = .2, .offsetStrain = .01};
}
PlasticMaterial johnsonCook() {
  PlasticMaterial m{.yieldStress = 400e6, .hardening = 500e6, .hardeningExponent = .3};
  m.rateFactor = .02, m.thermalExponent = 1.03, m.meltTemperature = 1800, m.heatCapacity = 480;
  return m;
}
PlasticMaterial frictional() {
  PlasticMaterial m;
  m.cohesion = 200e6, m.internalFriction = .5, m.dilation = .3;
  return m;
}

/// A block whose nodes are held is sheared at a constant rate: if it yields, all triangles flow.
void heldStep(benchmark::State& state, const PlasticMaterial& plastic, ElementKind element) {
  Model model = spinningBlock(state.range(1));
  Component& body = model.components.front();
  body.plastic = plastic, body.element = element;
  if (plastic.yields()) model.triangles.plastic.resize(model.triangles.size());
  for (std::size_t e = 0; e < model.triangles.size() && plastic.yields(); ++e)
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

template <PlasticMaterial (*kMaterial)()>
void flowingStep(benchmark::State& state) {
  heldStep(state, kMaterial(), state.range(0) == 0 ? ElementKind::kLinear : ElementKind::kSmoothed);
}
PlasticMaterial elastic() { return {}; }
PlasticMaterial neverYields() { return {.yieldStress = 1e15}; }

void inMs(benchmark::internal::Benchmark* one) {
  one->Unit(benchmark::kMillisecond)->UseRealTime();
}

BENCHMARK(plainStep)->Name("step")->ArgsProduct({{10000, 100000, 1000000}, {1, 2}})->Apply(inMs);
BENCHMARK(gravityStep)->Name("step with gravity")->ArgsProduct({{100000}, {1, 2}})->Apply(inMs);
BENCHMARK(viscousStep)
    ->Name("step with bulk viscosity")
    ->ArgsProduct({{100000}, {1, 2}})
    ->Apply(inMs);

// Names: held step/<material>/<0: linear, 1: smoothed>/<elements>.
#define HELD_STEP(material)                  \
  BENCHMARK_TEMPLATE(flowingStep, material)  \
      ->Name("held step/" #material)         \
      ->ArgsProduct({{0, 1}, {5000, 50000}}) \
      ->Unit(benchmark::kMillisecond)
HELD_STEP(elastic);
HELD_STEP(neverYields);
HELD_STEP(idealPlasticity);
HELD_STEP(powerLaw);
HELD_STEP(johnsonCook);
HELD_STEP(frictional);
BENCHMARK(baselineStep)->Name("step without AVX")->Args({100000, 1})->Apply(inMs);

// --- Elastic bodies in contact: the scenes of the paper's figures 11 and 12 and an impact. Lengths
// in mm of steel.

constexpr double kSpeed = 20;  // m/s

BodySpec steelBody(const TriangleMesh& mesh, Vec2 velocity) {
  BodySpec spec = test::moving(mesh, test::steel(), velocity);
  spec.selfContact = false;
  return spec;
}

Vec2 someDirection(std::mt19937_64& random) {
  const double angle = std::uniform_real_distribution<double>(0, 2 * std::numbers::pi)(random);
  return {std::cos(angle), std::sin(angle)};
}

/// With edges of about this size.
test::Loop circleOf(Vec2 centre, double radius, double size) {
  return test::circle(centre, radius,
                      static_cast<int>(std::lround(2 * std::numbers::pi * radius / size)));
}

/// Fig. 12: concentric rings, 1 mm thick, 0.1 mm apart, two and a half triangles thick; each starts
/// in a direction of its own.
void addRings(World& world, int count, bool smooth) {
  constexpr double kInnermost = 4e-3, kThickness = 1e-3, kGap = .1e-3, kSize = .4e-3;
  std::mt19937_64 random(12);
  for (int i = 0; i < count; ++i) {
    const double inner = kInnermost + i * (kThickness + kGap);
    Polygon ring;
    ring.outline = circleOf({}, inner + kThickness, kSize);
    ring.holes.push_back(circleOf({}, inner, kSize));
    const TriangleMesh mesh = triangulate(ring, kSize);
    BodySpec spec = steelBody(mesh, kSpeed * someDirection(random));
    if (smooth) test::smoothAll(spec, mesh);
    world.addBody(mesh, spec);
  }
}

/// Fig. 11: n × n squares of 1 mm and 8 × 8 × 2 triangles in a frame that is held, 0.1 mm apart; a
/// quarter of them moves.
void addSquares(World& world, int n) {
  constexpr double kEdge = 1e-3, kGap = .1e-3, kPitch = kEdge + kGap, kWall = .5e-3;
  constexpr int kCells = 8;
  std::mt19937_64 random(11);
  std::vector<Vec2> velocities(static_cast<std::size_t>(n * n));
  for (std::size_t i = 0; i < velocities.size() / 4; ++i)
    velocities[i] = kSpeed * someDirection(random);
  std::shuffle(velocities.begin(), velocities.end(), random);
  for (int k = 0; k < n * n; ++k) {
    const int column = k % n, row = k / n;
    const Vec2 low{kGap + kPitch * column, kGap + kPitch * row};
    const TriangleMesh mesh = structuredRectangle(low, low + Vec2{kEdge, kEdge}, kCells, kCells);
    world.addBody(mesh, steelBody(mesh, velocities[static_cast<std::size_t>(k)]));
  }
  const double inside = kPitch * n + kGap, far = inside + kWall;
  const Polygon frame{test::box({-kWall, -kWall}, {far, far}),
                      {test::box({0, 0}, {inside, inside})}};
  const TriangleMesh mesh = triangulate(frame, .3e-3);
  BodySpec spec = steelBody(mesh, {});
  spec.held.assign(mesh.nodes.size(), kHeldXY);
  world.addBody(mesh, spec);
}

struct Impact {
  double size;                                       ///< m, of the triangles' edges
  double radius = 5e-3, wide = 40e-3, high = 20e-3;  ///< m, of the cylinder; of the block
  double speed = kSpeed;                             ///< m/s
  bool smooth = false;                               ///< the cylinder
  double fractureEnergy = NAN;                       ///< J/m², if the block is of a ceramic
};

/// A cylinder falls on a block whose lower side is held.
void addImpact(World& world, const Impact& impact) {
  const TriangleMesh block = triangulate(
      test::rectangle({-impact.wide / 2, -impact.high}, {impact.wide / 2, 0}), impact.size);
  BodySpec spec = steelBody(block, {});
  if (!std::isnan(impact.fractureEnergy)) {
    spec.material = {370e9, .22, 3900, false};
    spec.brittle.tensileStrength = 300e6;
    spec.brittle.fractureEnergy = impact.fractureEnergy;
    spec.brittle.strengthScatter = .1;
    spec.brittle.seed = 1;
    spec.friction = std::tan(.3);
  }
  test::hold(spec, block, kHeldXY, [&](Vec2 x) { return x.y < -impact.high + 1e-9; });
  world.addBody(block, spec);
  const TriangleMesh cylinder = triangulate(
      {circleOf({0, impact.radius * 1.001}, impact.radius, impact.size), {}}, impact.size);
  BodySpec steel = steelBody(cylinder, {0, -impact.speed});
  if (impact.smooth) test::smoothAll(steel, cylinder);
  world.addBody(cylinder, steel);
}

struct Scene {
  const char* name;
  void (*add)(World& world, int size);
  int toMeet = 300;  ///< steps
};

const Scene kScenes[] = {
    {"rings", [](World& world, int size) { addRings(world, size, false); }},
    {"smooth rings", [](World& world, int size) { addRings(world, size, true); }},
    {"squares", [](World& world, int size) { addSquares(world, size); }},
    {"impact", [](World& world, int size) { addImpact(world, {10e-3 / size}); }},
    {"smooth impact",
     [](World& world, int size) { addImpact(world, {.size = 10e-3 / size, .smooth = true}); }},
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
  state.counters["triangles"] = triangles;
  state.counters["entries"] = entries;
  state.counters["candidates"] = static_cast<double>(world.contact.candidates.size());
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
      ->Apply(inMs);
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

// --- Bodies that crack: what a crack costs, in blocks of more and more triangles that crack alike.
//
// Names: fracture/<law>/<triangles, about>, and fracture/impact/<steps>/<threads>: the run of
// examples/impact with 21,791 triangles, whose block falls to pieces; 600 steps make 2,000 cracks.
// fracture/rubble/<threads>: the same with 220,000 triangles, from step 2,000 on.
// A steel cylinder hits a brittle block; the triangles' edges are the same in all sizes, only the
// block is larger.
// Counters: `crack` is the time of strength check, cracks, relinking and candidates (µs for each
// crack); `share` is its part in the step, `contact` that of search, local search and correction.

constexpr double kSize = .4e-3;  // m
constexpr int kSteps = 400, kRubbleBegin = 2000;

void addBrittleImpact(World& world, double triangles, double fractureEnergy) {
  // An equilateral triangle takes √3/4·size².
  const double high = std::sqrt(triangles * .433 * kSize * kSize / 2);
  addImpact(world, {.size = kSize,
                    .radius = 2e-3,
                    .wide = 2 * high,
                    .high = high,
                    .speed = 50,
                    .fractureEnergy = fractureEnergy});
}

constexpr Impact kImpact{.size = 3.05e-4, .speed = 50, .smooth = true, .fractureEnergy = 0};
constexpr Impact kRubble{.size = .96e-4, .speed = 50, .smooth = true, .fractureEnergy = 0};

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
  addImpact(world, kImpact);
  timeSteps(state, world);
}

/// Argument: threads. All runs continue one world, so that each thread number sees like rubble.
void rubbleSteps(benchmark::State& state) {
  static World world;
  if (world.model.nodes.size() == 0) {
    addImpact(world, kRubble);
    world.threads = 2;
    test::stepFor(world, .8, kRubbleBegin);
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

[[maybe_unused]] const bool kCracksRegistered = [] {
  for (const auto& [name, energy] : {std::pair{"instant", 0.}, std::pair{"cohesive", 500.}})
    benchmark::RegisterBenchmark((std::string("fracture/") + name).c_str(), crackSteps, energy)
        ->ArgsProduct({{2000, 20000, 200000, 1000000}})
        ->Iterations(kSteps)
        ->Apply(inMs);
  for (const int steps : {600, 6000})
    for (const int threads : {1, 2})
      benchmark::RegisterBenchmark("fracture/impact", impactSteps)
          ->Args({steps, threads})
          ->Iterations(steps)
          ->Apply(inMs);
  for (const int threads : {1, 2, 1, 2, 1, 2})
    benchmark::RegisterBenchmark("fracture/rubble", rubbleSteps)
        ->Arg(threads)
        ->Iterations(100)
        ->Apply(inMs);
  return true;
}();

}  // namespace
}  // namespace yadefrag

BENCHMARK_MAIN();
