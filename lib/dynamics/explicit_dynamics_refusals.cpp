// Errors in a step: finds the element or node that causes them, and restores the state before the
// step.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "core/errors.hpp"
#include "core/tolerances/dynamics.hpp"
#include "core/tolerances/elements.hpp"
#include "dynamics/element_state.hpp"
#include "dynamics/explicit_dynamics.hpp"

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

/// The smaller principal stretch.
double leastStretch(const Matrix2& f) {
  const double sum = std::hypot(f.xx + f.yy, f.yx - f.xy);
  const double difference = std::hypot(f.xx - f.yy, f.yx + f.xy);
  return (sum - difference) / 2;
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

void ExplicitDynamics::requireUpright(const Model& model, double dt, double correction) const {
  const auto look = [&](std::size_t begin, std::size_t end) {
    for (std::size_t e = begin; e < end; ++e) {
      const Matrix2 now = deformationGradient(model, ElementId(e));
      if (determinant(now) > 0) continue;
      const double before = leastStretch(now - deformationStep(model, ElementId(e), dt));
      const double change = before - leastStretch(now);
      const std::string reason = fmt::format("{} is inverted in a step of {:g} s",
                                             nameOf(model, ElementId(e), previousPosition_), dt);
      if (std::max(before, change) > tolerance::kCollapsed)
        throw RunError(reason + "; take a shorter one.");
      throw RunError(fmt::format(
          "{}, after it was pressed to {:.2g} of its height: an elastic element does not resist "
          "collapse, and a shorter step does not help; set the bulk viscosity "
          "(fe.quadraticViscosity = 1.2), or take a stiffer material or slower bodies.",
          reason, before));
    }
  };
  if (anyLargeMove_ || correction > tolerance::kLargeMove * leastHeight_)
    return look(0, model.triangles.size());
  for (const Scratch& scratch : scratch_)
    for (const ElementRange& range : scratch.flat) look(range.firstElement, range.lastElement);
}

/// Exchanges the prescribed velocities of held directions with the nodes' previous velocities.
void ExplicitDynamics::exchangeHeld(Nodes& nodes) {
  if (heldVelocity_.empty()) return;
  for (std::size_t n = 0; n < nodes.size(); ++n)
    for (const auto& [axis, flag] : {std::pair{&Vec2::x, kHeldX}, std::pair{&Vec2::y, kHeldY}})
      if ((nodes.held[n] & flag) != 0) std::swap(nodes.velocity[n].*axis, heldVelocity_[n].*axis);
}

void ExplicitDynamics::takeBack(Model& model) {
  model.nodes.position.swap(previousPosition_);
  model.nodes.velocity.swap(previousVelocity_);
  exchangeHeld(model.nodes);
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
