// Errors in a step: finds the element or node that causes them, and restores the state before the
// step.

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "core/errors.hpp"
#include "core/tolerances/dynamics.hpp"
#include "elements/element_state.hpp"
#include "time/explicit_dynamics.hpp"

namespace yadefrag {
namespace {

/// "element 5 of component 0 at (0.1, 0.2) m"
std::string nameOf(const Model& model, ElementId element, std::span<const Vec2> position) {
  Vec2 centre;
  for (const NodeId node : model.triangles.nodes[element.value])
    centre += 1. / 3 * position[node.value];
  return fmt::format("element {} of component {} at ({:g}, {:g}) m", element.value,
                     model.triangles.component[element.value].value, centre.x, centre.y);
}

}  // namespace

/// Handles a chunk with an element that is flat, inverted or not finite.
void ExplicitDynamics::handleFlat(const Model& model, const Chunk& chunk, Scratch& scratch) {
  scratch.flat.push_back({chunk.firstElement, chunk.lastElement});
  for (std::uint32_t e = chunk.firstElement; e < chunk.lastElement; ++e)
    if (!(determinant(deformationGradient(model, ElementId(e))) > 0))
#pragma omp atomic write
      badElement_ = true;
}

/// (N) Forces of the chunk's elements that resist collapse.
void ExplicitDynamics::addBarrierForces(const Model& model, const Chunk& chunk, Vec2* force) const {
  for (std::uint32_t e = chunk.firstElement; e < chunk.lastElement; ++e) {
    const Deformation f = deformation(model, ElementId(e));
    const ElasticMaterial& material = model.materialOf(ElementId(e)).material;
    const CollapseBarrier barrier(f.volume(), material.waveModulus());
    if (barrier.slope == 0) continue;
    const Matrix2 c = cofactor(f.plane);
    const auto& inverse = model.triangles.inverseEdges[e];
    const double push = -barrier.slope * volumeOf(model, ElementId(e)), pull = push * f.hoop;
    const Vec2 f1{pull * (c.xx * inverse[0] + c.xy * inverse[1]),
                  pull * (c.yx * inverse[0] + c.yy * inverse[1])};
    const Vec2 f2{pull * (c.xx * inverse[2] + c.xy * inverse[3]),
                  pull * (c.yx * inverse[2] + c.yy * inverse[3])};
    const std::uint32_t i = e - chunk.firstElement;
    const auto& corner = elements_.lanes[chunk.firstLanes + i / kLanes].corner;
    force[corner[0][i % kLanes]] -= f1 + f2;
    force[corner[1][i % kLanes]] += f1;
    force[corner[2][i % kLanes]] += f2;
    if (!model.axisymmetric) continue;
    for (const auto& one : corner)
      force[one[i % kLanes]].x += push * determinant(f.plane) / (3 * model.triangles.radius[e]);
  }
}

ExplicitDynamics::Flattest ExplicitDynamics::requireUpright(const Model& model, double dt,
                                                            double correction) const {
  Flattest found;
  const auto check = [&](std::size_t begin, std::size_t end) {
    for (std::size_t e = begin; e < end; ++e) {
      const double area = deformation(model, ElementId(e)).volume();
      if (!(area > 0))
        throw RunError(fmt::format("{} is inverted in a step of {:g} s; take a shorter one.",
                                   nameOf(model, ElementId(e), previousPosition_), dt));
      if (area < found.area) found = {ElementId(e), area};
    }
  };
  if (anyLargeMove_ || correction > tolerance::kLargeMove * leastHeight_)
    check(0, model.triangles.size());
  else
    for (const Scratch& scratch : scratch_)
      for (const ElementRange& range : scratch.flat) check(range.firstElement, range.lastElement);
  return found;
}

void ExplicitDynamics::refuseFlat(const Model& model, const Flattest& flattest, double dt,
                                  double stable) const {
  throw FlatError(
      fmt::format("{} is pressed to {:.2g} of its area in a step of {:g} s; the flatter an element "
                  "is, the stiffer it gets: take a step of at most {:g} s, or a stiffer material, "
                  "slower bodies or smaller loads.",
                  nameOf(model, flattest.element, previousPosition_), flattest.area, dt, stable),
      stable);
}

/// Exchanges the prescribed velocities of held directions with the nodes' previous velocities.
void ExplicitDynamics::exchangeHeld(Nodes& nodes) {
  if (heldVelocity_.empty()) return;
  for (std::size_t n = 0; n < nodes.size(); ++n)
    for (const auto& [axis, flag] : {std::pair{&Vec2::x, kHeldX}, std::pair{&Vec2::y, kHeldY}})
      if ((nodes.held[n] & flag) != 0) std::swap(nodes.velocity[n].*axis, heldVelocity_[n].*axis);
}

void ExplicitDynamics::undo(Model& model) {
  model.nodes.position.swap(previousPosition_);
  model.nodes.velocity.swap(previousVelocity_);
  exchangeHeld(model.nodes);
  flow_.undo(model);
}

void ExplicitDynamics::refuseElement(const Model& model) {
  std::size_t e = 0;
  while (determinant(deformationGradient(model, ElementId(e))) > 0) ++e;
  const bool inverted = determinant(deformationGradient(model, ElementId(e))) <= 0;
  throw RunError(fmt::format("{} {}.", nameOf(model, ElementId(e), model.nodes.position),
                             inverted ? "is inverted" : "has a value that is not finite"));
}

void ExplicitDynamics::refuseNode(Model& model) {
  Nodes& nodes = model.nodes;
  exchangeHeld(nodes);
  std::size_t bad = 0;
  while (isFinite(previousPosition_[bad])) ++bad;
  throw RunError(fmt::format(
      "node {} of component {} at ({:g}, {:g}) m has a force or a velocity that is not finite.",
      bad, nodes.component[bad].value, nodes.position[bad].x, nodes.position[bad].y));
}

}  // namespace yadefrag
