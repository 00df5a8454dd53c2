// One run for tests/benchmark/unused.py:
//   yadefrag_unused rings COUNT STEPS [FEATURE...]
//   yadefrag_unused blocks COUNT STEPS             (far from each other, as the next ones)
//   yadefrag_unused squares COUNT STEPS            (of a coarser mesh)
//   yadefrag_unused farRings COUNT STEPS
//
// Prints one line of JSON. Under callgrind only the last steps are counted: not how the scene is
// made, and not the steps until its bodies have met.

#if __has_include(<valgrind/callgrind.h>)
#include <valgrind/callgrind.h>
#include <algorithm>
#else
#define CALLGRIND_START_INSTRUMENTATION
#define CALLGRIND_STOP_INSTRUMENTATION
#endif

#include <chrono>
#include <cstdlib>
#include <fstream>
#include <iostream>
#include <string>

#include "step/unused_scenes.hpp"

namespace yadefrag::test {
namespace {

constexpr int kToMeet = 120;

/// (bytes) Peak resident memory of this process.
long peakMemory() {
  std::ifstream status("/proc/self/status");
  for (std::string word; status >> word;)
    if (word == "VmHWM:") {
      long kilobytes = 0;
      status >> kilobytes;
      return 1024 * kilobytes;
    }
  return 0;
}

void printBytes(const Footprint& footprint) {
  const char* const names[] = {"mesh",      "dynamics",  "held",       "materials", "loads",
                               "viscosity", "smoothing", "plasticity", "surfaces",  "smooth",
                               "search",    "contact",   "fracture",   "cohesion"};
  static_assert(std::size(names) == static_cast<std::size_t>(Use::kCount));
  for (std::size_t i = 0; i < std::size(names); ++i)
    std::cout << (i == 0 ? "" : ", ") << '"' << names[i]
              << "\": " << footprint.of(static_cast<Use>(i));
}

void run(World& world, double part, int steps) {
  const double dt = part * world.criticalTimeStep();
  for (int i = 0; i < kToMeet; ++i) world.step(dt);
  std::size_t rows = 0;
  const auto start = std::chrono::steady_clock::now();
  CALLGRIND_START_INSTRUMENTATION;
  for (int i = 0; i < steps; ++i) {
    world.step(dt);
    rows += world.contact.rows().size();
  }
  CALLGRIND_STOP_INSTRUMENTATION;
  const std::chrono::duration<double> took = std::chrono::steady_clock::now() - start;
  std::cout << "{\"triangles\": " << world.model.triangles.size()
            << ", \"entries\": " << world.surfaces.entries() << ", \"rows\": " << rows / steps
            << ", \"searches\": " << world.numSearches()
            << ", \"cracks\": " << world.fracture.numCracks()
            << ", \"step\": " << took.count() / steps << ", \"peak\": " << peakMemory()
            << ", \"bytes\": {";
  printBytes(world.footprint());
  std::cout << "}}\n";
}

int main(int count, char** arguments) {
  if (count < 4) {
    std::cerr << "needs a scene, a count and a number of steps\n";
    return 2;
  }
  const std::string scene = arguments[1];
  Uses uses;
  for (int i = 4; i < count; ++i)
    if (!uses.turnOn(arguments[i])) {
      std::cerr << "there is no feature '" << arguments[i] << "'\n";
      return 2;
    }
  World world;
  const int bodies = std::atoi(arguments[2]);
  if (scene == "blocks" || scene == "squares")
    addFarBlocks(world, bodies, scene == "blocks" ? 64 : 24);
  else if (scene == "farRings")
    addFarRings(world, bodies);
  else
    addRings(world, bodies, uses);
  run(world, uses.cohesion ? .2 : .8, std::max(1, std::atoi(arguments[3])));
  return 0;
}

}  // namespace
}  // namespace yadefrag::test

int main(int count, char** arguments) {
  try {
    return yadefrag::test::main(count, arguments);
  } catch (const std::exception& error) {
    std::cerr << error.what() << '\n';
    return 1;
  }
}
