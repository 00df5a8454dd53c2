// World: rigid boundaries, which are outlines of objects without elements.

#include <algorithm>
#include <utility>

#include "core/tolerances/dynamics.hpp"
#include "mesh/assembly.hpp"
#include "step/world.hpp"

namespace yadefrag {

/// The common motion of all their nodes.
std::uint32_t World::rigidMotion() {
  std::vector<Motion>& motions = model.motions;
  const auto known = std::ranges::find(motions, Motion::kRigid, &Motion::function);
  const auto number = static_cast<std::uint32_t>(known - motions.begin()) + 1;
  if (known == motions.end()) {
    motions.emplace_back();
    motions.back().function = Motion::kRigid;
  }
  model.nodes.motion.resize(model.nodes.size()), model.nodes.arm.resize(model.nodes.size());
  return number;
}

ComponentId World::addRigid(const RigidSpec& spec) {
  const ComponentId id = appendRigid(spec);
  rebuild();
  return id;
}

/// Adds a rigid boundary; derived data are not updated.
ComponentId World::appendRigid(const RigidSpec& spec) {
  BodySpec held;
  held.held.assign(spec.shape.nodes.size(), kHeldXY);
  held.rigid = true;
  if (spec.isNew) requireApart(spec.shape, held, spec.name);
  Component component;
  component.material = {1, 0, 1};
  component.friction = spec.friction;
  component.selfContact = false;
  component.rigid = true;
  component.name = spec.name;
  TriangleMesh outline;
  outline.nodes = spec.shape.nodes;
  const std::size_t first = model.nodes.size();
  const ComponentId id = appendBody(model, outline, component);
  const std::uint32_t motion = rigidMotion();
  for (std::size_t n = first; n < model.nodes.size(); ++n) {
    model.nodes.mass[n] = tolerance::kRigidMass;
    model.nodes.held[n] = kHeldXY;
    model.nodes.motion[n] = motion;
  }
  for (const auto& loop : spec.shape.loops) {
    std::vector<NodeId> nodes;
    nodes.reserve(loop.size());
    for (const std::uint32_t node : loop) nodes.emplace_back(first + node);
    surfaces.addLoop(nodes, std::vector<std::uint8_t>(nodes.size()), id);
  }
  search.invalidate();
  return id;
}

/// Returns the new numbers of entries.
std::vector<EntryId> World::removeAllRigid() {
  const ElementId none(model.triangles.size());
  std::vector<std::uint8_t> gone;
  for (const Component& component : model.components) gone.push_back(component.rigid ? 1 : 0);
  const std::vector<NodeId> renumbered = removeNodes(model, gone);
  fracture.removeBody(model, none, none, renumbered);
  std::vector<EntryId> entries = takeOff(gone, renumbered);
  while (!model.components.empty() && model.components.back().rigid) model.components.pop_back();
  return entries;
}

/// By entry: index in `rigidNodes` of the corner at which it begins; kNoCorner for entries of
/// bodies.
std::vector<std::uint32_t> World::rigidEntries() const {
  std::vector<std::uint32_t> corners(surfaces.entries(), kNoCorner);
  for (std::uint32_t i = 0; i < scratch_.rigidNodes.size(); ++i) {
    const SegmentId segment = surfaces.nodeSegment[scratch_.rigidNodes[i].value];
    corners[surfaces.segmentEntry[segment.value].value] = i;
  }
  return corners;
}

void World::replaceRigid(std::span<const RigidSpec> specs, std::span<const std::uint32_t> former) {
  const std::vector<std::uint32_t> corners = rigidEntries();
  std::vector<StoredContact> touches = contact.touches;
  Candidates candidates = contact.candidates;
  std::vector<EntryId> numbers = removeAllRigid();
  try {
    for (const RigidSpec& spec : specs) appendRigid(spec);
  } catch (...) {
    removeAllRigid();
    throw;
  }
  rebuild();
  std::vector<EntryId> entryOf(corners.size(), EntryId::none());  // by former corner
  const std::vector<std::uint32_t> now = rigidEntries();
  for (std::size_t e = 0; e < now.size(); ++e)
    if (now[e] != kNoCorner && former[now[e]] != kNoCorner) entryOf[former[now[e]]] = EntryId(e);
  for (std::size_t e = 0; e < numbers.size(); ++e)
    if (corners[e] != kNoCorner) numbers[e] = entryOf[corners[e]];
  contact.touches = std::move(touches), contact.candidates = std::move(candidates);
  contact.renumber(numbers);
}

void World::slideRigid(std::span<const Vec2> places) {
  Nodes& nodes = model.nodes;
  for (std::size_t i = 0; i < places.size(); ++i)
    nodes.position[scratch_.rigidNodes[i].value] = nodes.reference[scratch_.rigidNodes[i].value] =
        places[i];
  scratch_.places.clear();
  search.makeVoid();
}

}  // namespace yadefrag
