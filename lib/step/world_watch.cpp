// Between two searches: who may have left the halo. Most steps need no look at any node, since the
// sum of the largest moves is bound enough; whatever the bounds, a search comes in the same step.

#include <algorithm>
#include <cmath>

#include "core/tolerances.hpp"
#include "step/world.hpp"

namespace yadefrag {

void World::watchAll() {
  search.nodes.clear();
  for (const NodeId node : surfaces.segmentNode)
    if (model.nodes.mass[node.value] > 0) search.nodes.push_back(node);
  std::sort(search.nodes.begin(), search.nodes.end());
}

void World::copySurface() {
  for (const NodeId node : search.nodes) before_[node.value] = model.nodes.position[node.value];
}

void World::rememberSurface(double dt) {
  if (!canTouch()) return;
  const StageTimer timer(timesIfAsked(), &StageTimes::search);
  const double most = dynamics_.speedLimit() * dt;
  isQuiet_ = contact.candidates.size() == 0 && !search.isDue && !search.isVoid &&
             fracture.cohesion.edge.empty() && farthest_ + most <= search.halo / 2 &&
             most <= tolerance::kFarthestMove * finest_ &&
             !(apart_.any() && apart_.spare() < 2 * most);
  if (!isQuiet_) copySurface();
}

/// From x*. Where nobody is faster than foreseen, there is nothing to look at in a quiet step.
void World::measureMove(double dt) {
  const StageTimer timer(timesIfAsked(), &StageTimes::search);
  if (dynamics_.anyFaster()) {
    watchSpeed(dt);
    // But for rounding.
    if (isQuiet_)
      for (const NodeId node : search.nodes)
        before_[node.value] =
            model.nodes.position[node.value] - dt * model.nodes.velocity[node.value];
    isQuiet_ = false;
  } else {
    mostMove_ = dynamics_.speedLimit() * dt;
  }
  watchApart(dt);
  if (isQuiet_) {
    largestMove_ = mostMove_;
  } else {
    double most = 0;
    for (const NodeId node : search.nodes) {
      const Vec2 moved = model.nodes.position[node.value] - before_[node.value];
      most = std::max(most, dot(moved, moved));
    }
    largestMove_ = std::sqrt(most);
  }
  farthest_ += largestMove_;
}

/// How fast all nodes are now, and what the next steps are to tell.
void World::watchSpeed(double dt) {
  double most = 0;
  for (const Vec2 velocity : model.nodes.velocity) most = std::max(most, dot(velocity, velocity));
  most = std::sqrt(most);
  mostMove_ = most * dt;
  dynamics_.watchSpeed(std::min(tolerance::kSpeedSpare * most, tolerance::kAnySpeed));
}

/// (m) Nobody comes so near to a body that is apart. Two bodies that meet in a step are not farther
/// than twice its largest move at the end.
double World::apartReach() const {
  return std::max(search.halo, tolerance::kApartMoves * mostMove_);
}

/// Bodies that are not apart any more are watched from this very step on.
void World::watchApart(double dt) {
  if (!apart_.any()) return;
  apart_.comeNearer(2 * mostMove_);
  if (apart_.spare() >= 0) return;
  apart_.look(model, surfaces, apartReach());
  if (apart_.spare() >= 0) return;
  search.isDue = true;
  chooseWatched(dt);
}

/// `ago`: how long (s) the end of the last step is past, at the present velocities.
void World::chooseWatched(double ago) {
  if (!apart_.choose(model, surfaces, apartReach())) return;
  watchAll();
  const std::vector<ComponentId>& bodies = model.nodes.component;
  std::erase_if(search.nodes, [&](NodeId node) { return apart_.isApart(bodies[node.value]); });
  for (const NodeId node : search.nodes)
    if (apart_.wasApart(bodies[node.value]))
      before_[node.value] =
          model.nodes.position[node.value] - ago * model.nodes.velocity[node.value];
  search.positions.clear();
  search.isVoid = true;
}

/// May the next step leave the halo, or somebody come near a body that was apart?
void World::foreseeSearch(double dt) {
  if (search.isDue) return;
  const StageTimer timer(timesIfAsked(), &StageTimes::search);
  if (apart_.any() && apart_.spare() < 2 * dynamics_.speedLimit() * dt) {
    watchSpeed(dt);
    apart_.look(model, surfaces, apartReach());
    search.isDue = apart_.spare() < 2 * dynamics_.speedLimit() * dt;
    if (search.isDue) return;
  }
  const double most = largestMove_ + contact.largestCorrection();
  if (farthest_ + tolerance::kHaloSpare * most <= search.halo / 2) return;
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
  farthest_ = farthest;
}

}  // namespace yadefrag
