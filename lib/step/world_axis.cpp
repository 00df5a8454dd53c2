// World: bodies around an axis (Model::axisymmetric), which no node may cross.

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "core/errors.hpp"
#include "core/tolerances/mesh.hpp"
#include "step/world.hpp"

namespace yadefrag {

void World::setAxisymmetric(bool on) {
  if (on == model.axisymmetric) return;
  if (!model.nodes.position.empty())
    throw InputError("axisymmetric can change only as long as FESolver has no bodies.");
  model.axisymmetric = on;
}

/// The mesh with the nodes that are on the axis except for rounding exactly there. InputError for a
/// mesh, a displacement or a material that an axis forbids.
TriangleMesh World::besideAxis(TriangleMesh mesh, const BodySpec& spec) const {
  double farthest = 0;
  for (const Vec2 node : mesh.nodes) farthest = std::max({farthest, node.x, std::abs(node.y)});
  const auto refuse = [](const char* what, double value) {
    throw InputError(
        fmt::format("{} x = {:g} m, but in an axisymmetric scene x is the distance from the axis: "
                    "it must not be "
                    "negative, and nodes on the axis stay there.",
                    what, value));
  };
  for (std::size_t i = 0; i < mesh.nodes.size(); ++i) {
    double& x = mesh.nodes[i].x;
    if (std::abs(x) <= tolerance::kLeastSize * farthest) x = 0;
    if (x < 0) refuse("A node of the mesh is at", x);
    if (spec.displacement.empty()) continue;
    const double now = x + spec.displacement[i].x;
    if (x == 0 ? now != 0 : now <= 0) refuse("displacement moves a node to", now);
  }
  const auto isPlane = [](const BodyMaterial& one) { return one.material.planeStress; };
  if (isPlane(spec) || std::ranges::any_of(spec.materials.materials, isPlane))
    throw InputError("planeStress is set, but an axisymmetric body has stresses around its axis.");
  return mesh;
}

void World::holdOnAxis(NodeId first) {
  if (!model.axisymmetric) return;
  for (std::size_t n = first.value; n < model.nodes.size(); ++n)
    if (model.isOnAxis(NodeId(n))) model.nodes.held[n] |= kHeldX, model.nodes.velocity[n].x = 0;
}

/// No force keeps a ring from shrinking through the axis.
void World::requireOutsideAxis() const {
  for (std::size_t n = 0; n < model.nodes.size(); ++n) {
    const Vec2 at = model.nodes.position[n];
    if (at.x > 0 || model.isOnAxis(NodeId(n)) || model.nodes.mass[n] == 0) continue;
    if (model.components[model.nodes.component[n].value].rigid) continue;
    throw RunError(fmt::format(
        "a node at ({:g}, {:g}) m reaches the axis; add the material on the axis as a body, or end "
        "the run before.",
        at.x, at.y));
  }
}

}  // namespace yadefrag
