// Refuses steps for which contact could be missed or wrong.

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "core/errors.hpp"
#include "core/tolerances/step.hpp"
#include "step/stages.hpp"
#include "surface/piece_geometry.hpp"

namespace yadefrag {

namespace {

/// The region that a point or a piece covers in the step.
struct Swept {
  Vec2 low, high;
  explicit Swept(Vec2 point) : low(point), high(point) {}
  void add(Vec2 point) {
    low = {std::min(low.x, point.x), std::min(low.y, point.y)};
    high = {std::max(high.x, point.x), std::max(high.y, point.y)};
  }
  [[nodiscard]] bool meets(const Swept& other) const {
    return low.x <= other.high.x && other.low.x <= high.x && low.y <= other.high.y &&
           other.low.y <= high.y;
  }
};

/// (m) Relative displacement of a slave and its master; 0 if their paths do not cross.
double relativeMotion(const PieceGeometry& before, const PieceGeometry& now, EntryId slave,
                      EntryId master) {
  const Vec2 from = before.slave(slave), to = now.slave(slave);
  const PieceEnds start = before.ends(master), end = now.ends(master);
  Swept point(from), piece(start.begin);
  point.add(to);
  for (const Vec2 corner : {start.end, end.begin, end.end}) piece.add(corner);
  if (!point.meets(piece)) return 0;
  return std::max(norm(to - from - (end.begin - start.begin)),
                  norm(to - from - (end.end - start.end)));
}

double chord(const PieceEnds& ends) { return norm(ends.end - ends.begin); }

}  // namespace

void requireBoundedMotion(const StepData& data, double dt) {
  const ExplicitDynamics& dynamics = data.scratch.dynamics;
  if (!dynamics.anyLargeMove()) return;
  const double finest = data.scratch.finest;
  const std::span<const Vec2> before = dynamics.previousPosition();
  double most = 0;
  for (std::size_t n = 0; n < before.size(); ++n)
    most = std::max(most, norm(data.state.model.nodes.position[n] - before[n]));
  if (most <= tolerance::kFarthestMove * finest) return;
  if (!std::isfinite(most))
    throw RunError(
        "a node leaves the range of numbers; loads, gravity or velocities are too large for any "
        "step.");
  throw RunError(fmt::format(
      "a node moves by {:g} m in one step, but may not by more than {:g} times the shortest "
      "segment, "
      "{:g} m; take a step of at most {:g} s.",
      most, tolerance::kFarthestMove, finest,
      tolerance::kAdvised * dt * tolerance::kFarthestMove * finest / most));
}

void requireResolvedMotion(const StepData& data, double dt) {
  const WorldState& state = data.state;
  const double finest = data.scratch.finest;
  // The distance of two nodes decreases by at most twice the largest displacement.
  if (2 * state.search.largestMove() <= tolerance::kMostMotion * finest) return;
  const PieceGeometry before(state.surfaces, data.scratch.dynamics.previousPosition()),
      now(state.surfaces, state.model.nodes.position),
      free(state.surfaces, state.model.nodes.reference);
  const Candidates& candidates = state.contact.candidates;
  double most = 0;
  EntryId fastest;
  for (const std::uint32_t row : candidates.rows())
    for (const EntryId master : candidates.mastersOfRow(row)) {
      const EntryId slave = candidates.slaves[row];
      const double length = std::min(chord(free.ends(slave)), chord(free.ends(master)));
      const double motion = relativeMotion(before, now, slave, master) / length;
      if (motion > most) most = motion, fastest = slave;
    }
  if (most <= tolerance::kMostMotion) return;
  const Vec2 at = before.slave(fastest);
  throw RunError(fmt::format(
      "at ({:g}, {:g}) m a body moves against another by {:g} of a segment in one step, but may "
      "not by "
      "more than {:g}; otherwise contact could be missed; take a step of at most {:g} s.",
      at.x, at.y, most, tolerance::kMostMotion,
      tolerance::kAdvised * dt * tolerance::kMostMotion / most));
}

void requireOutsideAxis(const Model& model) {
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

void requireFiniteEnergy(const EnergyLedger& ledger) {
  if (std::isfinite(ledger.total(0, 0))) return;
  throw RunError("the works of forces on the bodies are not finite; take smaller forces.");
}

}  // namespace yadefrag
