// The world's part in rigid boundaries: outlines of bodies that are not made of elements.

#include <algorithm>

#include "core/tolerances/dynamics.hpp"
#include "mesh/assembly.hpp"
#include "step/world.hpp"

namespace yadefrag {

/// The motion of all their nodes.
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
  reference.insert(reference.end(), outline.nodes.begin(), outline.nodes.end());
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
  search.forget();
  rebuild();
  return id;
}

void World::removeRigid(ComponentId component) {
  const ElementId none(model.components[component.value].firstTriangle);
  const std::vector<NodeId> renumbered = yadefrag::removeBody(model, component);
  fracture.removeBody(model, none, none, renumbered);
  takeOff(component, renumbered);
  // Boundaries that are made anew again and again leave no numbers behind.
  if (component.value + 1 == model.components.size()) model.components.pop_back();
}

void World::slideRigid(std::span<const Vec2> places) {
  for (std::size_t i = 0; i < places.size(); ++i)
    model.nodes.position[rigidNodes_[i].value] = reference[rigidNodes_[i].value] = places[i];
  places_.forget();
  search.isVoid = true;
}

Vec2 World::rigidVelocity(NodeId node) const {
  if (rigidVelocities.empty()) return {};
  const auto at = std::ranges::lower_bound(rigidNodes_, node);
  return rigidVelocities[static_cast<std::size_t>(at - rigidNodes_.begin())];
}

}  // namespace yadefrag
