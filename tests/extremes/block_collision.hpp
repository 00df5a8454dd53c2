#pragma once
// One block hits another, however large, fast, heavy or far away: what came of it.

#include <algorithm>
#include <cmath>
#include <string>

#include "extremes/limits.hpp"
#include "fracture/overlaps.hpp"
#include "step/bodies.hpp"

namespace yadefrag::test {

struct BlockCollision {
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
  std::string refusal;      ///< the sentence, if there was one
  Vec2 left, right;         ///< mean velocities at the end, of the speed, turned back
  double momentum = 0;      ///< change, of the start's
  double growth = 0;        ///< kinetic and strain energy, of the start's
  double deepest = 0;       ///< of the shortest segment at the start
  std::vector<Vec2> nodes;  ///< m, at the end, shift and turn taken back
  [[nodiscard]] bool isSound(double mostGrowth = 5e-3, double mostDeep = 1e-2) const {
    return refusal.empty() && momentum < 1e-9 && growth < mostGrowth && deepest < mostDeep &&
           right.x > left.x && right.x > 0;
  }
};

inline void addBlock(World& world, const BlockCollision& collision, Vec2 low, int parts,
                     const ElasticMaterial& material, double speed) {
  TriangleMesh mesh = structuredRectangle(low, low + Vec2{1, 1}, parts, parts);
  for (Vec2& node : mesh.nodes)
    node = collision.shift + turnedBy(collision.size * node, collision.turn);
  addMoving(world, mesh, material, turnedBy({speed, 0}, collision.turn));
}

inline World worldOf(const BlockCollision& collision) {
  World world = inPasses(collision.passes);
  addBlock(world, collision, {-1 - collision.gap, 0}, collision.parts, collision.left,
           collision.speed);
  addBlock(world, collision, {0, collision.aside}, collision.parts + 1, collision.right, 0);
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

struct TimedResult {
  std::string refusal;
  double deepest = 0;  ///< m
  double growth = 0;   ///< of the start's energy
  bool touched = false;
};

/// Runs for a time (s), and looks two hundred times. `shorten`: see stepOrShorter.
inline TimedResult watchFor(World& world, double time, double ofCritical = .8,
                            bool shorten = true) {
  TimedResult result;
  const double energy = world.kineticEnergy() + world.strainEnergy();
  result.refusal = sentenceOf([&] {
    double dt = ofCritical * world.criticalTimeStep(), look = 0;
    while (world.time < time) {
      stepOrShorter(world, dt, shorten);
      result.touched = result.touched || !world.contact.rows().empty();
      if (world.time < look) continue;
      look += time / 200;
      result.deepest = std::max(result.deepest, deepestNode(world));
      const double now = world.kineticEnergy() + world.strainEnergy();
      if (energy > 0) result.growth = std::max(result.growth, now / energy - 1);
    }
  });
  return result;
}

inline Outcome collide(const BlockCollision& collision) {
  Outcome outcome;
  World world;
  outcome.refusal = sentenceOf([&] { world = worldOf(collision); });
  if (world.model.components.size() < 2) return outcome;
  const double slower = std::min(waveSpeed(collision.left), waveSpeed(collision.right));
  const double end = collision.size * (collision.until / slower + collision.gap / collision.speed);
  const TimedResult run = watchFor(world, end, collision.ofCritical, collision.shorten);
  outcome.refusal = run.refusal;
  outcome.growth = run.growth;
  outcome.deepest = run.deepest / (collision.size / (collision.parts + 1));
  const ComponentId a(0UL), b(1UL);
  const Vec2 left = momentum(world, a), right = momentum(world, b);
  const auto back = [&](Vec2 vector) { return turnedBy(vector, -collision.turn); };
  const double start = collision.speed * mass(world, a);
  outcome.momentum = norm(back(left + right) - Vec2{start, 0}) / start;
  outcome.left = (1 / start) * back(left);
  outcome.right = (1 / (collision.speed * mass(world, b))) * back(right);
  for (const Vec2 node : world.model.nodes.position)
    outcome.nodes.push_back(back(node - collision.shift));
  return outcome;
}

/// (1) How far two outcomes differ, at nodes, of the blocks' size.
inline double difference(const BlockCollision& collision, const Outcome& outcome,
                         const BlockCollision& other, const Outcome& otherOutcome) {
  double most = 0;
  for (std::size_t i = 0; i < outcome.nodes.size(); ++i)
    most = std::max(most, norm((1 / collision.size) * outcome.nodes[i] -
                               (1 / other.size) * otherOutcome.nodes[i]));
  return most;
}

}  // namespace yadefrag::test
