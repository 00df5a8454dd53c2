// Work of external forces, damping and prescribed motion over a step; reactions of held nodes.

#include <algorithm>
#include <utility>

#include "core/tolerances/dynamics.hpp"
#include "time/explicit_dynamics.hpp"

namespace yadefrag {

/// Work at single nodes, in one direction.
struct ExplicitDynamics::Works {
  const ExplicitDynamics& dynamics;
  const Nodes& nodes;
  const StepLength& length;
  const StepSettings& settings;
  std::span<const Vec2> outer, contact;

  /// (N) External force on a node, held or not, averaged over Δv.
  [[nodiscard]] double outerForce(std::size_t n, double Vec2::*axis) const {
    double force = nodes.mass[n] * settings.gravity.*axis;
    if (!nodes.load.empty()) force += nodes.load[n].*axis;
    if (!outer.empty()) force += length.position / length.velocity * outer[n].*axis;
    return force;
  }

  /// (N) Force of elements and of other surfaces.
  [[nodiscard]] double innerForce(std::size_t n, double Vec2::*axis) const {
    return dynamics.force_[n].*axis + (contact.empty() ? 0 : contact[n].*axis);
  }

  void addNode(std::size_t n, double Vec2::*axis, bool held, EnergyLedger& ledger) const {
    const double mass = nodes.mass[n];
    const double before = dynamics.previousVelocity_[n].*axis;
    const double after = nodes.velocity[n].*axis;
    const double way = length.velocity * (before + after) / 2;
    if (!dynamics.viscousForce_.empty()) ledger.damping -= dynamics.viscousForce_[n].*axis * way;
    if (held) {
      // The reaction is the force that the prescribed motion requires.
      ledger.external += mass * (after + before) * (after - before) / 2 - innerForce(n, axis) * way;
      return;
    }
    ledger.external += outerForce(n, axis) * way;
    ledger.damping += settings.damping * mass * way * way / length.velocity;
  }
};

void ExplicitDynamics::finish(const Model& model, const StepLength& length,
                              const StepSettings& settings, std::span<const Vec2> outerForces,
                              std::span<const Vec2> contactForces, EnergyLedger& ledger,
                              int threads) const {
  const Nodes& nodes = model.nodes;
  const bool all = settings.gravity != Vec2{} || !nodes.load.empty() || !outerForces.empty() ||
                   settings.damping != 0 || !viscousForce_.empty();
  if (!all && heldVelocity_.empty()) return;
  const Works works{*this, nodes, length, settings, outerForces, contactForces};
  // Sums over blocks of a fixed length, so that they do not depend on the number of threads.
  const std::size_t blocks = (nodes.size() + tolerance::kNodesPerSum - 1) / tolerance::kNodesPerSum;
  std::vector<EnergyLedger> sums(blocks);
  const bool many = model.triangles.size() >= 2 * elementsPerThread();
#pragma omp parallel for schedule(static) num_threads(threads) if (threads > 1 && many)
  for (std::size_t block = 0; block < blocks; ++block) {
    const std::size_t begin = block * tolerance::kNodesPerSum;
    const std::size_t end = std::min(nodes.size(), begin + tolerance::kNodesPerSum);
    for (std::size_t n = begin; n < end; ++n) {
      if (!all && nodes.held[n] == kFree) continue;
      works.addNode(n, &Vec2::x, (nodes.held[n] & kHeldX) != 0, sums[block]);
      works.addNode(n, &Vec2::y, (nodes.held[n] & kHeldY) != 0, sums[block]);
    }
  }
  for (const EnergyLedger& sum : sums) {
    ledger.external += sum.external;
    ledger.damping += sum.damping;
  }
}

double ExplicitDynamics::energyOfChange(const Model& model, const StepLength& length) const {
  const double last = 2 * length.velocity - length.position;
  double sum = 0;
  for (std::size_t n = 0; n < force_.size(); ++n)
    sum += dot(force_[n], model.nodes.velocity[n] - previousVelocity_[n]);
  return (last - length.position) / 4 * sum;
}

void ExplicitDynamics::measureReactions(const Model& model, const StepLength& length,
                                        const StepSettings& settings,
                                        std::span<const Vec2> outerForces,
                                        std::span<const Vec2> contactForces,
                                        std::vector<Vec2>& reactions) const {
  const Nodes& nodes = model.nodes;
  const Works works{*this, nodes, length, settings, outerForces, contactForces};
  reactions.resize(nodes.size());
  for (const NodeId node : heldNodes_) {
    const std::uint32_t n = node.value;
    reactions[n] = {};
    for (const auto& [axis, flag] : {std::pair{&Vec2::x, kHeldX}, std::pair{&Vec2::y, kHeldY}}) {
      if ((nodes.held[n] & flag) == 0) continue;
      const double gained = nodes.velocity[n].*axis - previousVelocity_[n].*axis;
      reactions[n].*axis = nodes.mass[n] * gained / length.velocity - works.innerForce(n, axis) -
                           works.outerForce(n, axis);
    }
  }
}

}  // namespace yadefrag
