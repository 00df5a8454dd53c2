#include "bodies/rigid_bodies.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/errors.hpp"
#include "core/tolerances/collider.hpp"
#include "core/tolerances/step.hpp"
#include "step/overlap_check.hpp"
#include "yade/helpers.hpp"

namespace yadefrag {
namespace {

using yade::Vector3r;

/// Extent of all finite-element bodies.
struct Extent {
  Vec2 middle;
  double size = 0;  // m

  explicit Extent(const World& world) {
    Box box = Box::absent();
    for (const NodeId node : world.surfaces.segmentNode)
      if (!world.model.components[world.model.nodes.component[node.value].value].rigid)
        include(box, world.model.nodes.position[node.value]);
    if (box.isAbsent()) return;
    middle = {(box.min[0] + box.max[0]) / 2, (box.min[1] + box.max[1]) / 2};
    size = std::hypot(box.max[0] - box.min[0], box.max[1] - box.min[1]);
  }
};

/// (m) A side displaced by more than this counts as new.
double farthestOf(const World& world) { return tolerance::kMostMotion * world.search.shortest; }

/// (s) Time for which the integrator, or none, moves the bodies.
double movingTime(const yade::Scene& scene, const yade::NewtonIntegrator* newton) {
  return newton ? scene.dt : 0;
}

yade::Body::id_t moverIdOf(const yade::Scene& scene, const yade::Body& body,
                           const yade::NewtonIntegrator* newton) {
  const yade::Body& mover = moverOf(scene, body);
  return obeysForces(newton, mover) ? mover.id : RigidPart::kHeld;
}

}  // namespace

bool RigidBodies::follow(yade::Scene& scene, World& world, EntryBodies& entries, bool wanted,
                         const yade::NewtonIntegrator* newton) {
  const yade::Body* element = entries.firstBody();
  // Without finite-element bodies a wall would have no length.
  if (!wanted || element == nullptr) {
    if (any()) remove(scene, world, entries);
    members_.clear();
    seen_ = 0;
    return false;
  }
  findBodies(scene, newton);
  const bool anyNew = takeNew(scene, element->groupMask);
  bool isBuilt = anyNew || !holds(scene, world, newton);
  if (isBuilt) build(scene, world, entries, newton);
  const bool mayBeShort = any() && world.search.isDue();
  if (mayBeShort && !slideWalls(world)) {
    build(scene, world, entries, newton);
    isBuilt = true;
  }
  return isBuilt;
}

/// Must be called after loading.
void RigidBodies::findBodies(const yade::Scene& scene, const yade::NewtonIntegrator* newton) {
  for (std::uint32_t m = 0; m < members_.size(); ++m) {
    Member& member = members_[m];
    if (member.body || !bodyAt(scene, member.id)) continue;
    member.body = scene.bodies->body[static_cast<std::size_t>(member.id)];
    if (member.body->shape) member.form = formOf(*member.body->shape);
    member.mover = moverIdOf(scene, *member.body, newton);
    member.isOut = std::ranges::find(corners_, m, &RigidCorner::member) == corners_.end();
  }
}

/// True if there is a new body with a section. `mask`: of the finite-element bodies.
bool RigidBodies::takeNew(const yade::Scene& scene, int mask) {
  const auto& bodies = scene.bodies->body;
  bool anyNew = false;
  seen_ = std::min(seen_, bodies.size());
  for (; seen_ < bodies.size(); ++seen_) {
    const auto& body = bodies[seen_];
    if (!body || !body->shape || !mayHaveSection(*body) || (body->groupMask & mask) == 0) continue;
    const auto isKnown = [&](const Member& member) { return member.id == body->id; };
    if (std::ranges::any_of(members_, isKnown)) continue;
    if (isFlat(*body) && !std::exchange(reportedFlat_, true))
      sentences_.push_back(fmt::format(
          "FE bodies go through facets that lie in their plane z = 0, such as #{}: a facet "
          "must cut the plane.",
          body->id));
    members_.push_back({body->id, body, formOf(*body->shape)});
    members_.back().isOut = true;
    anyNew = comesBack(members_.back()) || anyNew;
  }
  return anyNew;
}

/// True if it has entered the plane since it was last checked.
bool RigidBodies::comesBack(Member& member) {
  const auto& place = member.body->state->se3;
  const bool isThere = place.position == member.position &&
                       place.orientation.coeffs() == member.orientation.coeffs();
  if (isThere && !member.isNew) return false;
  member.position = place.position, member.orientation = place.orientation;
  return sectionOf(*member.body).has_value();
}

/// True if all bodies are still in the scene and in the plane, with the same shape, at the
/// positions to which they would have moved, and if connected facets are still connected.
bool RigidBodies::holds(const yade::Scene& scene, const World& world,
                        const yade::NewtonIntegrator* newton) {
  for (Member& member : members_) {
    const yade::Body* body = bodyAt(scene, member.id);
    if (!body || body != member.body.get() || !body->shape) return false;
    if (formOf(*body->shape) != member.form) return false;
    if (member.isOut && comesBack(member)) return false;
    if (!member.isOut && moverIdOf(scene, *body, newton) != member.mover) return false;
  }
  return areInPlace(world, movingTime(scene, newton));
}

/// A part of `holds`.
bool RigidBodies::areInPlace(const World& world, double dt) const {
  const double farthest = farthestOf(world);
  for (std::size_t i = 0; i < corners_.size(); ++i) {
    const RigidCorner& corner = corners_[i];
    const RigidCorner& next = corners_[corner.following];
    const yade::Body& body = *members_[corner.member].body;
    const RigidPose pose(body);
    const Vector3r place = pose.place(corner.place);
    const Vec2 former = world.model.nodes.position[world.rigidNodes()[i].value];
    const double length = (corner.end - corner.place).norm();
    if (!isWall(body) && std::abs(place[2]) > tolerance::kInPlane * length) return false;
    if (!(norm(inPlane(place) - former) <= farthest)) return false;
    if (next.member == corner.member) continue;
    const yade::Body& other = *members_[next.member].body;
    for (const double time : {0., dt}) {
      const Vector3r apart =
          RigidPose(other, time).place(next.place) - RigidPose(body, time).place(corner.end);
      if (apart.norm() > 2 * tolerance::kMeet * length) return false;
    }
  }
  return true;
}

void RigidBodies::remove(yade::Scene& scene, World& world, EntryBodies& entries) {
  entries.removeRigid(scene, world);
  world.replaceRigid({}, {});
  corners_.clear();
}

FormerCorners RigidBodies::formerCorners(const yade::Scene& scene, const World& world) const {
  std::vector<const yade::Body*> bodies;
  for (const Member& member : members_) {
    const yade::Body* body = bodyAt(scene, member.id);
    const bool isSame = body && body == member.body.get() && body->shape && !member.isNew &&
                        formOf(*body->shape) == member.form;
    bodies.push_back(isSame ? body : nullptr);
  }
  std::vector<Vec2> places;
  for (const NodeId node : world.rigidNodes())
    places.push_back(world.model.nodes.position[node.value]);
  return {corners_, bodies, places};
}

/// Parts of the members in the plane, without removed bodies.
std::vector<RigidPart> RigidBodies::parts(const yade::Scene& scene, bool axisymmetric,
                                          std::vector<std::uint32_t>& memberOf,
                                          const yade::NewtonIntegrator* newton) {
  std::vector<RigidPart> all;
  for (Member& member : members_) {
    const yade::Body& body = *member.body;
    member.form = formOf(*body.shape);
    std::optional<Section> section = sectionOf(body);
    member.isOut = !section;
    member.isNew = false;
    member.position = body.state->se3.position, member.orientation = body.state->se3.orientation;
    if (!section) continue;
    if (axisymmetric && !isAroundAxis(*section))
      throw InputError(fmt::format(
          "FESolver is axisymmetric, but {} #{} does not turn into itself around the "
          "axis: only walls with axis = 1, and boxes with x = 0 and sides along x and y "
          "do.",
          body.shape->getClassName(), member.id));
    member.mover = moverIdOf(scene, body, newton);
    if (newton) warnOfMoments(member, moverOf(scene, body), *newton);
    const RigidPose now(body), then(body, movingTime(scene, newton));
    std::vector<Vec2> after;
    for (const Vec2 point : section->points)
      after.push_back(inPlane(then.place(now.local(inSpace(point)))));
    all.push_back({std::move(*section), std::move(after), frictionOf(body),
                   fmt::format("{} #{}", body.shape->getClassName(), member.id), member.mover});
    memberOf.push_back(static_cast<std::uint32_t>(&member - members_.data()));
  }
  return all;
}

void RigidBodies::warnOfMoments(const Member& member, const yade::Body& mover,
                                const yade::NewtonIntegrator& newton) {
  if (lacksInertia(*mover.state)) {
    sentences_.push_back(fmt::format(
        "{} #{} is not fixed but has no mass or no inertia, and NewtonIntegrator divides by "
        "zero; set state.mass and state.inertia, or state.blockedDOFs = 'xyzXYZ'.",
        member.body->shape->getClassName(), member.id));
    return;
  }
  if (reportedMoment_ || member.mover == kHeld) return;
  const auto moment = neglectedMoment(newton, mover);
  if (!moment) return;
  reportedMoment_ = true;
  sentences_.push_back(fmt::format(
      "YADE rotates body #{} about z by the moment of inertia of another axis, {:.6g} instead of "
      "{:.6g} kg m²: if rotations about x or y are blocked, it uses state.inertia[2], the third of "
      "the principal moments; set state.inertia = ({:.6g}, {:.6g}, {:.6g}).",
      mover.id, mover.state->inertia[2], *moment, *moment, *moment, *moment));
}

/// Sides that existed before begin their motion at their previous position.
void RigidBodies::build(yade::Scene& scene, World& world, EntryBodies& entries,
                        const yade::NewtonIntegrator* newton) {
  movers_.forget();
  FormerCorners former = formerCorners(scene, world);
  std::erase_if(members_, [&](const Member& member) {
    const yade::Body* body = bodyAt(scene, member.id);
    return !body || body != member.body.get() || !body->shape;
  });
  std::vector<std::uint32_t> memberOf;
  const std::vector<RigidPart> sections = parts(scene, world.model.axisymmetric, memberOf, newton);
  const Extent extent(world);
  const double farthest = farthestOf(world);
  corners_.clear();
  std::vector<RigidSpec> specs;
  std::vector<std::uint32_t> numbers;
  std::vector<Vec2> starts;
  for (RigidOutline& outline :
       outlinesOf(sections, extent.middle, tolerance::kWallReach * extent.size)) {
    const std::size_t first = corners_.size();
    addCorners(outline, memberOf);
    outline.spec.isNew = false;
    for (std::size_t i = first; i < corners_.size(); ++i) {
      const auto& places = outline.spec.shape.nodes;
      const FormerCorners::Found found =
          former.take(*members_[corners_[i].member].body, places[i - first],
                      places[corners_[i].following - first], farthest);
      numbers.push_back(found.number), starts.push_back(found.place);
      outline.spec.isNew = outline.spec.isNew || found.number == World::kNoCorner;
    }
    specs.push_back(std::move(outline.spec));
  }
  entries.removeRigid(scene, world);
  try {
    world.replaceRigid(specs, numbers);
  } catch (...) {
    corners_.clear();
    members_.clear();
    seen_ = 0;
    throw;
  }
  world.slideRigid(starts);
  startMoving(scene, world);
  entries.addNone(world);
}

/// The work of the first contact depends on the velocity before it, too.
void RigidBodies::startMoving(const yade::Scene& scene, World& world) const {
  for (std::size_t i = 0; i < corners_.size(); ++i) {
    const Member& member = members_[corners_[i].member];
    if (member.mover == kHeld) continue;
    const yade::State& state = *moverOf(scene, *member.body).state;
    const Vector3r arm = RigidPose(*member.body).place(corners_[i].place) - state.se3.position;
    world.model.nodes.velocity[world.rigidNodes()[i].value] =
        inPlane(state.vel + state.angVel.cross(arm));
  }
}

void RigidBodies::addCorners(const RigidOutline& outline,
                             const std::vector<std::uint32_t>& memberOf) {
  const auto first = static_cast<std::uint32_t>(corners_.size());
  const TriangleMesh& shape = outline.spec.shape;
  for (const auto& loop : shape.loops)
    for (std::size_t i = 0; i < loop.size(); ++i) {
      const std::uint32_t node = loop[i], next = loop[(i + 1) % loop.size()];
      const std::uint32_t member = memberOf[outline.part[node]];
      const RigidPose pose(*members_[member].body);
      const Vector3r height(0, 0, isWall(*members_[member].body) ? pose.position[2] : 0);
      corners_.push_back({member, first + next, pose.local(inSpace(shape.nodes[node]) + height),
                          pose.local(inSpace(shape.nodes[next]) + height)});
    }
}

/// Walls are infinite: bodies must not come near the ends of the line that represents one. The line
/// is shifted along itself. Returns false if it is too short because the bodies have spread.
bool RigidBodies::slideWalls(World& world) {
  const auto isOfWall = [&](const RigidCorner& corner) {
    return isWall(*members_[corner.member].body);
  };
  if (std::ranges::none_of(corners_, isOfWall)) return true;
  std::vector<Vec2> places;
  for (const NodeId node : world.rigidNodes())
    places.push_back(world.model.nodes.position[node.value]);
  const Extent extent(world);
  const double margin = tolerance::kWallMargin * extent.size;
  bool anyShort = false;
  for (std::size_t i = 0, end = 0; i < corners_.size(); i = end) {
    while (end < corners_.size() && corners_[end].member == corners_[i].member) ++end;
    if (!isOfWall(corners_[i])) continue;
    const double length = norm(places[i + 1] - places[i]);
    const Vec2 along = (1 / length) * (places[i + 1] - places[i]);
    const double off = dot(extent.middle - .5 * (places[i] + places[i + 1]), along);
    if (length / 2 - std::abs(off) >= margin) continue;
    if (length < 4 * margin) return false;
    anyShort = true;
    const Vec2 by = off * along;
    for (std::size_t k = i; k < end; ++k) {
      places[k] += by;
      corners_[k].place += inSpace(by), corners_[k].end += inSpace(by);
    }
  }
  if (anyShort) world.slideRigid(places);
  return true;
}

bool RigidBodies::anyMovable(const yade::Scene& scene) const {
  return std::ranges::any_of(members_, [&](const Member& member) {
    return member.body && !member.isOut && moverOf(scene, *member.body).isDynamic();
  });
}

std::vector<std::string> RigidBodies::takeSentences() { return std::exchange(sentences_, {}); }

void RigidBodies::archive(AnyArchive& archive, const World& world) {
  constexpr const char* kDamaged = "of FESolver is damaged (its rigid boundaries are invalid)";
  std::vector<int> ids;
  for (const Member& member : members_) ids.push_back(member.id);
  archive.item("rigidBodies", ids);
  if (archive.isLoading()) *this = {};
  archive.rows("rigidCorners", "rigidPlaces", corners_, kDamaged,
               [](RigidCorner& corner, const auto& each) {
                 each(corner.member), each(corner.following);
                 for (Vector3r* v : {&corner.place, &corner.end})
                   for (int i = 0; i < 3; ++i) each((*v)[i]);
               });
  if (!archive.isLoading()) return;
  const bool isValid = corners_.size() == world.rigidNodes().size() &&
                       std::ranges::all_of(corners_, [&](const RigidCorner& corner) {
                         return corner.member < ids.size() && corner.following < corners_.size();
                       });
  if (!isValid)
    throw InputError("The saved state " + std::string(kDamaged) + "; load another save.");
  for (const int id : ids) {
    members_.push_back({id});
    members_.back().isNew = false;
  }
}

}  // namespace yadefrag
