#include "solver/scene_energy.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <tuple>
#include <utility>

#include "bodies/rigid_movers.hpp"
#include "core/errors.hpp"
#include "core/tolerances/spheres.hpp"
#include "core/tolerances/step.hpp"
#include "surface/disc_contact.hpp"
#include "yade/helpers.hpp"

namespace yadefrag {
namespace {

/// The spring of a sphere and a piece. Pieces that share an overlap at a junction have a share of
/// its stiffness each, and so may pieces that a crack has separated.
struct Spring {
  double share = 1;  // of the law's stiffness
  double depth = 0;  // m, compression

  Spring(const yade::ScGeom& geom, SurfaceSegment& piece, const yade::Body& body) {
    const auto* sphere = dynamic_cast<const yade::Sphere*>(body.shape.get());
    depth = geom.penetrationDepth;
    if (!sphere) return;
    const auto touch =
        discContact(piece.piece(), inPlane(body.state->se3.position), sphere->radius);
    if (!touch || !(touch->penetration > 0)) return;
    const auto* changed = piece.changedBy(body.id);
    const double shared = touch->penetration / touch->unshared;
    share = shared * (changed ? changed->share : 1);
    depth /= share;
  }
};

/// (1/kg) Inverse of the mass that a force between the body and a piece moves.
double mobilityOf(const yade::Scene& scene, const World& world, const yade::Body& body,
                  const Stencil& foot) {
  const yade::Body& mover = moverOf(scene, body);
  const double mass = mover.state->mass;
  double mobility = mover.isDynamic() && mass > 0 ? 1 / mass : 0;
  const Nodes& nodes = world.model.nodes;
  for (int k = 0; k < foot.count; ++k) {
    const std::size_t node = foot.node[k].value;
    if (nodes.held[node] == 0) mobility += foot.weight[k] * foot.weight[k] / nodes.mass[node];
  }
  return mobility;
}

/// Bodies are in this order, spheres first.
template <class Touching>
std::pair<bool, yade::Body::id_t> orderOf(const Touching& one) {
  return {one.isRigid, one.id};
}

template <class All>
auto find(All& all, yade::Body::id_t id, bool isRigid) {
  using Touching = std::ranges::range_value_t<All>;
  const auto at = std::ranges::lower_bound(all, std::pair(isRigid, id), {}, orderOf<Touching>);
  return at != all.end() && orderOf(*at) == std::pair(isRigid, id) ? at : all.end();
}

}  // namespace

/// Its motion before the step is known if it had contact in the last one.
SceneEnergy::Touching SceneEnergy::touchingOf(const yade::Body& body, bool isRigid) const {
  Touching one;
  one.id = body.id, one.isRigid = isRigid;
  const yade::State& state = *body.state;
  one.place = inPlane(state.se3.position), one.orientation = state.se3.orientation;
  const auto known = find(former_, body.id, isRigid);
  if (known != former_.end())
    one.velocity = known->velocity, one.spin = known->spin;
  else if (integrator_.exists)
    one.velocity = inPlane(state.vel), one.spin = state.angVel[2];
  return one;
}

void SceneEnergy::addContact(const yade::Scene& scene, const PieceGeometry& geometry,
                             const World& world, EntryId entry, const yade::Interaction& contact,
                             const yade::Body& piece, std::vector<Touching>& found) {
  const auto* geom = dynamic_cast<const yade::ScGeom*>(contact.geom.get());
  const auto* phys = dynamic_cast<const yade::NormShearPhys*>(contact.phys.get());
  const bool isSecond = contact.getId2() == piece.id;
  const yade::Body* body = bodyAt(scene, isSecond ? contact.getId1() : contact.getId2());
  if (!geom || !phys || !body) return;
  if (found.empty() || found.back().id != body->id) found.push_back(touchingOf(*body, false));
  Touching& own = found.back();
  const double sign = isSecond ? 1 : -1;
  const EntryFrame frame(world.surfaces, entry);
  const auto& nodes = world.model.nodes.position;
  const Vec2 point = inPlane(geom->contactPoint);
  const Stencil foot = footOf(world.surfaces, geometry, entry, point);
  const double rate = phys->kn * scene.dt * scene.dt * mobilityOf(scene, world, *body, foot);
  sums_.stiffest = std::max(sums_.stiffest, rate);
  const double normal = phys->normalForce.norm(), shear = phys->shearForce.norm();
  const Vec2 approach = own.velocity - combine(foot, world.model.nodes.velocity);
  noteOverlap(world, *body, own, geom->penetrationDepth, scene.dt * norm(approach));
  const Spring spring(*geom, static_cast<SurfaceSegment&>(*piece.shape), *body);
  pieces_.push_back(
      {found.size() - 1, foot, entry, frame.first, frame.last, normal * spring.depth / 2,
       phys->ks > 0 ? shear * shear / (2 * phys->ks * spring.share) : 0,
       nodes[frame.last.value] - nodes[frame.first.value], point - combine(foot, nodes),
       sign * inPlane(phys->normalForce), sign * inPlane(phys->shearForce)});
  for (const auto& [part, force] :
       {std::pair{&own.normal, pieces_.back().normal}, {&own.tangent, pieces_.back().tangent}}) {
    part->force += force;
    part->moment += cross(point - own.place, force);
  }
  own.normal.elastic += pieces_.back().normalElastic;
  own.tangent.elastic += pieces_.back().tangentElastic;
  const double expected = phys->kn * geom->penetrationDepth;
  own.isSpring = own.isSpring && std::abs(normal - expected) <= tolerance::kSpring * normal;
  const double most = smallerFriction(scene, contact.getId1(), contact.getId2()) * normal;
  own.slips = own.slips || (shear > 0 && shear >= tolerance::kSlips * most);
}

/// `depth`, `approach`: m, of the contact and of the relative motion in a step.
void SceneEnergy::noteOverlap(const World& world, const yade::Body& body, Touching& own,
                              double depth, double approach) {
  const auto* sphere = dynamic_cast<const yade::Sphere*>(body.shape.get());
  if (!sphere) return;
  const double radius = sphere->radius;
  if (find(former_, own.id, false) == former_.end())
    own.isPlaced = own.isPlaced || depth > 2 * approach + tolerance::kPlacedOverlap * radius;
  if (own.isPlaced || depth <= std::max(tolerance::kDeepSphere, 2 * sums_.deepest) * radius) return;
  sums_.deepest = depth / radius;
  const bool isFast = approach > tolerance::kFastSphere * radius;
  deep_ = fmt::format(
      "Step {}, time {:.3g} s: sphere #{} overlaps an FE body by {:.3g} m, {:.3g} of its radius, "
      "and may pass through; {}",
      world.steps, world.time, body.id, depth, depth / radius,
      isFast ? fmt::format("it moves by {:.3g} of its radius in a step: take a shorter step.",
                           approach / radius)
             : "the contact is too soft: take a larger stiffness (young) of the spheres, or, if "
               "that of the body is smaller, kn of Ip2_FrictMat_FrictMat_FrictPhys.");
}

std::vector<SceneEnergy::Touching> SceneEnergy::contactsOf(const yade::Scene& scene,
                                                           const World& world,
                                                           const EntryBodies& entries) {
  std::vector<Touching> found;
  pieces_.clear();
  if (world.loads.outerForces.empty()) return found;
  std::vector<std::tuple<yade::Body::id_t, EntryId, const yade::Interaction*>> contacts;
  for (std::size_t e = 0; e < entries.ids().size(); ++e) {
    if (!entries.hasBody(EntryId(e))) continue;
    for (const auto& [other, contact] : entries.body(EntryId(e)).intrs)
      if (contact->isReal()) contacts.emplace_back(other, EntryId(e), contact.get());
  }
  std::ranges::stable_sort(contacts, {}, [](const auto& one) { return std::get<0>(one); });
  const PieceGeometry geometry(world.surfaces, world.model.nodes.position);
  for (const auto& [other, entry, contact] : contacts)
    addContact(scene, geometry, world, entry, *contact, entries.body(entry), found);
  return found;
}

/// Finds how YADE's bodies have moved since the last step, and the work of its forces on them.
void SceneEnergy::measureMotion(const yade::Scene& scene, const World& world) {
  const double dt = world.lastDt;
  for (Touching& one : touching_) {
    const yade::Body* body = bodyAt(scene, one.id);
    if (!body) one.isRemoved = true;
    if (!body || one.isSettled) continue;
    const Vec2 way = inPlane(body->state->se3.position) - one.place;
    const Vec2 velocity = inPlane(body->state->vel);
    const yade::Quaternionr turn = body->state->se3.orientation * one.orientation.conjugate();
    const double spin = std::remainder(2 * std::atan2(turn.z(), turn.w()), 2 * M_PI) / dt;
    // A script may have brought it to another place.
    const bool isMoved = norm(way - dt * velocity) > tolerance::kMostMotion * world.search.shortest;
    const Vec2 after = isMoved ? velocity : 1 / dt * way;
    const Vec2 mean = isMoved ? one.velocity : .5 * (one.velocity + after);
    for (Part* part : {&one.normal, &one.tangent})
      part->ownWork = -dt * (dot(part->force, mean) + part->moment * (one.spin + spin) / 2);
    one.velocity = after, one.spin = spin;
  }
}

void SceneEnergy::begin(const yade::Scene& scene, const World& world, const EntryBodies& entries,
                        Integrator integrator) {
  integrator_ = integrator;
  if (std::exchange(isOpen_, true)) {
    // Nothing has moved; but the script may have changed the bodies.
    std::vector<Touching> again = contactsOf(scene, world, entries);
    for (Touching& one : again) {
      const auto former = find(touching_, one.id, false);
      if (former == touching_.end()) continue;
      one.normal.held = former->normal.held, one.tangent.held = former->tangent.held;
    }
    touching_ = std::move(again);
    return;
  }
  const bool wasAway = step_ + 1 != scene.iter;
  if (wasAway) {
    // The engine was not in every step: the motion in between is not known.
    sums_.work += std::exchange(sums_.elastic, 0);
    touching_.clear();
  }
  measureMotion(scene, world);
  former_ = std::move(touching_);
  std::ranges::sort(former_, {}, orderOf<Touching>);
  touching_ = contactsOf(scene, world, entries);
  for (Touching& one : touching_) {
    if (!integrator.isFirst) continue;
    const yade::State& state = *bodyAt(scene, one.id)->state;
    const Vec2 velocity = inPlane(state.vel), mean = .5 * (one.velocity + velocity);
    for (Part* part : {&one.normal, &one.tangent}) {
      // The moments are those before the motion.
      part->moment += scene.dt * cross(velocity, part->force);
      part->ownWork =
          -scene.dt * (dot(part->force, mean) + part->moment * (one.spin + state.angVel[2]) / 2);
    }
    one.velocity = velocity, one.spin = state.angVel[2];
    one.isSettled = true;
  }
  addWorks(touching_);
  // Overlaps that were there before the first step, or with a new body, are no energy of contact.
  for (const Touching& one : touching_)
    if (world.steps == 0 || wasAway || one.isPlaced)
      sums_.work -= one.normal.elastic + one.tangent.elastic;
}

/// Adds the works of the last step, and the elastic energies between that step and this one.
void SceneEnergy::addWorks(std::vector<Touching>& now) {
  for (const Touching& one : former_) {
    const double normalWork = one.normal.work + one.normal.ownWork;
    const double tangentWork = one.tangent.work + one.tangent.ownWork;
    if (one.isRigid) {
      sums_.rigid += normalWork;
      continue;
    }
    const auto next = find(now, one.id, false);
    const bool isSpring = one.isSpring && (next == now.end() || next->isSpring);
    // Like the strain energy of elements: with this product the leapfrog of a spring is exact. Of
    // other laws only what the contact has received is known; it must not return more.
    const auto stored = [&](Part Touching::*part, double work) {
      const double former = (one.*part).held;
      if (next == now.end()) return -former;
      double& held = ((*next).*part).held;
      held = isSpring ? std::sqrt((one.*part).elastic * ((*next).*part).elastic)
                      : std::max(0., former - work);
      return held - former;
    };
    const double tangent = stored(&Touching::tangent, tangentWork);
    const double normal = stored(&Touching::normal, normalWork);
    sums_.elastic += normal + tangent;
    // The energy of contacts that were removed has left with the fragments.
    sums_.work += one.isRemoved ? -(normal + tangent) : normalWork + tangentWork;
    if (one.slips && isSpring && !one.isRemoved) sums_.friction -= tangentWork + tangent;
  }
  sums_.least = std::min(sums_.least, bySpheres());
}

void SceneEnergy::end(const yade::Scene& scene, const World& world, const ContactReactions& given) {
  step_ = scene.iter;
  isOpen_ = false;
  const auto before = world.formerVelocities();
  const auto& after = world.model.nodes.velocity;
  const auto mean = [&](NodeId node) { return .5 * (before[node.value] + after[node.value]); };
  for (const Piece& piece : pieces_) {
    Vec2 velocity;
    for (int k = 0; k < piece.foot.count; ++k)
      velocity += piece.foot.weight[k] * mean(piece.foot.node[k]);
    const Vec2 apart = mean(piece.last) - mean(piece.first);
    velocity += cross(piece.along, apart) / dot(piece.along, piece.along) * -rightOf(piece.arm);
    Touching& own = touching_[piece.touching];
    own.normal.work += world.lastDt * dot(piece.normal, velocity);
    own.tangent.work += world.lastDt * dot(piece.tangent, velocity);
    if (world.surfaces.isGone(piece.entry)) leave(piece);
  }
  std::map<yade::Body::id_t, std::size_t> rigid;
  for (const ContactReactions::Given& one : given.all()) {
    const yade::Body* body = bodyAt(scene, one.id);
    if (!body) continue;
    const auto [own, isNew] = rigid.emplace(one.id, touching_.size());
    if (isNew) touching_.push_back(touchingOf(*body, true));
    // Of others the boundary follows a prescribed motion, if need be a step later.
    if (!moverOf(scene, *body).isDynamic()) continue;
    Part& part = touching_[own->second].normal;
    part.force += -inPlane(one.force), part.moment -= one.torque[2];
    part.work -= one.work;
  }
  if (touching_.empty()) return;
  const double supplied = world.watch.expected + world.ledger.external - world.watch.gone;
  sums_.most = std::max(sums_.most, supplied + kineticEnergy(scene));
}

/// The elastic energy leaves with the piece.
void SceneEnergy::leave(const Piece& piece) {
  Touching& own = touching_[piece.touching];
  own.isRemoved = true;
  own.normal.elastic = std::max(0., own.normal.elastic - piece.normalElastic);
  own.tangent.elastic = std::max(0., own.tangent.elastic - piece.tangentElastic);
}

void SceneEnergy::forget(const World& world, ComponentId component) {
  for (const Piece& piece : pieces_)
    if (world.surfaces.component[piece.entry.value] == component) leave(piece);
  pieces_.clear();  // entries get other numbers
}

/// (J) Of the bodies that touch, without those that obey no forces.
double SceneEnergy::kineticEnergy(const yade::Scene& scene) const {
  double twice = 0;
  std::set<const yade::State*> counted;
  for (const Touching& one : touching_) {
    const yade::Body* body = bodyAt(scene, one.id);
    if (!body) continue;
    const yade::Body& mover = moverOf(scene, *body);
    const yade::State& state = *mover.state;
    if (!mover.isDynamic() || !counted.insert(&state).second) continue;
    twice += state.mass * state.vel.squaredNorm() +
             state.inertia.dot(state.angVel.cwiseProduct(state.angVel));
  }
  return twice / 2;
}

/// True if a corner of a straight side in contact has another angle than without stress.
bool SceneEnergy::isBent(const World& world) const {
  const ContactSurfaces& surfaces = world.surfaces;
  const auto turn = [&](SegmentId segment, const std::vector<Vec2>& at) {
    const auto start = [&](SegmentId one) { return at[surfaces.segmentNode[one.value].value]; };
    const SegmentId next = surfaces.segmentNext[segment.value];
    const Vec2 arrive = start(next) - start(segment);
    const Vec2 leave = start(surfaces.segmentNext[next.value]) - start(next);
    return std::atan2(cross(arrive, leave), dot(arrive, leave));
  };
  const Nodes& nodes = world.model.nodes;
  return std::ranges::any_of(pieces_, [&](const Piece& piece) {
    const SegmentId segment = surfaces.entrySegment[piece.entry.value];
    if (surfaces.isSmooth(segment)) return false;
    const auto bends = [&](SegmentId one) {
      return std::abs(turn(one, nodes.position) - turn(one, nodes.reference)) > tolerance::kBent;
    };
    return bends(segment) || bends(surfaces.segmentPrev[segment.value]);
  });
}

std::string SceneEnergy::message(const World& world) {
  const double spheres = bySpheres() - sums_.least, rigid = sums_.rigid;
  const double amount = std::max(spheres, std::abs(rigid));
  const double least = std::max(tolerance::kGivenBySpheres * sums_.most, 2 * sums_.reported);
  if (!(amount > least) || !(amount > world.roundingEnergy())) return {};
  sums_.reported = amount;
  const bool byRigid = std::abs(rigid) >= spheres;
  const char* const advice =
      byRigid ? "NewtonIntegrator must come after FESolver, with damping = 0, or make these bodies "
                "heavier."
      : sums_.stiffest >= tolerance::kStiffContact
          ? "take a shorter step, or a smaller stiffness (young) of the spheres."
      : sums_.deepest > 0 ? "a sphere overlaps a body by more than half its radius: take a larger "
                            "stiffness (young)."
      : isBent(world)     ? "the step is short enough, but the overlap of a sphere with a polygon "
                            "changes where a corner bends: take smooth=True for the bodies that bend."
                          : "the step is short enough, and the cause is not known.";
  return fmt::format(
      "Step {}, time {:.3g} s: contact with YADE's {} has {} {:.3g} J, {:.3g} % of the energy of "
      "the bodies that touch; {}",
      world.steps, world.time, byRigid ? "walls, boxes or facets" : "spheres",
      byRigid && rigid < 0 ? "lost" : "created", amount, 100 * amount / sums_.most, advice);
}

void SceneEnergy::archive(AnyArchive& archive) {
  constexpr double Sums::*kSums[] = {&Sums::work,     &Sums::elastic,  &Sums::friction,
                                     &Sums::least,    &Sums::rigid,    &Sums::most,
                                     &Sums::reported, &Sums::stiffest, &Sums::deepest};
  constexpr const char* kDamaged = "of FESolver is damaged (its energy balance is invalid)";
  if (archive.isLoading()) *this = {};
  std::vector<double> sums;
  for (const auto one : kSums) sums.push_back(sums_.*one);
  archive.item("sceneEnergies", sums);
  archive.rows("sceneContacts", "sceneContactValues", touching_, kDamaged,
               [](Touching& one, const auto& each) {
                 each(one.id), each(one.isRigid), each(one.slips), each(one.isSettled);
                 each(one.isSpring), each(one.isRemoved);
                 for (Vec2* v : {&one.place, &one.velocity}) each(v->x), each(v->y);
                 each(one.spin);
                 for (int i = 0; i < 4; ++i) each(one.orientation.coeffs()[i]);
                 for (Part* part : {&one.normal, &one.tangent}) {
                   each(part->force.x), each(part->force.y), each(part->moment);
                   each(part->elastic), each(part->held), each(part->work), each(part->ownWork);
                 }
               });
  archive.item("sceneStep", step_);
  int open = isOpen_ ? 1 : 0;
  archive.item("sceneIsOpen", open);
  isOpen_ = open != 0;
  if (sums.size() != std::size(kSums))
    throw InputError("The saved state " + std::string(kDamaged) + "; load another save.");
  for (std::size_t i = 0; i < sums.size(); ++i) sums_.*kSums[i] = sums[i];
}

}  // namespace yadefrag
