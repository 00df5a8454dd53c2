#include "fe/rigid_bodies.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <utility>

#include "core/tolerances/collider.hpp"
#include "core/tolerances/step.hpp"
#include "step/body_places.hpp"

namespace yadefrag {
namespace {

using yade::Quaternionr;
using yade::Vector3r;

Vec2 inPlane(const Vector3r& v) { return {v[0], v[1]}; }
Vector3r inSpace(Vec2 v) { return {v.x, v.y, 0}; }

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

double frictionOf(const yade::Body& body) {
  const auto* material = dynamic_cast<const yade::FrictMat*>(body.material.get());
  return material ? std::tan(material->frictionAngle) : 0;
}

const yade::Body* bodyAt(const yade::Scene& scene, yade::Body::id_t id) {
  const auto place = static_cast<std::size_t>(id);
  return place < scene.bodies->body.size() ? scene.bodies->body[place].get() : nullptr;
}

/// State of the body that moves it: that of the clump for its members.
const yade::State& mover(const yade::Scene& scene, const yade::Body& body) {
  const yade::Body* clump = body.isClumpMember() ? bodyAt(scene, body.clumpId) : nullptr;
  return clump ? *clump->state : *body.state;
}

}  // namespace

bool RigidBodies::follow(yade::Scene& scene, World& world, EntryBodies& entries, bool wanted,
                         double dt) {
  if (!wanted) {
    if (any()) takeOut(scene, world, entries);
    members_.clear();
    seen_ = 0;
    return false;
  }
  findBodies(scene);
  const yade::Body* element = entries.anyBody();
  const bool anyNew = takeNew(scene, element ? element->groupMask : 0);
  bool isBuilt = anyNew || !holds(scene, world, dt);
  if (isBuilt) build(scene, world, entries, dt);
  const bool mayBeShort = any() && (world.search.isDue || world.search.isVoid);
  if (mayBeShort && !slideWalls(world)) {
    build(scene, world, entries, dt);
    isBuilt = true;
  }
  return isBuilt;
}

/// Must be called after loading.
void RigidBodies::findBodies(const yade::Scene& scene) {
  for (std::uint32_t m = 0; m < members_.size(); ++m) {
    Member& member = members_[m];
    if (member.body || !bodyAt(scene, member.id)) continue;
    member.body = scene.bodies->body[static_cast<std::size_t>(member.id)];
    if (member.body->shape) member.form = formOf(*member.body->shape);
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
bool RigidBodies::holds(const yade::Scene& scene, const World& world, double dt) {
  for (Member& member : members_) {
    const yade::Body* body = bodyAt(scene, member.id);
    if (!body || body != member.body.get() || !body->shape) return false;
    if (formOf(*body->shape) != member.form) return false;
    if (member.isOut && comesBack(member)) return false;
  }
  return areInPlace(world, dt);
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

void RigidBodies::takeOut(yade::Scene& scene, World& world, EntryBodies& entries) {
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
std::vector<RigidPart> RigidBodies::parts(std::vector<std::uint32_t>& memberOf, double dt) {
  std::vector<RigidPart> all;
  for (Member& member : members_) {
    const yade::Body& body = *member.body;
    member.form = formOf(*body.shape);
    std::optional<Section> section = sectionOf(body);
    member.isOut = !section;
    member.isNew = false;
    member.position = body.state->se3.position, member.orientation = body.state->se3.orientation;
    if (!section) continue;
    const RigidPose now(body), then(body, dt);
    std::vector<Vec2> after;
    for (const Vec2 point : section->points)
      after.push_back(inPlane(then.place(now.local(inSpace(point)))));
    all.push_back({std::move(*section), std::move(after), frictionOf(body),
                   fmt::format("{} #{}", body.shape->getClassName(), member.id)});
    memberOf.push_back(static_cast<std::uint32_t>(&member - members_.data()));
  }
  return all;
}

/// Sides that existed before begin their motion at their previous position.
void RigidBodies::build(yade::Scene& scene, World& world, EntryBodies& entries, double dt) {
  FormerCorners former = formerCorners(scene, world);
  std::erase_if(members_, [&](const Member& member) {
    const yade::Body* body = bodyAt(scene, member.id);
    return !body || body != member.body.get() || !body->shape;
  });
  std::vector<std::uint32_t> memberOf;
  const std::vector<RigidPart> sections = parts(memberOf, dt);
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
  entries.addNone(world);
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

void RigidBodies::giveVelocities(World& world, double stepDt, double dt) const {
  world.rigidVelocities.clear();
  for (std::size_t i = 0; i < corners_.size(); ++i) {
    const Vec2 from = world.model.nodes.position[world.rigidNodes()[i].value];
    const RigidPose pose(*members_[corners_[i].member].body, dt);
    world.rigidVelocities.push_back(1 / stepDt * (inPlane(pose.place(corners_[i].place)) - from));
  }
  if (dt == 0) warnOfUnmoved();
}

/// A script that sets a velocity expects the body to move.
void RigidBodies::warnOfUnmoved() const {
  for (const RigidCorner& corner : corners_) {
    const yade::Body& body = *members_[corner.member].body;
    if (body.state->vel.isZero(0) && body.state->angVel.isZero(0)) continue;
    sentences_.push_back(
        fmt::format("{} #{} has a velocity, but no NewtonIntegrator behind FESolver moves it: "
                    "engines(fe, moving=True) has one.",
                    body.shape->getClassName(), body.id));
    return;
  }
}

void RigidBodies::giveForces(yade::Scene& scene, const World& world,
                             const StepLength& length) const {
  const ContactSurfaces& surfaces = world.surfaces;
  const Nodes& nodes = world.model.nodes;
  const auto isRigid = [&](EntryId entry) {
    return world.model.components[surfaces.component[entry.value].value].rigid;
  };
  for (const ContactRow& row : world.contact.rows()) {
    const bool ofSlave = isRigid(row.slave);
    if (!ofSlave && !isRigid(row.master)) continue;
    const EntryId entry = ofSlave ? row.slave : row.master;
    const NodeId corner = surfaces.segmentNode[surfaces.entrySegment[entry.value].value];
    const auto at = std::ranges::lower_bound(world.rigidNodes(), corner);
    const RigidCorner& own = corners_[static_cast<std::size_t>(at - world.rigidNodes().begin())];
    const yade::Body& body = *members_[own.member].body;
    const double sign = ofSlave ? 1 : -1;
    // The forces act at the positions at the begin of the step.
    Vec2 point;
    for (std::size_t k = 0; k < static_cast<std::size_t>(row.count); ++k) {
      const std::uint32_t node = row.node[k].value;
      if (!world.model.components[nodes.component[node].value].rigid) continue;
      const Vec2 before = nodes.position[node] - length.position * nodes.velocity[node];
      point += sign * row.weight[k] * before;
    }
    const Vec2 force = sign * length.velocity / length.position * row.force();
    const Vec2 arm = point - inPlane(body.state->se3.position);
    scene.forces.addForce(body.id, inSpace(force));
    scene.forces.addTorque(body.id, Vector3r(0, 0, cross(arm, force)));
  }
  if (!reportedLight_) warnOfLight(scene, world);
}

/// A boundary keeps its velocity during a step, independently of forces. A body lighter than the
/// nodes that it stops would therefore rebound faster than it came.
void RigidBodies::warnOfLight(const yade::Scene& scene, const World& world) const {
  const Nodes& nodes = world.model.nodes;
  const auto isRigid = [&](NodeId node) {
    return world.model.components[nodes.component[node.value].value].rigid;
  };
  std::vector<double> touched(members_.size());
  std::set<std::pair<std::uint32_t, NodeId>> known;
  for (const ContactRow& row : world.contact.rows()) {
    const auto begin = row.node.begin(), end = begin + row.count;
    const auto rigid = std::find_if(begin, end, isRigid);
    if (rigid == end || row.normalForce == 0) continue;
    const auto at = std::ranges::lower_bound(world.rigidNodes(), *rigid);
    const std::uint32_t member =
        corners_[static_cast<std::size_t>(at - world.rigidNodes().begin())].member;
    for (auto node = begin; node != end; ++node)
      if (!isRigid(*node) && known.emplace(member, *node).second)
        touched[member] += nodes.mass[node->value];
  }
  for (std::size_t m = 0; m < touched.size(); ++m) {
    const yade::Body& body = *members_[m].body;
    const yade::State& state = mover(scene, body);
    if (state.blockedDOFs == yade::State::DOF_ALL || touched[m] <= state.mass) continue;
    sentences_.push_back(fmt::format(
        "{} #{} has a mass of {:.3g} kg, less than the nodes of FE bodies that it touches, {:.3g} "
        "kg: "
        "it bounces back faster than it came; make it heavier, or the elements smaller.",
        body.shape->getClassName(), body.id, state.mass, touched[m]));
    reportedLight_ = true;
    return;
  }
}

bool RigidBodies::anyMovable(const yade::Scene& scene) const {
  return std::ranges::any_of(members_, [&](const Member& member) {
    return member.body && !member.isOut &&
           mover(scene, *member.body).blockedDOFs != yade::State::DOF_ALL;
  });
}

std::vector<std::string> RigidBodies::takeSentences() { return std::exchange(sentences_, {}); }

}  // namespace yadefrag
