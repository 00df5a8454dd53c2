#include "integrator/body_memory.hpp"

namespace yadefrag {

namespace {

void copyState(const yade::State& from, yade::State& to) {
  to.se3 = from.se3;
  to.vel = from.vel, to.mass = from.mass;
  to.angVel = from.angVel, to.angMom = from.angMom, to.inertia = from.inertia;
  to.refPos = from.refPos, to.refOri = from.refOri;
  to.blockedDOFs = from.blockedDOFs;
  to.isDamped = from.isDamped;
  to.densityScaling = from.densityScaling;
}

void copyBound(const yade::Aabb& from, yade::Aabb& to) {
  to.lastUpdateIter = from.lastUpdateIter;
  to.refPos = from.refPos, to.sweepLength = from.sweepLength;
  to.color = from.color;
  to.min = from.min, to.max = from.max;
}

// Bytes from the state of one body to that of the next.
constexpr std::size_t kBodyBytes = Block::wholeLines(sizeof(yade::State) + sizeof(yade::Aabb));

// A YADE that its user built may have more members, by its options: nothing is moved there.
constexpr bool kAreAllMembersKnown = sizeof(yade::State) == 320 && sizeof(yade::Aabb) == 144;

void moveTogether(yade::Scene& scene) {
  const OthersWait others(scene);
  BlockFiller filler;
  for (const auto& body : scene.bodies->body) {
    if (!body || !isMovable<yade::State>(body->state)) continue;
    filler.begin(kBodyBytes);
    moveInto<yade::State>(filler, body->state, copyState);
    if (isMovable<yade::Aabb>(body->bound)) {
      moveInto<yade::Aabb>(filler, body->bound, copyBound);
    }
  }
}

}  // namespace

void BodyMemory::endStep(yade::Scene& scene) {
  if (!kAreAllMembersKnown) return;
  const auto visitAll = [&](const auto& visit) {
    for (const auto& body : scene.bodies->body)
      if (body) visit(body->state.get());
  };
  if (states_.endStep(kBodyBytes, visitAll)) moveTogether(scene);
}

}  // namespace yadefrag
