#include "fe/entry_bodies.hpp"

#include <sstream>

#include "core/errors.hpp"
#include "core/parallel.hpp"
#include "surface/piece_geometry.hpp"

namespace yadefrag {
namespace {

using yade::Vector3r;

Vector3r inSpace(Vec2 v) { return {v.x, v.y, 0}; }
Vec2 inPlane(const Vector3r& v) { return {v[0], v[1]}; }

/// The middle of a piece, and the two nodes whose distance tells how it turns.
struct Frame {
  Stencil middle;
  NodeId first, last;

  Frame(const ContactSurfaces& surfaces, EntryId entry) {
    NodeId nodes[3];
    const int count = surfaces.pieceNodes(entry, nodes);
    first = nodes[0], last = nodes[count - 1];
    const PieceRange range = pieceRange(surfaces.piece[entry.value]);
    middle = surfaces.master(entry, .5 * (range.begin + range.end));
  }
};

void setShape(SurfaceSegment& shape, const ContactSurfaces& surfaces, const PieceGeometry& geometry,
              std::span<const Vec2> positions, EntryId entry) {
  shape.start = inSpace(geometry.slave(entry));
  shape.end = inSpace(geometry.slave(surfaces.next[entry.value]));
  if (surfaces.piece[entry.value] != Piece::kArc) return;
  NodeId nodes[3];
  surfaces.pieceNodes(entry, nodes);
  shape.middle = inSpace(positions[nodes[1].value]);
}

void setState(yade::State& state, const Frame& frame, const Nodes& nodes, double dt) {
  const Vec2 velocity = combine(frame.middle, nodes.velocity);
  const Vec2 along = nodes.position[frame.last.value] - nodes.position[frame.first.value];
  const Vec2 apart = nodes.velocity[frame.last.value] - nodes.velocity[frame.first.value];
  state.vel = inSpace(velocity);
  state.angVel = Vector3r(0, 0, cross(along, apart) / dot(along, along));
  state.se3.position = inSpace(combine(frame.middle, nodes.position)) - dt * state.vel;
}

/// Moment about `about` of the forces on a body. YADE's laws may take both bodies of a contact for
/// spheres, and then put a force that acts at the contact point on the body's own position: where
/// there are contacts, their points are taken.
double momentAbout(Vec2 about, const yade::Body& body, Vec2 force, double torque) {
  Vec2 explained, points;
  double moment = 0;
  int count = 0;
  for (const auto& [other, contact] : body.intrs) {
    if (!contact->isReal()) continue;
    const auto* geom = dynamic_cast<const yade::ScGeom*>(contact->geom.get());
    const auto* phys = dynamic_cast<const yade::NormShearPhys*>(contact->phys.get());
    if (!geom || !phys) continue;
    const double sign = contact->getId2() == body.getId() ? 1 : -1;
    const Vec2 part = sign * inPlane(phys->normalForce + phys->shearForce);
    const Vec2 point = inPlane(geom->contactPoint);
    explained += part;
    points += point;
    moment += cross(point - about, part);
    ++count;
  }
  if (count == 0) return torque + cross(inPlane(body.state->se3.position) - about, force);
  return moment + cross((1. / count) * points - about, force - explained);
}

SurfaceSegment& shapeOf(yade::Body& body) { return static_cast<SurfaceSegment&>(*body.shape); }

}  // namespace

void EntryBodies::add(yade::Scene& scene, const World& world,
                      const yade::shared_ptr<yade::Material>& material) {
  for (std::size_t e = bodies_.size(); e < world.surfaces.entries(); ++e) {
    const yade::shared_ptr<SurfaceSegment> shape(new SurfaceSegment);
    shape->kind = static_cast<int>(world.surfaces.piece[e]);
    shape->entry = static_cast<int>(e);
    const ComponentId component = world.surfaces.component[e];
    shape->component = static_cast<int>(component.value);
    shape->selfContact = world.model.components[component.value].selfContact;
    const yade::shared_ptr<yade::Body> body(new yade::Body);
    body->shape = shape;
    body->material = material;
    body->state = material->newAssocState();
    body->state->blockedDOFs = yade::State::DOF_ALL;
    ids_.push_back(scene.bodies->insert(body));
    bodies_.push_back(body);
  }
  mapEntries();
  update(world, 0, 1);
}

void EntryBodies::remove(yade::Scene& scene, const World& world, ComponentId component) {
  std::size_t kept = 0;
  for (std::size_t e = 0; e < ids_.size(); ++e) {
    if (world.surfaces.component[e] == component) {
      scene.bodies->erase(ids_[e], false);
      continue;
    }
    shapeOf(*bodies_[e]).entry = static_cast<int>(kept);
    ids_[kept] = ids_[e];
    bodies_[kept++] = bodies_[e];
  }
  ids_.resize(kept);
  bodies_.resize(kept);
  mapEntries();
  scene.doSort = true;
}

void EntryBodies::requireAll(const yade::Scene& scene) {
  const auto& present = scene.bodies->body;
  const bool find = bodies_.empty();
  bodies_.resize(ids_.size());
  for (std::size_t e = 0; e < ids_.size(); ++e) {
    const auto id = static_cast<std::size_t>(ids_[e]);
    if (find && id < present.size() && present[id] &&
        dynamic_cast<SurfaceSegment*>(present[id]->shape.get()))
      bodies_[e] = present[id];
    if (bodies_[e] && id < present.size() && present[id] == bodies_[e]) continue;
    if (find) bodies_.clear();
    std::ostringstream text;
    text << "Body #" << ids_[e] << " is not in the scene any more, but it is part of the boundary "
         << "of a body of FESolver: take away whole ones, by FESolver.removeBody.";
    throw RunError(text.str());
  }
}

void EntryBodies::update(const World& world, double dt, int threads) {
  const PieceGeometry geometry(world.surfaces, world.model.nodes.position);
  const auto inParts = [&](const auto& work) {
    forEachPart(ids_.size(), threads, [&](std::size_t begin, std::size_t end, int) {
      for (std::size_t e = begin; e < end; ++e) work(EntryId(e));
    });
  };
  inParts([&](EntryId e) {
    yade::Body& body = *bodies_[e.value];
    setShape(shapeOf(body), world.surfaces, geometry, world.model.nodes.position, e);
    setState(*body.state, Frame(world.surfaces, e), world.model.nodes, dt);
  });
  // A neighbour's tangent must be the very number that the neighbour computes itself.
  inParts([&](EntryId e) {
    SurfaceSegment& shape = shapeOf(*bodies_[e.value]);
    const auto at = [&](EntryId other) { return shapeOf(*bodies_[other.value]).piece(); };
    shape.before = inSpace(at(world.surfaces.prev[e.value]).tangentAtEnd());
    shape.after = inSpace(at(world.surfaces.next[e.value]).tangentAtStart());
  });
}

void EntryBodies::setHalo(double halfHalo) {
  for (const auto& body : bodies_) shapeOf(*body).halo = halfHalo;
}

void EntryBodies::collectForces(yade::Scene& scene, const World& world,
                                std::vector<Vec2>& forces) const {
  const Nodes& nodes = world.model.nodes;
  forces.clear();
  scene.forces.sync();
  for (std::size_t e = 0; e < ids_.size(); ++e) {
    const Vec2 force = inPlane(scene.forces.getForce(ids_[e]));
    const double torque = scene.forces.getTorque(ids_[e])[2];
    if (force == Vec2{} && torque == 0) continue;
    if (forces.empty()) forces.resize(nodes.size());
    const Frame frame(world.surfaces, EntryId(e));
    for (int k = 0; k < frame.middle.count; ++k)
      forces[frame.middle.node[k].value] += frame.middle.weight[k] * force;
    const Vec2 middle = combine(frame.middle, nodes.position);
    const double moment = momentAbout(middle, *bodies_[e], force, torque);
    const Vec2 along = nodes.position[frame.last.value] - nodes.position[frame.first.value];
    const Vec2 pair = (-moment / dot(along, along)) * rightOf(along);
    forces[frame.last.value] += pair;
    forces[frame.first.value] -= pair;
  }
}

void EntryBodies::restore(std::vector<yade::Body::id_t> ids) {
  ids_ = std::move(ids);
  bodies_.clear();
  mapEntries();
}

void EntryBodies::mapEntries() {
  entries_.clear();
  for (std::size_t e = 0; e < ids_.size(); ++e) {
    const auto id = static_cast<std::size_t>(ids_[e]);
    if (id >= entries_.size()) entries_.resize(id + 1, EntryId::none());
    entries_[id] = EntryId(e);
  }
}

}  // namespace yadefrag
