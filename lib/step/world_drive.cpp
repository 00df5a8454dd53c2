// World: prescribed motion.

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "core/errors.hpp"
#include "core/tolerances/dynamics.hpp"
#include "step/world.hpp"

namespace yadefrag {

void World::requireNodes(std::span<const NodeId> nodes) const {
  for (const NodeId node : nodes)
    if (node.value >= model.nodes.size())
      throw InputError(
          fmt::format("There is no node {}: there are {} nodes.", node.value, model.nodes.size()));
}

void World::prescribe(std::span<const NodeId> nodes, std::uint8_t held, Vec2 velocity) {
  prescribeEach(nodes, held, std::vector<Vec2>(nodes.size(), velocity));
}

void World::prescribeEach(std::span<const NodeId> nodes, std::uint8_t held,
                          std::span<const Vec2> velocity) {
  requireNodes(nodes);
  for (const Vec2 v : velocity)
    if (!(std::max(std::abs(v.x), std::abs(v.y)) <= tolerance::kMostSpeed))
      throw InputError("The prescribed velocity must be finite and at most 1e100 m/s.");
  const auto isNew = [&](NodeId node) { return model.nodes.held[node.value] != held; };
  const bool changed = std::any_of(nodes.begin(), nodes.end(), isNew);
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    const std::uint32_t node = nodes[i].value;
    if (model.nodes.mass[node] == 0) continue;  // of a removed triangle
    Vec2& present = model.nodes.velocity[node];
    const Vec2 former = present;
    model.nodes.held[node] = held;
    if (!model.nodes.motion.empty()) model.nodes.motion[node] = 0;
    if ((held & kHeldX) != 0) present.x = velocity[i].x;
    if ((held & kHeldY) != 0) present.y = velocity[i].y;
    if (model.isOnAxis(nodes[i])) model.nodes.held[node] |= kHeldX, present.x = 0;
    // The dynamics counts the work of a velocity jump of nodes that were held before; after a
    // rebuild it has no such nodes.
    if (changed)
      ledger.external += model.nodes.mass[node] / 2 * (dot(present, present) - dot(former, former));
  }
  removeUnusedMotions(model);
  if (changed) noteChange();
}

void World::prescribeMotion(std::span<const NodeId> nodes, std::uint8_t held, Motion motion) {
  requireNodes(nodes);
  if (!isFinite(motion.centre)) throw InputError("The centre of a motion must be finite.");
  for (const TimeTable* table : {&motion.speedX, &motion.speedY, &motion.turn})
    if (!table->times().empty() && !TimeTable::isValid(table->times(), table->values()))
      throw InputError("The times of a motion must ascend, and its values be finite.");
  if (!motion.turn.times().empty() && held != kHeldXY)
    throw InputError("A motion that turns must hold both directions.");
  if (!motion.turn.times().empty() && model.axisymmetric)
    throw InputError("Around an axis no body can turn in the plane.");
  motion.begin = time;
  Nodes& all = model.nodes;
  all.motion.resize(all.size()), all.arm.resize(all.size());
  model.motions.push_back(std::move(motion));
  const Motion& added = model.motions.back();
  for (const NodeId node : nodes) {
    if (all.mass[node.value] == 0) continue;  // of a removed triangle
    if (all.held[node.value] != held) noteChange();
    all.held[node.value] = held | (model.isOnAxis(node) ? kHeldX : kFree);
    all.motion[node.value] = static_cast<std::uint32_t>(model.motions.size());
    all.arm[node.value] = all.position[node.value] - added.centre;
  }
  removeUnusedMotions(model);
}

void removeUnusedMotions(Model& model) {
  if (model.motions.empty()) return;
  std::vector<std::uint32_t> numbers(model.motions.size() + 1);
  for (const std::uint32_t motion : model.nodes.motion) numbers[motion] = 1;
  std::uint32_t kept = 0;
  numbers[0] = 0;
  for (std::size_t m = 1; m < numbers.size(); ++m) {
    if (numbers[m] == 0) continue;
    if (kept != m - 1) model.motions[kept] = std::move(model.motions[m - 1]);
    numbers[m] = ++kept;
  }
  model.motions.resize(kept);
  for (std::uint32_t& motion : model.nodes.motion) motion = numbers[motion];
  if (kept == 0) model.nodes.motion = {}, model.nodes.arm = {};
}

void drive(const StepData& data, double dt) {
  Model& model = data.state.model;
  Nodes& nodes = model.nodes;
  if (nodes.motion.empty()) return;
  const std::vector<Vec2>& given = data.exchange.givenVelocities;
  const std::vector<Vec2>& ofRigid = data.exchange.rigidVelocities;
  const std::vector<NodeId>& rigidNodes = data.scratch.rigidNodes;
  std::vector<MovedFrame> frames;
  for (const Motion& motion : model.motions) {
    if (motion.isScripted() && given.size() != nodes.size())
      throw RunError(
          "nodes are moved by a function of the script, which a saved file does not have; call "
          "FESolver.prescribe for them again.");
    frames.emplace_back(motion, data.state.time + dt);
  }
  const auto rigid = [&](NodeId node) {
    if (ofRigid.empty()) return Vec2{};
    const auto at = std::ranges::lower_bound(rigidNodes, node);
    return ofRigid[static_cast<std::size_t>(at - rigidNodes.begin())];
  };
  for (std::size_t n = 0; n < nodes.size(); ++n) {
    if (nodes.motion[n] == 0) continue;
    Vec2& velocity = nodes.velocity[n];
    data.scratch.undo.driven.push_back(velocity);
    const std::uint32_t m = nodes.motion[n] - 1;
    const std::uint32_t function = model.motions[m].function;
    const Vec2 wanted = function == Motion::kRigid ? rigid(NodeId(n))
                        : function != 0
                            ? given[n]
                            : (1 / dt) * (frames[m].place(nodes.arm[n]) - nodes.position[n]);
    if ((nodes.held[n] & kHeldX) != 0) velocity.x = model.isOnAxis(NodeId(n)) ? 0 : wanted.x;
    if ((nodes.held[n] & kHeldY) != 0) velocity.y = wanted.y;
  }
}

void undoDrive(Nodes& nodes, std::span<const Vec2> driven) {
  std::size_t next = 0;
  for (std::size_t n = 0; next < driven.size() && n < nodes.size(); ++n)
    if (nodes.motion[n] != 0) nodes.velocity[n] = driven[next++];
}

}  // namespace yadefrag
