// World: updates after a split of nodes.

#include <algorithm>
#include <cassert>

#include "fracture/brittle_checks.hpp"
#include "step/world.hpp"

namespace yadefrag {

void World::cohere(const StepLength& length) {
  if (fracture.cohesion.edge.empty()) return;
  const StageTimer timer(timesIfRequested(), &StageTimes::fracture);
  fracture.cohesion.correct(model, fracture.edges, dynamics_.previousPosition(), length,
                            dynamicsSettings.drag(length));
}

void World::countFractureWork(const StepLength& length) {
  if (fracture.cohesion.edge.empty()) return;
  const StageTimer timer(timesIfRequested(), &StageTimes::fracture);
  fracture.cohesion.addWork(ledger, model, dynamics_.previousVelocity(), length);
}

/// Returns true if nodes have split.
bool World::crack() {
  if (!fracture.isOn()) return false;
  const StageTimer timer(timesIfRequested(), &StageTimes::fracture);
  fracture.cohesion.settle(model, fracture.edges);
  const bool opened =
      fracture.crack(model, surfaces, dynamics_.stressed(), {time, lastDt}, split_, threads);
  fracture.noteStart(time);
  double gained = fracture.yieldingGain();
  if (opened) gained += fracture.splitEnergy(model, split_.originals, lastDt);
  ledger.fracture -= gained;
  watch.split += gained;
  if (opened) followSplit();
  fracture.cohere(model);
  loads.spread(model, surfaces, fracture);
  // A step that does not resolve a new law is refused at its begin.
  for (const EdgeId edge : fracture.weakened())
    if (!isResolved(model, fracture.edges, edge, lastDt)) stableStep = 0;
  // A loaded state computes the limits from the present strengths.
  if (fracture.hasRaised()) updateStressLimits();
  return opened;
}

/// For a new body, before other data depend on it.
void World::openJoints(std::span<const EdgeId> joints) {
  if (joints.empty()) return;
  fracture.open(model, surfaces, joints, split_);
  (void)relink(surfaces, split_.sides);
}

/// Updates all that is derived from nodes, triangles and the boundary.
void World::followSplit() {
  const std::vector<Vec2>& reference = model.nodes.reference;
  const std::size_t count = model.nodes.size();
  contact.resize(count);
  dynamics_.follow(model, split_.changed, split_.originals);
  (void)relink(surfaces, split_.sides);
  const auto appear = [&](NodeId node) { search.appear(node, model.nodes.position[node.value]); };
  for (const NodeId node : split_.onSurface) appear(node);
  for (std::size_t n = count - split_.originals.size(); n < count; ++n) appear(NodeId(n));
  for (const SurfaceSide& side : split_.sides)
    if (side.segment == SegmentId::none())
      finest_ = std::min(finest_, norm(reference[side.last.value] - reference[side.first.value]));
  search.addCandidatesAround(searchScene(), split_.sides);
  assert(haveLength(model.nodes.columns(), count) && surfaces.nodeSegment.size() == count);
}

}  // namespace yadefrag
