// Second part of body_boxes: boxes of changed bodies only.

#include <algorithm>

#include "collider/body_boxes.hpp"
#include "core/parallel.hpp"
#include "core/request.hpp"

namespace yadefrag {

using yade::Body;
using yade::Bound;
using yade::Vector3r;

bool BodyBoxes::prepareChanged(yade::Scene& scene, yade::BoundDispatcher& dispatcher,
                               const SweepRule& rule, std::size_t most, bool quick, int threads) {
  if (segmentCount_ > 0 || hasFollowers_ || scene.bodies->body.size() < kinds_.size()) return false;
  onlyChanged_ = true;
  takeRule(scene, dispatcher, rule, 0);
  if (!gatherChanged(scene, most, quick, threads)) return false;
  for (const auto* ids : {&changed_, &others_})
    for (const BoxId id : *ids) {
      const Body* body = scene.bodies->body[id.value].get();
      if (!isGoodBody(body, id.value)) throwBadBody(*body, id.value);
    }
  return updateChangedOthers(scene, dispatcher);
}

/// The pointers to bodies are in the order of their ids; each body's state and shape are elsewhere
/// in memory.
void BodyBoxes::prefetch(const std::vector<yade::shared_ptr<Body>>& bodies, std::size_t id) {
  constexpr std::size_t farAhead = 16, ahead = 8;
  if (id + farAhead < bodies.size() && bodies[id + farAhead]) {
    const char* body = reinterpret_cast<const char*>(bodies[id + farAhead].get());
    requestLine(body + offsetof(Body, groupMask));
    requestLine(body + offsetof(Body, shape));
    requestLine(body + offsetof(Body, clumpId));
  }
  if (id + ahead < bodies.size() && bodies[id + ahead]) {
    const char* state = reinterpret_cast<const char*>(bodies[id + ahead]->state.get());
    const char* shape = reinterpret_cast<const char*>(bodies[id + ahead]->shape.get());
    requestLine(state + offsetof(yade::State, se3));
    requestLine(state + offsetof(yade::State, vel));
    requestLine(shape);  // its type
    requestLine(shape + offsetof(yade::Shape, boundFunctor));
    requestLine(shape + offsetof(yade::Sphere, radius));
  }
}

bool BodyBoxes::gatherChanged(yade::Scene& scene, std::size_t most, bool quick, int threads) {
  const auto& bodies = scene.bodies->body;
  boxes_.resize(bodies.size(), Box::absent());
  balls_.resize(bodies.size(), {Vector3r::Zero(), -1, 0});
  kinds_.resize(bodies.size(), Kind::kNone);
  known_.resize(bodies.size());
  headings_.resize(bodies.size());
  changedByPart_.resize(static_cast<std::size_t>(threads));
  othersByPart_.resize(static_cast<std::size_t>(threads));
  const auto work = [&](std::size_t begin, std::size_t end, int part) {
    auto& changed = changedByPart_[static_cast<std::size_t>(part)];
    auto& others = othersByPart_[static_cast<std::size_t>(part)];
    changed.clear(), others.clear();
    for (std::size_t id = begin; id < end && changed.size() <= most; ++id) {
      if (quick && bodies[id].get() == known_[id].body) continue;
      prefetch(bodies, id);
      const Checked result = check(bodies[id].get(), id);
      if (result == Checked::kChanged) changed.push_back(BoxId(id));
      if (result == Checked::kOther) others.push_back(BoxId(id));
    }
  };
  const int parts = forEachPart(bodies.size(), threads, work);
  changed_.clear(), others_.clear();
  for (std::size_t part = 0; part < static_cast<std::size_t>(parts); ++part) {
    const auto &changed = changedByPart_[part], &others = othersByPart_[part];
    changed_.insert(changed_.end(), changed.begin(), changed.end());
    others_.insert(others_.end(), others.begin(), others.end());
  }
  return changed_.size() <= most;
}

/// Checks one body. If it has changed, its box is computed here, except if its functor must do
/// that.
BodyBoxes::Checked BodyBoxes::check(const Body* body, std::size_t id) {
  Known& known = known_[id];
  if (!body && !known.body) return Checked::kSame;
  const bool same =
      body && body == known.body && body->groupMask == known.mask && body->clumpId == known.clump;
  if (same && kinds_[id] == Kind::kSphere && body->bound && keepsBall(*body, balls_[id]))
    return Checked::kSame;
  const Kind before = kinds_[id];
  if (same && before == Kind::kOther && !boundRadius(*body)) return Checked::kOther;
  kinds_[id] = take(body, id);
  if (kinds_[id] == Kind::kOther) return Checked::kOther;
  return same && before == Kind::kNone && kinds_[id] == Kind::kNone ? Checked::kSame
                                                                    : Checked::kChanged;
}

bool BodyBoxes::keepsBall(const Body& body, const Ball& ball) const {
  const yade::State& state = *body.state;
  return boundRadius(body) == ball.radius &&
         rule_.lasts(ball.sweep, state.se3.position - ball.centre, state.vel);
}

/// Computes the box without sweep of all bodies that are no spheres: only this shows whether a
/// shape has changed. Returns false if a new body has a box that follows another body.
bool BodyBoxes::updateChangedOthers(yade::Scene& scene, yade::BoundDispatcher& dispatcher) {
  startDispatcher(scene, dispatcher);
  undo_.clear();
  const std::vector<Turning> before = std::move(turning_);
  turning_.clear();
  auto was = before.begin();
  const auto spheres = static_cast<std::ptrdiff_t>(changed_.size());
  for (const BoxId id : others_) {
    const auto& body = scene.bodies->body[id.value];
    for (; was != before.end() && was->id < body->id; ++was) keepTurning(scene, *was);
    const Turning* turned = was != before.end() && was->id == body->id ? &*was++ : nullptr;
    undo_.emplace_back(*body);
    if (body->shape && body->isBounded()) {
      const ShapeKind kind = shapeKinds_.of(*body->shape);
      if (kind == ShapeKind::kSegment || kind == ShapeKind::kFollower) return false;
      dispatcher.processBody(body);
    }
    if (body->bound && keepsBox(*body, turned)) {
      undo_.back().restore();
      undo_.pop_back();
      if (turned) turning_.push_back(*turned);
      continue;
    }
    boxes_[id.value] = Box::absent();
    balls_[id.value].radius = -1;
    if (body->bound) takeOther(body, scene);
    changed_.push_back(id);
  }
  for (; was != before.end(); ++was) keepTurning(scene, *was);
  std::inplace_merge(changed_.begin(), changed_.begin() + spheres, changed_.end());
  return true;
}

/// Keeps the entry of a body that was not checked, unless the body was removed.
void BodyBoxes::keepTurning(const yade::Scene& scene, const Turning& turning) {
  const auto id = static_cast<std::size_t>(turning.id);
  if (scene.bodies->body[id] && kinds_[id] == Kind::kOther) turning_.push_back(turning);
}

/// True if the box of the body's functor, in `body.bound` at present, lies within the body's stored
/// box, and will for a while.
bool BodyBoxes::keepsBox(const Body& body, const Turning* was) {
  const OldBound& old = undo_.back();
  const Box& kept = boxes_[static_cast<std::size_t>(body.id)];
  if (!old.existed || kept.isAbsent()) return false;
  const Bound& bare = *body.bound;
  for (int axis = 0; axis < 3; ++axis)
    if (!(bare.min[axis] >= kept.min[axis]) || !(bare.max[axis] <= kept.max[axis])) return false;
  const yade::State& state = *body.state;
  double moved = (state.se3.position - old.refPos).cwiseAbs().maxCoeff();
  double speed = SweepRule::speedOf(state.vel);
  if (was) {
    moved += was->turnedBy(state.se3.orientation);
    if (const double turn = state.angVel.norm(); turn > 0) speed += turn * was->reach;
  }
  return rule_.lasts(old.sweepLength, moved, speed);
}

}  // namespace yadefrag
