// Between two searches: who may have left the halo. Most steps need no look at any node, since the
// sum of the largest moves is bound enough; whatever the bounds, a search comes in the same step.

#include <algorithm>
#include <cmath>

#include "core/tolerances/dynamics.hpp"
#include "core/tolerances/step.hpp"
#include "step/world.hpp"

namespace yadefrag {

void World::watchAll() {
  search.nodes.clear();
  for (const NodeId node : surfaces.segmentNode)
    if (model.nodes.mass[node.value] > 0) search.nodes.push_back(node);
  std::sort(search.nodes.begin(), search.nodes.end());
}

/// Before the step moves anything.
void World::foreseeMotion(double dt) {
  if (!canTouch()) return;
  const StageTimer timer(timesIfAsked(), &StageTimes::search);
  const double most = dynamics_.speedLimit() * dt;
  motion_.isQuiet = contact.candidates.size() == 0 && !search.isDue && !search.isVoid &&
                    fracture.cohesion.edge.empty() && motion_.farthest + most <= search.halo / 2 &&
                    most <= tolerance::kFarthestMove * finest_ &&
                    !(apart_.any() && apart_.spare() < 2 * most);
}

/// From x*. Where no node is faster than foreseen, a quiet step needs no look at the nodes.
void World::measureMove(double dt) {
  const StageTimer timer(timesIfAsked(), &StageTimes::search);
  if (dynamics_.anyFaster()) {
    watchSpeed(dt);
    motion_.isQuiet = false;
  } else {
    motion_.most = dynamics_.speedLimit() * dt;
  }
  watchApart();
  if (motion_.isQuiet) {
    motion_.largest = motion_.most;
  } else {
    double most = 0;
    const std::span<const Vec2> before = dynamics_.previousPosition();
    for (const NodeId node : search.nodes) {
      const Vec2 moved = model.nodes.position[node.value] - before[node.value];
      most = std::max(most, dot(moved, moved));
    }
    motion_.largest = std::sqrt(most);
  }
  motion_.farthest += motion_.largest;
}

/// How fast all nodes are now, and what the next steps are to tell.
void World::watchSpeed(double dt) {
  double most = 0;
  for (const Vec2 velocity : model.nodes.velocity) most = std::max(most, dot(velocity, velocity));
  most = std::sqrt(most);
  motion_.most = most * dt;
  dynamics_.watchSpeed(std::min(tolerance::kSpeedSpare * most, tolerance::kAnySpeed));
}

/// (m) No other body comes so near to one that is apart. Two bodies that meet in a step are not
/// farther than twice its largest move at the end.
double World::apartReach() const {
  return std::max(search.halo, tolerance::kApartMoves * motion_.most);
}

/// Bodies that are not apart any more are watched from this very step on.
void World::watchApart() {
  if (!apart_.any()) return;
  apart_.comeNearer(2 * motion_.most);
  if (apart_.spare() >= 0) return;
  apart_.look(model, surfaces, apartReach());
  if (apart_.spare() >= 0) return;
  keepSearch();
  search.isDue = true;
  chooseWatched();
}

void World::chooseWatched() {
  if (!apart_.choose(model, surfaces, apartReach())) return;
  watchAll();
  const std::vector<ComponentId>& bodies = model.nodes.component;
  std::erase_if(search.nodes, [&](NodeId node) { return apart_.isApart(bodies[node.value]); });
  search.positions.clear();
  search.isVoid = true;
}

/// May the next step leave the halo, or bring a body near one that was apart?
void World::foreseeSearch(double dt) {
  if (search.isDue) return;
  const StageTimer timer(timesIfAsked(), &StageTimes::search);
  if (apart_.any() && apart_.spare() < 2 * dynamics_.speedLimit() * dt) {
    watchSpeed(dt);
    apart_.look(model, surfaces, apartReach());
    search.isDue = apart_.spare() < 2 * dynamics_.speedLimit() * dt;
    if (search.isDue) return;
  }
  const double most = motion_.largest + contact.largestCorrection();
  if (motion_.farthest + tolerance::kHaloSpare * most <= search.halo / 2) return;
  double farthest = 0;
  for (std::size_t i = 0; i < search.nodes.size(); ++i) {
    const std::uint32_t node = search.nodes[i].value;
    const double moved = norm(model.nodes.position[node] - search.positions[i]);
    farthest = std::max(farthest, moved);
    const double next = tolerance::kHaloSpare * norm(model.nodes.velocity[node]) * dt;
    if (moved + next > search.halo / 2) {
      search.isDue = true;
      return;
    }
  }
  motion_.farthest = farthest;
}

}  // namespace yadefrag
