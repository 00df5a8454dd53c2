// The elastic impact that fe_ccx.py puts beside CalculiX.
//
// Name: impact-course/<triangles across the cylinder>; one iteration is the whole impact, its time
// that of the steps alone. Where FE_IMPACT names a folder, the mesh and the course are written
// there: mesh.txt with lines "node x y held component mass", "triangle a b c component" and
// "boundary a b component"; course.txt with lines "time velocity" of the cylinder (s, m/s).
#include <benchmark/benchmark.h>

#include <chrono>
#include <cstdlib>
#include <fstream>
#include <string>

#include "benchmark/fe_scenes.hpp"

namespace yadefrag {
namespace {

constexpr double kUntil = 20e-6;  // s, contact is over by then

void writeMesh(const World& world, const std::string& file) {
  std::ofstream out(file);
  out.precision(17);
  const Nodes& nodes = world.model.nodes;
  for (std::size_t n = 0; n < nodes.size(); ++n)
    out << "node " << nodes.position[n].x << ' ' << nodes.position[n].y << ' ' << int{nodes.held[n]}
        << ' ' << nodes.component[n].value << ' ' << nodes.mass[n] << '\n';
  const Triangles& triangles = world.model.triangles;
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    out << "triangle";
    for (const NodeId node : triangles.nodes[t]) out << ' ' << node.value;
    out << ' ' << triangles.component[t].value << '\n';
  }
  const ContactSurfaces& surfaces = world.surfaces;
  for (std::size_t s = 0; s < surfaces.segments(); ++s) {
    const NodeId next = surfaces.segmentNode[surfaces.segmentNext[s].value];
    out << "boundary " << surfaces.segmentNode[s].value << ' ' << next.value << ' '
        << surfaces.component[surfaces.segmentEntry[s].value].value << '\n';
  }
}

/// (m/s) Mean velocity of the cylinder, downwards negative.
double meanVelocity(const World& world) {
  const ComponentId cylinder(1);
  double momentum = 0, mass = 0;
  for (std::size_t n = 0; n < world.model.nodes.size(); ++n)
    if (world.model.nodes.component[n] == cylinder) {
      momentum += world.model.nodes.mass[n] * world.model.nodes.velocity[n].y;
      mass += world.model.nodes.mass[n];
    }
  return momentum / mass;
}

void impact(benchmark::State& state) {
  using Clock = std::chrono::steady_clock;
  const char* folder = std::getenv("FE_IMPACT");
  double steps = 0, triangles = 0, dt = 0;
  for ([[maybe_unused]] auto once : state) {
    World world;
    fescenes::addImpact(world, 10e-3 / static_cast<double>(state.range(0)), false);
    std::ofstream course;
    if (folder != nullptr) {
      writeMesh(world, std::string(folder) + "/mesh.txt");
      course.open(std::string(folder) + "/course.txt");
    }
    dt = .8 * world.criticalTimeStep();
    std::chrono::duration<double> taken{};
    for (steps = 0; world.time < kUntil; ++steps) {
      const auto start = Clock::now();
      world.step(dt);
      taken += Clock::now() - start;
      if (course.is_open()) course << world.time - dt / 2 << ' ' << meanVelocity(world) << '\n';
    }
    triangles = static_cast<double>(world.model.triangles.size());
    state.SetIterationTime(taken.count());
  }
  state.counters["triangles"] = triangles;
  state.counters["steps"] = steps;
  state.counters["dt"] = dt;
}

BENCHMARK(impact)
    ->Name("impact-course")
    ->Arg(10)
    ->Arg(20)
    ->Unit(benchmark::kMillisecond)
    ->UseManualTime();

}  // namespace
}  // namespace yadefrag
