#pragma once
// One block hits another, however large, fast, heavy or far away: what came of it.

#include <algorithm>
#include <cmath>
#include <string>

#include "extremes/limits.hpp"
#include "step/course.hpp"

namespace yadefrag::test {

struct Blow {
  ElasticMaterial left = rubber(), right = rubber();
  double speed = 1;        ///< m/s, of the left one towards the right one
  double size = 1;         ///< m, edge of both
  double gap = 1e-3;       ///< of the size
  double aside = .13;      ///< of the size, of the right one
  double turn = 0;         ///< rad, of the whole scene
  Vec2 shift = {};         ///< m, of the whole scene
  double ofCritical = .8;  ///< time step
  double until = 6;        ///< times that a wave takes through the slower block
  int parts = 3, passes = 2;
  bool shorten = false;  ///< use the shorter steps that messages request
};

struct Outcome {
  std::string refusal;  ///< the sentence, if there was one
  Vec2 left, right;     ///< mean velocities at the end, of the speed, turned back
  double momentum = 0;  ///< change, of the start's
  double growth = 0;    ///< kinetic and strain energy, of the start's
  double deepest = 0;   ///< of a segment, at the end and a hundred times before
  double steps = 0;
  std::vector<Vec2> nodes;  ///< m, at the end, shift and turn taken back
  [[nodiscard]] bool isSound(double mostGrowth = 5e-3) const {
    return refusal.empty() && momentum < 1e-9 && growth < mostGrowth && deepest < 1e-2 &&
           right.x > left.x && right.x > 0;
  }
};

inline Vec2 turned(Vec2 a, double angle) {
  return {std::cos(angle) * a.x - std::sin(angle) * a.y,
          std::sin(angle) * a.x + std::cos(angle) * a.y};
}

inline void addBlock(World& world, const Blow& blow, Vec2 low, int parts,
                     const ElasticMaterial& material, double speed) {
  TriangleMesh mesh = structuredRectangle(low, low + Vec2{1, 1}, parts, parts);
  for (Vec2& node : mesh.nodes) node = blow.shift + turned(blow.size * node, blow.turn);
  world.addBody(mesh, moving(mesh, material, turned({speed, 0}, blow.turn)));
}

inline World worldOf(const Blow& blow) {
  World world;
  world.contactSettings.passes = blow.passes;
  addBlock(world, blow, {-1 - blow.gap, 0}, blow.parts, blow.left, blow.speed);
  addBlock(world, blow, {0, blow.aside}, blow.parts + 1, blow.right, 0);
  return world;
}

inline double waveSpeed(const ElasticMaterial& material) {
  return std::sqrt(material.waveModulus() / material.density);
}

/// One step; if it is refused because bodies move too far, and `shorten`, a shorter one.
inline void stepOrShorter(World& world, double& dt, bool shorten) {
  for (;;) try {
      return world.step(dt);
    } catch (const RunError& error) {
      const std::string text = error.what();
      const bool isTooLong = text.find("take a step of at most") != std::string::npos &&
                             text.find("is pressed to") == std::string::npos;
      if (!shorten || !isTooLong || dt < 1e-12) throw;
      dt *= .5;
    }
}

struct Course2 {
  std::string refusal;
  double deepest = 0;  ///< m
  double growth = 0;   ///< of the start's energy
  bool touched = false;
};

/// Runs for a time (s), and looks two hundred times.
inline Course2 watchFor(World& world, double time, double ofCritical = .8) {
  Course2 course;
  const double energy = world.kineticEnergy() + world.strainEnergy();
  course.refusal = sentenceOf([&] {
    double dt = ofCritical * world.criticalTimeStep(), look = 0;
    while (world.time < time) {
      stepOrShorter(world, dt, true);
      course.touched = course.touched || !world.contact.rows().empty();
      if (world.time < look) continue;
      look += time / 200;
      course.deepest = std::max(course.deepest, deepestNode(world));
      const double now = world.kineticEnergy() + world.strainEnergy();
      if (energy > 0) course.growth = std::max(course.growth, now / energy - 1);
    }
  });
  return course;
}

/// Runs a blow, whose start `world` is.
inline void runBlow(const Blow& blow, World& world, Outcome& outcome) {
  const double slower = std::min(waveSpeed(blow.left), waveSpeed(blow.right));
  const double end = blow.size * (blow.until / slower + blow.gap / blow.speed);
  const double energy = world.kineticEnergy();
  double dt = blow.ofCritical * world.criticalTimeStep();
  double look = 0;
  while (world.time < end) {
    stepOrShorter(world, dt, blow.shorten);
    if (world.time < look) continue;
    look += end / 100;
    outcome.deepest = std::max(outcome.deepest, deepestNode(world) / world.search.shortest);
    const double now = world.kineticEnergy() + world.strainEnergy();
    outcome.growth = std::max(outcome.growth, now / energy - 1);
  }
}

inline Outcome strike(const Blow& blow) {
  Outcome outcome;
  World world;
  outcome.refusal = sentenceOf([&] {
    world = worldOf(blow);
    runBlow(blow, world, outcome);
  });
  if (world.model.components.size() < 2) return outcome;
  const ComponentId a(0UL), b(1UL);
  const Vec2 left = momentum(world, a), right = momentum(world, b);
  const auto back = [&](Vec2 vector) { return turned(vector, -blow.turn); };
  const double start = blow.speed * mass(world, a);
  outcome.momentum = norm(back(left + right) - Vec2{start, 0}) / start;
  outcome.left = (1 / start) * back(left);
  outcome.right = (1 / (blow.speed * mass(world, b))) * back(right);
  for (const Vec2 node : world.model.nodes.position)
    outcome.nodes.push_back(back(node - blow.shift));
  return outcome;
}

/// (1) How far two outcomes differ, at nodes, of the blocks' size.
inline double difference(const Blow& blow, const Outcome& outcome, const Blow& other,
                         const Outcome& otherOutcome) {
  double most = 0;
  for (std::size_t i = 0; i < outcome.nodes.size(); ++i)
    most = std::max(
        most, norm((1 / blow.size) * outcome.nodes[i] - (1 / other.size) * otherOutcome.nodes[i]));
  return most;
}

}  // namespace yadefrag::test
