// Refuses bodies and steps for which contact could be missed or wrong: bodies that overlap
// initially, or displacements that are too large.

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "core/errors.hpp"
#include "core/tolerances/step.hpp"
#include "step/overlap_check.hpp"
#include "step/world.hpp"
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

/// Contact prevents new overlaps only; bodies that overlap initially would pass through each other.
void World::requireApart(const TriangleMesh& mesh, const BodySpec& spec,
                         const std::string& subject) {
  if (isBuilt_) places_.clear();  // a step may have moved bodies; between steps they are only added
  places_.update(model, surfaces);
  const auto overlap = findOverlap(model, surfaces, places_, mesh, spec);
  if (!overlap) return;
  const Component& other = model.components[overlap->body.value];
  throw OverlapError(
      fmt::format("{} overlaps {} at ({:.9g}, {:.9g}) m by {:.3g} m; it may touch others at the "
                  "start, but not overlap them.",
                  subject, other.rigid ? other.name : fmt::format("body {}", overlap->body.value),
                  overlap->place.x, overlap->place.y, overlap->depth),
      overlap->depth);
}

/// With larger displacements neither the search nor the deformation would be meaningful.
void World::requireBoundedMotion(double dt) {
  if (!dynamics_.anyLargeMove()) return;
  const std::span<const Vec2> before = dynamics_.previousPosition();
  double most = 0;
  for (std::size_t n = 0; n < before.size(); ++n)
    most = std::max(most, norm(model.nodes.position[n] - before[n]));
  if (most <= tolerance::kFarthestMove * finest_) return;
  if (!std::isfinite(most))
    throw RunError(
        "a node leaves the range of numbers; loads, gravity or velocities are too large for any "
        "step.");
  throw RunError(fmt::format(
      "a node moves by {:g} m in one step, but may not by more than {:g} times the shortest "
      "segment, "
      "{:g} m; take a step of at most {:g} s.",
      most, tolerance::kFarthestMove, finest_,
      tolerance::kAdvised * dt * tolerance::kFarthestMove * finest_ / most));
}

void World::requireResolvedMotion(double dt) {
  // The distance of two nodes decreases by at most twice the largest displacement.
  if (2 * search.largestMove() <= tolerance::kMostMotion * finest_) return;
  const PieceGeometry before(surfaces, dynamics_.previousPosition()),
      now(surfaces, model.nodes.position), free(surfaces, model.nodes.reference);
  const Candidates& candidates = contact.candidates;
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

/// Forces so large that their work exceeds the range of numbers.
void World::requireFiniteEnergy() const {
  if (std::isfinite(ledger.total(0, 0))) return;
  throw RunError("the works of forces on the bodies are not finite; take smaller forces.");
}

}  // namespace yadefrag
