#include "collider/body_boxes.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <optional>
#include <string>
#include <typeinfo>

#include "core/errors.hpp"
#include "core/parallel.hpp"
#include "core/request.hpp"

namespace yadefrag {
namespace {

using yade::Bound;
using yade::Real;
using yade::Vector3r;

Box toBox(const Vector3r& low, const Vector3r& high) {
  return {{low[0], low[1], low[2]}, {high[0], high[1], high[2]}};
}

/// The functor for bounds of spheres, if it is exactly YADE's. If several functors are registered
/// for a type, a dispatcher calls the last one.
const yade::Bo1_Sphere_Aabb* findSphereFunctor(const yade::BoundDispatcher& dispatcher) {
  const yade::Bo1_Sphere_Aabb* found = nullptr;
  for (const auto& functor : dispatcher.functors) {
    const yade::vector<yade::string> types = functor->getFunctorTypes();
    if (types.empty() || types.front() != "Sphere") continue;
    const yade::BoundFunctor& is = *functor;
    const bool yades = typeid(is) == typeid(yade::Bo1_Sphere_Aabb);
    found = yades ? static_cast<const yade::Bo1_Sphere_Aabb*>(functor.get()) : nullptr;
  }
  return found;
}

/// The box around the bodies of a process that has none.
bool isEmpty(const Bound& bound) {
  return (bound.min.array() == INFINITY).all() && (bound.max.array() == -INFINITY).all();
}

/// Written so that NaN counts as invalid, too.
bool isGood(const Box& box) {
  return box.min[0] <= box.max[0] && box.min[1] <= box.max[1] && box.min[2] <= box.max[2];
}

std::string text(const Vector3r& v) { return fmt::format("({:g}, {:g}, {:g})", v[0], v[1], v[2]); }

}  // namespace

BodyBoxes::OldBound::OldBound(yade::Body& b) : body(&b), existed(bool(b.bound)) {
  if (!existed) return;
  const Bound& bound = *b.bound;
  lastUpdateIter = bound.lastUpdateIter;
  sweepLength = bound.sweepLength;
  refPos = bound.refPos, min = bound.min, max = bound.max;
}

void BodyBoxes::OldBound::restore() const {
  if (!existed) {
    body->bound.reset();
    return;
  }
  Bound& bound = *body->bound;
  bound.lastUpdateIter = lastUpdateIter;
  bound.sweepLength = sweepLength;
  bound.refPos = refPos, bound.min = min, bound.max = max;
}

void BodyBoxes::prepare(yade::Scene& scene, yade::BoundDispatcher& dispatcher,
                        const SweepRule& rule, double cellSlack, int threads) {
  onlyChanged_ = false;
  takeRule(scene, dispatcher, rule, cellSlack);
  gatherSpheres(scene, threads);
  updateOthers(scene, dispatcher);
}

void BodyBoxes::takeRule(yade::Scene& scene, const yade::BoundDispatcher& dispatcher,
                         const SweepRule& rule, double cellSlack) {
  rule_ = rule;
  cell_ = scene.isPeriodic ? scene.cell.get() : nullptr;
  cellSlack_ = cellSlack;
  // A length r in space is r·‖row‖ at most along an unsheared axis; for a cube of half-width s it
  // is s·Σ|row|. (YADE enlarges by cosines instead, which is too small at large shear.)
  radiusFactor_ = sweepFactor_ = Vector3r::Ones();
  if (cell_ && cell_->hasShear()) {
    radiusFactor_ = cell_->getUnshearTrsf().rowwise().norm();
    sweepFactor_ = cell_->getUnshearTrsf().cwiseAbs().rowwise().sum();
  }
  sphereFunctor_ = findSphereFunctor(dispatcher);
}

void BodyBoxes::rollBack() {
  for (const OldBound& old : undo_) old.restore();
  undo_.clear();
}

void BodyBoxes::gatherSpheres(yade::Scene& scene, int threads) {
  const auto& bodies = scene.bodies->body;
  boxes_.resize(bodies.size());
  balls_.resize(bodies.size());
  kinds_.resize(bodies.size());
  known_.resize(bodies.size());
  headings_.resize(bodies.size());
  std::vector<std::size_t> firstBad(static_cast<std::size_t>(threads), bodies.size());
  forEachPart(bodies.size(), threads, [&](std::size_t begin, std::size_t end, int part) {
    std::size_t bad = bodies.size();
    for (std::size_t id = begin; id < end; ++id) {
      prefetch(bodies, id);
      kinds_[id] = take(bodies[id].get(), id);
      if (bad == bodies.size() && !isGoodBody(bodies[id].get(), id)) bad = id;
    }
    firstBad[static_cast<std::size_t>(part)] = bad;
  });
  const std::size_t bad = *std::min_element(firstBad.begin(), firstBad.end());
  if (bad < bodies.size()) throwBadBody(*bodies[bad], bad);
}

/// Radius of the bound of a body that is exactly a sphere and gets its bound from exactly YADE's
/// functor; no value for all others. A shape caches the functor that was found for it before.
std::optional<Real> BodyBoxes::boundRadius(const yade::Body& body) const {
  if (!body.shape || !body.isBounded()) return {};
  const yade::Shape& shape = *body.shape;
  if (!isSphere_(shape)) return {};
  const yade::Bo1_Sphere_Aabb* functor = sphereFunctor_;
  if (const yade::BoundFunctor* cached = shape.boundFunctor.get(); cached && cached != functor) {
    if (!isSphereFunctor_(*cached)) return {};
    functor = static_cast<const yade::Bo1_Sphere_Aabb*>(cached);
  }
  if (!functor) return {};
  const Real enlarge = functor->aabbEnlargeFactor;
  return (enlarge > 0 ? enlarge : 1) * static_cast<const yade::Sphere&>(shape).radius;
}

/// Spheres get their box here, all others later.
auto BodyBoxes::take(const yade::Body* body, std::size_t id) -> Kind {
  const bool isSame = body && known_[id].body == body && balls_[id].radius >= 0;
  headings_[id] = isSame ? headingOf(*body->state, balls_[id], headings_[id]) : 0;
  boxes_[id] = Box::absent();
  balls_[id].radius = -1;
  known_[id] = {};
  if (!body) return Kind::kNone;
  known_[id] = {body, body->groupMask, body->clumpId};
  return takeSphere(*body, id);
}

/// Axis and sign of the velocity with which a sphere crosses its room: it is expected to keep that
/// velocity as long as its sign does not change. A sphere in a room around its position shows it by
/// leaving this room: in a packing at rest spheres oscillate within their rooms.
auto BodyBoxes::headingOf(const yade::State& state, const Ball& was, Heading before) -> Heading {
  int axis = 0;
  const double speed = state.vel.cwiseAbs().maxCoeff(&axis);
  if (!(speed > 0)) return 0;
  const auto now = static_cast<Heading>(state.vel[axis] > 0 ? axis + 1 : -axis - 1);
  if (before != 0) {
    const int axisBefore = before > 0 ? before - 1 : -before - 1;
    return state.vel[axisBefore] * before > 0 ? now : 0;
  }
  const double moved = (state.se3.position[axis] - was.centre[axis]) * (now > 0 ? 1 : -1);
  return moved > tolerance::kStraight * was.sweep ? now : 0;
}

/// Computes the box without calling the functor.
auto BodyBoxes::takeSphere(const yade::Body& body, std::size_t id) -> Kind {
  if (!body.bound && !(body.shape && body.isBounded())) return Kind::kNone;
  const std::optional<Real> radius = boundRadius(body);
  if (!radius) return Kind::kOther;
  const yade::State& state = *body.state;
  Ball& ball = balls_[id];
  const SweptBox room = rule_.sweptBoxOf(*radius, state.vel, headings_[id] != 0);
  ball = {state.se3.position + room.shift, *radius, room.length};
  const Vector3r at = cell_ ? cell_->unshearPt(ball.centre) : ball.centre;
  const Vector3r half = ball.radius * radiusFactor_;
  const Vector3r sweep = (ball.sweep + cellSlack_) * sweepFactor_;
  boxes_[id] = toBox((at - half) - sweep, (at + half) + sweep);
  return Kind::kSphere;
}

/// False if a body with a bound has a position that is not finite, or a sphere an invalid radius.
bool BodyBoxes::isGoodBody(const yade::Body* body, std::size_t id) const {
  if (kinds_[id] == Kind::kSphere) {
    const Ball& ball = balls_[id];
    return ball.centre.allFinite() && ball.radius >= 0;
  }
  return kinds_[id] != Kind::kOther || !body->shape || !body->isBounded() ||
         body->state->se3.position.allFinite();
}

void BodyBoxes::throwBadBody(const yade::Body& body, std::size_t id) const {
  const bool isSphere = kinds_[id] == Kind::kSphere;
  const Vector3r& at = isSphere ? balls_[id].centre : body.state->se3.position;
  if (!at.allFinite())
    throw InputError(fmt::format(
        "Body #{} is at {}, which is not finite: the simulation has become unstable (is O.dt too "
        "large?) or the position was set wrongly.",
        id, text(at)));
  throw InputError(fmt::format(
      "Body #{} has an inverted bound: the radius of its sphere is {:g}; it must not be negative.",
      id, balls_[id].radius));
}

/// The functors compute boxes without sweep: each is then enlarged by an individual sweep.
void BodyBoxes::startDispatcher(yade::Scene& scene, yade::BoundDispatcher& dispatcher) {
  dispatcher.scene = &scene;
  for (const auto& functor : dispatcher.functors) functor->scene = &scene;
  dispatcher.sweepDist = 0;
  dispatcher.targetInterv = -1;
}

void BodyBoxes::updateOthers(yade::Scene& scene, yade::BoundDispatcher& dispatcher) {
  startDispatcher(scene, dispatcher);
  turning_.clear();
  undo_.clear();
  isSegment_.clear();
  segmentCount_ = 0;
  hasOthers_ = hasFollowers_ = isSplit_ = false;
  for (std::size_t id = 0; id < kinds_.size(); ++id) {
    hasOthers_ |= kinds_[id] == Kind::kSphere;
    if (kinds_[id] != Kind::kOther) continue;
    const auto& body = scene.bodies->body[id];
    undo_.emplace_back(*body);
    if (body->shape && body->isBounded()) dispatcher.processBody(body);
    if (body->bound) takeOther(body, scene);
  }
}

void BodyBoxes::takeOther(const yade::shared_ptr<yade::Body>& body, yade::Scene& scene) {
  const auto id = static_cast<std::size_t>(body->id);
  Bound& bound = *body->bound;
  isSplit_ |= body->getIsSubdomain();
  if (body->getIsSubdomain() && isEmpty(bound)) return;
  if (!isGood(toBox(bound.min, bound.max)))
    throw InputError(
        fmt::format("Body #{} has an inverted bound or one that is not a number: from {} to {}; "
                    "its shape or its "
                    "orientation is wrong.",
                    id, text(bound.min), text(bound.max)));
  // A body that no longer requests a bound keeps its present one, as in YADE.
  if (body->shape && body->isBounded()) {
    if (shapeKinds_.of(*body->shape) == ShapeKind::kSegment) {
      takeSegment(*body);
    } else {
      hasOthers_ = true;
      const double sweep = sweepOfOther(*body, undo_.back().existed);
      bound.min -= (sweep + cellSlack_) * sweepFactor_;
      bound.max += (sweep + cellSlack_) * sweepFactor_;
      bound.sweepLength = sweep;
    }
    bound.refPos = body->state->se3.position;
    bound.lastUpdateIter = static_cast<int>(scene.iter);
  }
  boxes_[id] = toBox(bound.min, bound.max);
}

/// The bound already includes the halo and the permitted displacement of the piece.
void BodyBoxes::takeSegment(const yade::Body& body) {
  isSegment_.resize(kinds_.size());
  isSegment_[static_cast<std::size_t>(body.id)] = 1;
  body.bound->sweepLength = static_cast<const SurfaceSegment&>(*body.shape).halo;
  ++segmentCount_;
}

double BodyBoxes::sweepOfOther(const yade::Body& body, bool hadBound) {
  const yade::State& state = *body.state;
  const double speed = SweepRule::speedOf(state.vel);
  const ShapeKind kind = shapeKinds_.of(*body.shape);
  if (kind == ShapeKind::kFollower) {
    hasFollowers_ = true;
    return rule_.most;
  }
  if (kind == ShapeKind::kSphere) {
    const auto radius = boundRadius(body);
    const double sweep = rule_.lengthForBall(radius.value_or(0), speed);
    if (radius) balls_[static_cast<std::size_t>(body.id)] = {state.se3.position, *radius, sweep};
    return sweep;
  }
  const Vector3r at = cell_ ? cell_->unshearPt(state.se3.position) : state.se3.position;
  const Vector3r far =
      (body.bound->max - at).cwiseAbs().cwiseMax((body.bound->min - at).cwiseAbs());
  const double reach = far.norm() * (cell_ ? cell_->getShearTrsf().norm() : 1);
  turning_.push_back({body.id, state.se3.orientation, reach});
  // As in YADE, a first bound is enlarged by the whole of verletDist. Spheres do not need that.
  if (!hadBound) return rule_.most;
  const double turn = state.angVel.norm();
  return rule_.lengthFor(speed + (turn > 0 ? turn * reach : 0));
}

void BodyBoxes::commit(yade::Scene& scene, int threads) {
  undo_.clear();
  const std::size_t count = onlyChanged_ ? changed_.size() : kinds_.size();
  forEachPart(count, threads, [&](std::size_t begin, std::size_t end, int) {
    const auto bodyAt = [&](std::size_t i) { return onlyChanged_ ? changed_[i].value : i; };
    // Bounds are scattered in memory, as the bodies that point to them: prefetch.
    constexpr std::size_t farAhead = 16, ahead = 8;
    for (std::size_t i = begin; i < end; ++i) {
      if (i + farAhead < end) {
        const yade::Body* body = scene.bodies->body[bodyAt(i + farAhead)].get();
        request(body, offsetof(yade::Body, bound), offsetof(yade::Body, intrs));
      }
      if (i + ahead < end) prefetchBound(scene.bodies->body[bodyAt(i + ahead)].get());
      commitOne(scene, bodyAt(i));
    }
  });
}

void BodyBoxes::prefetchBound(const yade::Body* body) {
  if (!body || !body->bound) return;
  request(body->bound.get(), offsetof(Bound, lastUpdateIter),
          offsetof(Bound, max) + sizeof(Vector3r));
}

void BodyBoxes::commitOne(yade::Scene& scene, std::size_t id) {
  if (kinds_[id] != Kind::kSphere) return;
  yade::Body& body = *scene.bodies->body[id];
  if (!body.bound) body.bound.reset(new yade::Aabb);
  Bound& bound = *body.bound;
  const Box& box = boxes_[id];
  bound.min = Vector3r(box.min[0], box.min[1], box.min[2]);
  bound.max = Vector3r(box.max[0], box.max[1], box.max[2]);
  bound.refPos = balls_[id].centre;
  bound.sweepLength = balls_[id].sweep;
  bound.lastUpdateIter = static_cast<int>(scene.iter);
}

}  // namespace yadefrag
