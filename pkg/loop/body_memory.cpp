#include <cstddef>
#include <vector>

#include "collider/search_collider.hpp"
#include "loop/block_memory.hpp"

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

void copyBody(yade::Body& from, yade::Body& to) {
  to.id = from.id, to.groupMask = from.groupMask, to.flags = from.flags;
#ifdef YADE_MPI
  to.subdomain = from.subdomain;
#endif
  to.material = from.material;
  to.state = from.state, to.shape = from.shape, to.bound = from.bound;
  to.intrs.swap(from.intrs);
  to.clumpId = from.clumpId;
  to.iterBorn = from.iterBorn, to.timeBorn = from.timeBorn;
}

// What is moved of a body, one behind the other. What the integrator reads of it begins cache
// lines:
//
//   body:   | head, id, mask | flags to bound | intrs, clumpId ... |
//                            ^ a line
//   state:  | head, se3 to densityScaling |
//           ^ a line
//   bound:  | head | refPos, sweepLength | color ... |
//                  ^ a line

/// Bytes to skip, from a place within a line, so that a member begins a line.
constexpr std::size_t gapBefore(std::size_t place, std::size_t member) {
  return Block::wholeLines(place + member) - (place + member);
}
constexpr std::size_t kBodyAt = gapBefore(0, offsetof(yade::Body, flags));
constexpr std::size_t kStateAt = Block::wholeLines(kBodyAt + sizeof(yade::Body));
constexpr std::size_t kStateEnd = kStateAt + sizeof(yade::State);
constexpr std::size_t kBoundAt = kStateEnd + gapBefore(kStateEnd, offsetof(yade::Bound, refPos));
// Bytes from one body to the next: an odd number of lines, so that the same members of several
// bodies are spread over all parts of the caches.
constexpr std::size_t kBodyBytes = Block::wholeLines(kBoundAt + sizeof(yade::Aabb)) | Block::kLine;

// A YADE that its user built may have more members, by its options: nothing is moved there.
constexpr bool kAreAllMembersKnown =
    sizeof(yade::State) == 320 && sizeof(yade::Aabb) == 144 && sizeof(yade::Body) == 176;

void moveTogether(yade::Scene& scene) {
  const OthersWait others(scene);
  // They find out by the address whether a body was replaced.
  std::vector<SearchCollider*> colliders;
  for (const auto& engine : scene.engines) {
    if (auto* const collider = dynamic_cast<SearchCollider*>(engine.get()))
      colliders.push_back(collider);
  }
  BlockFiller filler;
  for (auto& body : scene.bodies->body) {
    if (!body || !isMovable<yade::State>(body->state)) continue;
    filler.begin(kBodyBytes);
    filler.goTo(kStateAt);
    moveInto<yade::State>(filler, body->state, copyState);
    if (isMovable<yade::Aabb>(body->bound)) {
      filler.goTo(kBoundAt);
      moveInto<yade::Aabb>(filler, body->bound, copyBound);
    }
    if (!isMovable<yade::Body>(body)) continue;
    const yade::Body* const before = body.get();
    filler.goTo(kBodyAt);
    moveInto<yade::Body>(filler, body, copyBody);
    for (SearchCollider* const collider : colliders)
      collider->bodyMoved(body->id, before, body.get());
  }
}

}  // namespace

void BodyMemory::endStep(yade::Scene& scene) {
  if (!kAreAllMembersKnown) return;
  const auto visitAll = [&](const auto& visit) {
    for (const auto& body : scene.bodies->body)
      if (body) visit(body->state.get());
  };
  if (states_.endStep(kBodyBytes, visitAll)) {
    moveTogether(scene);
    returnFreed();
  }
}

}  // namespace yadefrag
