#include "bodies/entry_bodies.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <mutex>

#include "bodies/node_forces.hpp"
#include "core/errors.hpp"
#include "core/parallel.hpp"
#include "core/request.hpp"
#include "loop/sphere_motion.hpp"
#include "yade/helpers.hpp"

namespace yadefrag {
namespace {

using yade::Vector3r;

void setState(yade::State& state, const EntryFrame& frame, const Nodes& nodes,
              const RestOfStep& rest) {
  const Vec2 along = nodes.position[frame.last.value] - nodes.position[frame.first.value];
  const Vec2 apart = nodes.velocity[frame.last.value] - nodes.velocity[frame.first.value];
  state.vel = inSpace(combine(frame.middle, nodes.velocity));
  state.angVel = Vector3r(0, 0, cross(along, apart) / dot(along, along));
  state.se3.position = inSpace(combine(frame.middle, nodes.position)) - rest.dt * state.vel;
  if (!rest.isOurs) return;
  state.se3.position += rest.dt * state.vel;  // the bits of an integrator's sum
  changeOrientation(rest.dt, state);
}

/// By node of the last body, if it has several materials: that of the triangle with the boundary
/// side that begins at the node; otherwise empty.
std::vector<std::uint32_t> materialsAlong(const World& world) {
  const Model& model = world.model;
  const Component& body = model.components.back();
  if (!body.isMixed()) return {};
  std::vector<std::uint32_t> numbers(model.nodes.size());
  const ContactSurfaces& surfaces = world.surfaces;
  const auto endOf = [&](NodeId node) {
    if (node.value >= surfaces.nodeSegment.size()) return NodeId::none();
    const SegmentId segment = surfaces.nodeSegment[node.value];
    if (segment == SegmentId::none()) return NodeId::none();
    return surfaces.segmentNode[surfaces.segmentNext[segment.value].value];
  };
  for (std::uint32_t e = body.firstTriangle; e < body.lastTriangle; ++e)
    for (std::size_t i = 0; i < 3; ++i) {
      const auto& nodes = model.triangles.nodes[e];
      if (endOf(nodes[i]) == nodes[(i + 1) % 3])
        numbers[nodes[i].value] = model.triangles.material[e];
    }
  return numbers;
}

}  // namespace

BoundaryPiece BoundaryPieces::alone(EntryId entry) const {
  BoundaryPiece piece;
  piece.start = geometry_.slave(entry);
  piece.end = geometry_.slave(surfaces_.next[entry.value]);
  piece.isArc = surfaces_.piece[entry.value] == Piece::kArc;
  if (piece.isArc) {
    NodeId around[3];
    surfaces_.pieceNodes(entry, around);
    piece.middle = positions_[around[1].value];
  }
  return piece;
}

BoundaryPiece BoundaryPieces::whole(EntryId entry) const {
  BoundaryPiece piece = alone(entry);
  piece.before = alone(surfaces_.prev[entry.value]).tangentAtEnd();
  piece.after = alone(surfaces_.next[entry.value]).tangentAtStart();
  return piece;
}

void EntryBodies::append(yade::Scene& scene, const World& world, EntryId entry,
                         const yade::shared_ptr<yade::Material>& material) {
  if (world.surfaces.isGone(entry)) return appendNone();
  const ComponentId component = world.surfaces.component[entry.value];
  const yade::shared_ptr<SurfaceSegment> shape(new SurfaceSegment);
  shape->entry = static_cast<int>(entry.value);
  shape->component = static_cast<int>(component.value);
  shape->selfContact = world.model.components[component.value].selfContact;
  const yade::shared_ptr<yade::Body> body(new yade::Body);
  body->shape = shape;
  body->material = material;
  if (material) body->state = material->newAssocState();
  body->state->blockedDOFs = yade::State::DOF_ALL;
  // The 3D view locks this while it reads the list of bodies; YADE's `insert` does not.
  const std::lock_guard drawing(scene.bodies->drawloopmutex);
  ids_.push_back(scene.bodies->insert(body));
  bodies_.push_back({body, shape, body->state});
}

void EntryBodies::appendNone() {
  ids_.push_back(yade::Body::ID_NONE);
  bodies_.emplace_back();
}

void EntryBodies::add(yade::Scene& scene, const World& world,
                      const std::vector<yade::shared_ptr<FEMat>>& materials) {
  const std::size_t first = bodies_.size();
  const std::vector<std::uint32_t> numbers = materialsAlong(world);
  for (std::size_t e = first; e < world.surfaces.entries(); ++e) {
    const NodeId begin = world.surfaces.nodeOf(EntryId(e));
    append(scene, world, EntryId(e), materials[numbers.empty() ? 0 : numbers[begin.value]]);
  }
  mapEntries(first);
  update(world, {}, 1, first);
}

void EntryBodies::addNone(const World& world) {
  while (bodies_.size() < world.surfaces.entries()) appendNone();
  firstOf_.clear();
}

void EntryBodies::follow(yade::Scene& scene, const World& world) {
  const std::size_t first = bodies_.size();
  if (first == world.surfaces.entries()) return;
  for (std::size_t e = first; e < world.surfaces.entries(); ++e) {
    const EntryId alike = firstOf(world, world.surfaces.component[e]);
    append(scene, world, EntryId(e), body(alike).material);
    if (!hasBody(EntryId(e))) continue;
    bodies_[e].body->groupMask = body(alike).groupMask;
    bodies_[e].shape->color = bodies_[alike.value].shape->color;
    bodies_[e].shape->wire = bodies_[alike.value].shape->wire;
  }
  mapEntries(first);
}

/// A script must not change these: the shape of FESolver, and the existence of a state and a
/// material.
void EntryBodies::requireWhole(std::size_t entry) const {
  const yade::Body& body = *bodies_[entry].body;
  const char* const wrong = body.shape != bodies_[entry].shape   ? "shape"
                            : body.state != bodies_[entry].state ? "state"
                            : !body.material                     ? "material"
                                                                 : nullptr;
  if (!wrong) return;
  throw RunError(fmt::format(
      "Body #{} has lost its {}, but it is part of the boundary of a body of FESolver: a "
      "script must not replace it.",
      body.getId(), wrong));
}

void EntryBodies::requireWhole() const {
  for (std::size_t e = 0; e < bodies_.size(); ++e)
    if (hasBody(EntryId(e))) requireWhole(e);
}

bool EntryBodies::haveExcludingMasks() const {
  std::vector<yade::mask_t> masks;
  for (std::size_t e = 0; e < bodies_.size(); ++e) {
    if (!hasBody(EntryId(e))) continue;
    const yade::mask_t mask = bodies_[e].body->groupMask;
    if (std::ranges::find(masks, mask) == masks.end()) masks.push_back(mask);
  }
  return std::ranges::any_of(masks, [&](yade::mask_t a) {
    return std::ranges::any_of(masks, [a](yade::mask_t b) { return (a & b) == 0; });
  });
}

/// The entry that represents its component. It is never an entry of a crack, since those are last.
EntryId EntryBodies::firstOf(const World& world, ComponentId component) {
  if (firstOf_.size() != world.model.components.size()) {
    firstOf_.assign(world.model.components.size(), EntryId::none());
    for (std::size_t e = bodies_.size(); e-- > 0;)
      if (hasBody(EntryId(e))) firstOf_[world.surfaces.component[e].value] = EntryId(e);
  }
  return firstOf_[component.value];
}

void EntryBodies::drop(yade::Scene& scene, const World& world) {
  for (std::size_t e = 0; e < ids_.size(); ++e) {
    if (!world.surfaces.isGone(EntryId(e)) || !hasBody(EntryId(e))) continue;
    entries_[static_cast<std::size_t>(ids_[e])] = EntryId::none();
    idRanges_.clear();
    scene.bodies->erase(ids_[e], false);
    ids_[e] = yade::Body::ID_NONE;
    bodies_[e] = {};
  }
  firstOf_.clear();
}

void EntryBodies::remove(yade::Scene& scene, const World& world, ComponentId component) {
  removeWhere(scene, [&](std::size_t e) { return world.surfaces.component[e] == component; });
}

void EntryBodies::removeRigid(yade::Scene& scene, const World& world) {
  removeWhere(scene, [&](std::size_t e) {
    return world.model.components[world.surfaces.component[e].value].rigid;
  });
}

template <class Goes>
void EntryBodies::removeWhere(yade::Scene& scene, Goes goes) {
  std::size_t kept = 0;
  for (std::size_t e = 0; e < ids_.size(); ++e) {
    if (goes(e)) {
      if (hasBody(EntryId(e))) scene.bodies->erase(ids_[e], false);
      continue;
    }
    if (bodies_[e].shape) bodies_[e].shape->entry = static_cast<int>(kept);
    ids_[kept] = ids_[e];
    bodies_[kept++] = bodies_[e];
  }
  ids_.resize(kept);
  bodies_.resize(kept);
  mapEntries(0);
  scene.doSort = true;
}

const yade::Body* EntryBodies::firstBody() const {
  for (const Entry& entry : bodies_)
    if (entry.body) return entry.body.get();
  return nullptr;
}

void EntryBodies::requireAll(const yade::Scene& scene) {
  if (bodies_.empty()) findBodies(scene);
  const auto& present = scene.bodies->body;
  for (std::size_t e = 0; e < ids_.size(); ++e) {
    if (!hasBody(EntryId(e))) continue;
    if (bodyAt(present, ids_[e]) != bodies_[e].body.get()) throwMissing(scene, EntryId(e));
  }
}

void EntryBodies::throwMissing(const yade::Scene& scene, EntryId missing) const {
  bool isAny = false;
  for (std::size_t e = 0; e < ids_.size(); ++e) {
    const yade::Body* body = bodyAt(scene, ids_[e]);
    // Another scene has other bodies with the same numbers.
    const bool isKnown = body && (bodies_.empty() || body == bodies_[e].body.get());
    isAny = isAny || (isKnown && dynamic_cast<const SurfaceSegment*>(body->shape.get()));
  }
  if (!isAny)
    throw RunError(
        "The bodies of this FESolver are not in the scene any more (O.reset, O.load, O.switchScene "
        "or O.bodies.clear left them behind); this scene needs a new FESolver.");
  throw RunError(
      fmt::format("Body #{} is no longer in the scene, but it is part of the boundary of a body of "
                  "FESolver: remove whole bodies only, with FESolver.removeBody.",
                  ids_[missing.value]));
}

void EntryBodies::findBodies(const yade::Scene& scene) {
  const auto& present = scene.bodies->body;
  std::vector<Entry> found(ids_.size());
  for (std::size_t e = 0; e < ids_.size(); ++e) {
    if (!hasBody(EntryId(e))) continue;
    if (!bodyAt(present, ids_[e])) throwMissing(scene, EntryId(e));
    const auto& body = present[static_cast<std::size_t>(ids_[e])];
    found[e] = {body, boost::dynamic_pointer_cast<SurfaceSegment>(body->shape), body->state};
    if (!found[e].shape) throwMissing(scene, EntryId(e));
  }
  bodies_.swap(found);
}

/// In two passes: the tangent of an adjacent piece must be exactly the number that is computed for
/// that piece.
void EntryBodies::update(const World& world, const RestOfStep& rest, int threads,
                         std::size_t first) {
  const ContactSurfaces& surfaces = world.surfaces;
  const Nodes& nodes = world.model.nodes;
  const BoundaryPieces pieces(surfaces, nodes.position);
  const double margin = world.search.boundMargin();
  pieces_.resize(ids_.size());
  const auto inParts = [&](const auto& work) {
    forEachPart(ids_.size() - first, threads, [&](std::size_t begin, std::size_t end, int) {
      for (std::size_t e = first + begin; e < first + end; ++e)
        if (hasBody(EntryId(e))) work(e);
    });
  };
  inParts([&](std::size_t e) { pieces_[e] = pieces.alone(EntryId(e)); });
  inParts([&](std::size_t e) {
    // Bodies are scattered in memory: prefetch.
    constexpr std::size_t ahead = 6;
    if (e + ahead < bodies_.size()) {
      request(bodies_[e + ahead].shape.get(), 64, sizeof(SurfaceSegment));
      request(bodies_[e + ahead].state.get(), offsetof(yade::State, se3), sizeof(yade::State));
    }
    const BoundaryPiece& piece = pieces_[e];
    SurfaceSegment& shape = *bodies_[e].shape;
    shape.kind = static_cast<int>(surfaces.piece[e]);  // cracks turn arcs into straight pieces
    shape.halo = margin;
    shape.start = inSpace(piece.start);
    shape.end = inSpace(piece.end);
    shape.middle = inSpace(piece.middle);
    shape.before = inSpace(pieces_[surfaces.prev[e].value].tangentAtEnd());
    shape.after = inSpace(pieces_[surfaces.next[e].value].tangentAtStart());
    setState(*bodies_[e].state, EntryFrame(surfaces, EntryId(e)), nodes, rest);
  });
}

bool EntryBodies::meetOthers(const yade::Scene& scene) const {
  return std::ranges::any_of(scene.bodies->body, [&](const yade::shared_ptr<yade::Body>& body) {
    return body && entryOf(body->id) == EntryId::none();
  });
}

void EntryBodies::collectForces(yade::Scene& scene, const World& world,
                                std::vector<Vec2>& forces) const {
  forces.clear();
  scene.forces.sync();
  NodeForces shares(world.surfaces, world.model.nodes, forces);
  for (std::size_t e = 0; e < ids_.size(); ++e) {
    if (!hasBody(EntryId(e))) continue;
    const Vec2 force = inPlane(scene.forces.getForce(ids_[e]));
    const double torque = scene.forces.getTorque(ids_[e])[2];
    if (force == Vec2{} && torque == 0) continue;
    requireWhole(e);
    if (forces.empty()) forces.resize(world.model.nodes.size());
    shares.add(EntryId(e), body(EntryId(e)), force, torque);
  }
}

void EntryBodies::restore(std::vector<yade::Body::id_t> ids) {
  ids_ = std::move(ids);
  bodies_.clear();
  mapEntries(0);
}

const IdRanges& EntryBodies::idRanges() {
  if (idRanges_.empty()) {
    idRanges_ = rangesWhere(entries_.size(),
                            [this](std::size_t id) { return entries_[id] != EntryId::none(); });
  }
  return idRanges_;
}

/// `first`: earlier entries have not changed.
void EntryBodies::mapEntries(std::size_t first) {
  idRanges_.clear();
  if (first == 0) {
    entries_.clear();
    firstOf_.clear();
  }
  for (std::size_t e = first; e < ids_.size(); ++e) {
    if (!hasBody(EntryId(e))) continue;
    const auto id = static_cast<std::size_t>(ids_[e]);
    if (id >= entries_.size()) entries_.resize(id + 1, EntryId::none());
    entries_[id] = EntryId(e);
  }
}

}  // namespace yadefrag
