#include "contact/contact.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <optional>
#include <utility>

#include "contact/row_builder.hpp"
#include "core/errors.hpp"
#include "core/tolerances/contact.hpp"
#include "core/tolerances/solver.hpp"
#include "core/tolerances/step.hpp"

namespace yadefrag {

namespace {

SlaveMaster pairOf(const ContactRow& row) { return {row.slave, row.master}; }

/// (m) Penetration above which the system is solved again. Without a segment that can move,
/// `shortest` is 0, and the quotient may be 0/0: `min` and `max` then return the other values.
double worthwhile(const ContactStep& step) {
  const double secondOrder =
      std::min(tolerance::kMostRemainder * step.shortest,
               tolerance::kSecondOrder * step.move * step.move / step.shortest);
  return std::max({tolerance::kRemainder * step.move,
                   tolerance::kRemainingPenetration * step.shortest, secondOrder});
}

/// True if two pieces meet at a junction that does not turn towards the void.
bool meetInConvexJunction(const ContactSurfaces& surfaces, const PieceGeometry& geometry, EntryId a,
                          EntryId b) {
  if (surfaces.next[b.value] == a) std::swap(a, b);
  if (surfaces.next[a.value] != b) return false;
  return cross(geometry.tangent(a, geometry.range(a).end),
               geometry.tangent(b, geometry.range(b).begin)) >= 0;
}

/// Sorts touches of which those of each detection are sorted.
void mergeByPair(std::vector<Touch>& touches) {
  const auto byPair = [](const Touch& a, const Touch& b) { return a.pair < b.pair; };
  const auto begin = touches.begin(), end = touches.end();
  auto merged = std::is_sorted_until(begin, end, byPair);
  while (merged != end) {
    const auto next = std::is_sorted_until(merged, end, byPair);
    std::inplace_merge(begin, merged, next, byPair);
    merged = next;
  }
  assert(std::is_sorted(begin, end, byPair));
}

}  // namespace

/// Deletes candidates and stored contacts.
void Contact::reset() {
  candidates.clear();
  touches.clear();
  lastCorrection = 0;
  rows_.clear();
  now_ = {};
  touched_.clear();
  forces_.clear();
  displacement_.clear();
  isTouched_.clear();
}

void Contact::resize(std::size_t nodes) {
  if (!forces_.empty()) makeRoom(nodes);
}

/// Allocates memory on the first contact: bodies that never touch need none.
void Contact::makeRoom(std::size_t nodes) {
  forces_.resize(nodes);
  displacement_.resize(nodes);
  isTouched_.resize(nodes);
}

void Contact::reserve(std::size_t nodes) {
  forces_.reserve(nodes);
  displacement_.reserve(nodes);
  isTouched_.reserve(nodes);
  sweeps_.reserve(nodes);
}

void Contact::correct(Model& model, const ContactSurfaces& surfaces, const ContactStep& step) {
  assert(forces_.empty() || forces_.size() == model.nodes.size());  // `resize` follows new nodes
  assert(std::ranges::none_of(touches, [&](const Touch& touch) {
    return surfaces.isGone(touch.pair.slave) || surfaces.isGone(touch.pair.master);
  }));
  begin();
  assert(step.rigid.nodesOf.rows() == step.rigid.masses.size() &&
         step.rigid.nodesOf.values.size() == step.rigid.members.size());
  rigidLoads_.assign(step.rigid.masses.size(), {});
  deepest_ = deepestTouch(surfaces, step.before);
  bool gapsAreKnown = false;
  // Corrections are mostly as large as those of the previous step.
  double reach = std::max(step.reach, tolerance::kReachSpare * lastCorrection);
  scan(model, surfaces, step, reach, step.move);
  for (int detection = 0; detection < tolerance::kDetections; ++detection) {
    const std::size_t former = rows_.size();
    const bool anyNew = mayHaveEntered(step) && addRows(model, surfaces, step);
    if (rows_.empty()) break;
    if (detection > 0) {
      updateGaps(model, surfaces, step);
      gapsAreKnown = true;
      // New rows of this detection without a penetration above the threshold wait for the next
      // step.
      if (now_.maxPenetration <= worthwhile(step)) {
        releaseUnsolved();
        break;
      }
      if (!anyNew && now_.maxPenetration <= 2 * inexact_) break;
    }
    releaseOpposed(model, surfaces, former);
    const double moved = solve(model, step);
    sinceScan_ += moved, sinceSearch_ += moved;
    // Nodes that the correction moved beyond the reach of the scan are scanned again.
    move(model, step);
    gapsAreKnown = false;
    if (2 * now_.largestCorrection > reach) {
      reach = 2 * now_.largestCorrection;
      scan(model, surfaces, step, reach);
    }
  }
  if (mayHaveEntered(step)) rescan(model, surfaces, step);
  if (!rows_.empty() && !gapsAreKnown) updateGaps(model, surfaces, step);
  finish(model, step);
}

/// True if corrections since the last search for actives may have moved a slave deep into a master.
/// Contacts that are less deep begin in the next step.
bool Contact::mayHaveEntered(const ContactStep& step) const {
  return 2 * sinceSearch_ > tolerance::kLateContact * step.shortest;
}

void Contact::begin() {
  rows_.swap(formerRows_);
  former_ = std::exchange(now_, {});
  isFinished_ = false;
  rows_.clear();
  pairs_.clear();
  sweeps_.clear();
  sinceSearch_ = INFINITY;
  inexact_ = 0;
  clearForces();
}

void Contact::clearForces() {
  for (const NodeId node : touched_) {
    forces_[node.value] = displacement_[node.value] = {};
    isTouched_[node.value] = 0;
  }
  touched_.clear();
}

void Contact::takeBack() {
  candidates.idleDistance.clear();
  if (isFinished_) touches.swap(formerTouches_), lastCorrection = formerCorrection_;
  rows_.swap(formerRows_);
  now_ = former_;
  assert(std::ranges::is_sorted(touches, {}, &Touch::pair));
  clearForces();
  for (const ContactRow& row : rows_)
    for (int k = 0; k < row.count; ++k) touch(row.node[static_cast<std::size_t>(k)]);
  sumForces();
}

/// Penetrations caused by the last correction of a step are left to the next one, which needs these
/// contacts: the slaves are behind their masters by then.
void Contact::rescan(const Model& model, const ContactSurfaces& surfaces, const ContactStep& step) {
  if (addRows(model, surfaces, step)) releaseUnsolved();
}

/// Rows added after the last solution have not moved a node: their force is zero.
void Contact::releaseUnsolved() {
  for (std::size_t r = sweeps_.size(); r < rows_.size(); ++r)
    rows_[r].normalForce = rows_[r].tangentForce = 0;
}

/// `moved` (m): upper bound of the displacement of any node since the last scan, without
/// corrections.
void Contact::scan(const Model& model, const ContactSurfaces& surfaces, const ContactStep& step,
                   double reach, double moved) {
  const StageTimer timer(step.times, &StageTimes::localSearch);
  const PathStart start{step.before, touches, step.constants.outsideDepth * step.shortest, deepest_,
                        step.constants};
  search_.scan(candidates, surfaces, model.nodes.position, start, reach, step.threads,
               moved + sinceScan_);
  sinceScan_ = 0;
}

/// Returns a bound of the displacements by the coupled forces (m).
double Contact::solve(Model& model, const ContactStep& step) {
  const StageTimer timer(step.times, &StageTimes::correction);
  const Inertia inertia{model.nodes, step.length, step.drag, step.rigid.masses};
  const RowSweeps::Stop stop{tolerance::kChange * worthwhile(step), step.constants.rowSweeps};
  std::optional<Coupling> coupling;
  if (step.coupled != nullptr)
    coupling.emplace(Coupling{*step.coupled, model.nodes.position, displacement_});
  inexact_ = sweeps_.solve(rows_, inertia, stop, coupling ? &*coupling : nullptr, step.threads);
  now_.sweeps += sweeps_.sweeps();
  return coupling ? coupling->moved : 0;
}

/// Adds a row for every active without one; returns true if there was any.
bool Contact::addRows(const Model& model, const ContactSurfaces& surfaces,
                      const ContactStep& step) {
  sinceSearch_ = 0;
  if (!search_.anyNear()) return false;
  const StageTimer timer(step.times, &StageTimes::localSearch);
  actives_.clear();
  search_.findActives(candidates, surfaces, model.nodes.position, step.deepest, actives_, pairs_,
                      sinceScan_);
  if (!actives_.empty()) makeRoom(model.nodes.size()), pairs_.grow(surfaces.entries());
  const PieceGeometry before(surfaces, step.before);
  const std::size_t former = rows_.size();
  TouchCursor cursor(touches);
  for (const Active& active : actives_) {
    const std::span<const Touch> stored = cursor.of(active.pair.slave);
    if (hasRow(surfaces, before, active.pair)) continue;
    if (stored.empty() && isThroughItself(surfaces, before, active.pair, step)) continue;
    const double friction = frictionOf(active.pair, model, surfaces);
    ContactRow row = makeRow(surfaces, before, active, step.constants.faceAngle, friction > 0);
    const Touch* const known = touchOn(stored, active.pair.master);
    // Cohesion keeps corners of one split node together. Their rows would be as many as its cracks,
    // and coupled with all of them (Ring.OnTheMeshOfAPolygon).
    if (known == nullptr && row.gap >= -tolerance::kHeldDepth * step.shortest &&
        isHeldByCohesion(row, step.coupled))
      continue;
    row.friction = friction;
    startRow(row, model, before, known, step);
    for (int k = 0; k < row.count; ++k) touch(row.node[static_cast<std::size_t>(k)]);
    if (!step.rigid.empty()) joinRigid(row, model.nodes, step);
    rows_.push_back(row);
    pairs_.add(active.pair);
  }
  return rows_.size() > former;
}

void Contact::touch(NodeId node) {
  if (isTouched_[node.value] == 0) touched_.push_back(node);
  isTouched_[node.value] = 1;
}

/// A slave that the correction moved to the next master keeps its row. The two rows differ by the
/// second-order remainder, and both together would hold the slave in front of both faces of a
/// convex corner.
bool Contact::hasRow(const ContactSurfaces& surfaces, const PieceGeometry& before,
                     SlaveMaster pair) const {
  return pairs_.any(pair.slave, [&](std::uint32_t, EntryId master) {
    return master == pair.master || meetInConvexJunction(surfaces, before, master, pair.master);
  });
}

/// Where the slave's own body is thinner than the halo, a smooth master may be on the other side of
/// that body: the slave was as deep before, and was not in contact.
bool Contact::isThroughItself(const ContactSurfaces& surfaces, const PieceGeometry& before,
                              SlaveMaster pair, const ContactStep& step) {
  if (surfaces.component[pair.slave.value] != surfaces.component[pair.master.value] ||
      surfaces.piece[pair.master.value] != Piece::kArc)
    return false;
  return before.foot(pair.master, before.slave(pair.slave)).gap <
         -tolerance::kTouching * step.shortest;
}

/// Two corners that have passed each other: each is behind a face of the other, and the two rows
/// push in the same direction. With friction in one of them, their forces would support each other
/// without bound, as one normal is within the friction cone of the other: what contact then gives,
/// friction takes. Rows from `first` on are new. Only before a solution: the forces are applied.
void Contact::releaseOpposed(const Model& model, const ContactSurfaces& surfaces,
                             std::size_t first) {
  for (std::size_t r = first; r < rows_.size(); ++r) {
    ContactRow& row = rows_[r];
    const auto release = [&](std::uint32_t number, EntryId master) {
      ContactRow& other = rows_[number];
      const bool exchanged = master == row.slave || surfaces.next[master.value] == row.slave;
      if (exchanged && dot(other.normal, row.normal) > 0)
        row.friction = row.tangentForce = other.friction = other.tangentForce = 0;
      return false;
    };
    if (!(frictionOf(pairOf(row), model, surfaces) > 0)) continue;
    (void)pairs_.any(row.master, release);
    (void)pairs_.any(surfaces.next[row.master.value], release);
  }
}

/// Computes the exact gaps at the corrected positions, and transforms them back to the predicted
/// positions by the rows' linearisation: the next solution then leaves a remainder of higher order.
void Contact::updateGaps(const Model& model, const ContactSurfaces& surfaces,
                         const ContactStep& step) {
  const StageTimer timer(step.times, &StageTimes::localSearch);
  now_.maxPenetration = 0;
  withGeometry(surfaces, model.nodes.position, [&](const auto& geometry) {
    for (ContactRow& row : rows_) {
      const double gap = gapOf(row, geometry);
      now_.maxPenetration = std::max(now_.maxPenetration, row.toleratedGap - gap);
      row.gap = gap - dot(relative(row, displacement_), row.normal);
      if (step.coupled != nullptr && row.friction > 0) row.slip = slipOf(row, model, step);
    }
  });
}

/// Moves the nodes from their present positions to x* + u.
void Contact::move(Model& model, const ContactStep& step) {
  const StageTimer timer(step.times, &StageTimes::correction);
  for (const NodeId node : touched_) forces_[node.value] = {};
  sumForces();
  const double squared = step.length.squared();
  double largest = 0, farthest = 0;
  for (const NodeId node : touched_) {
    if (isOfRigid(node, step)) continue;
    const Vec2 mobile = mobility(model.nodes, node, step.drag);
    const Vec2 force = forces_[node.value];
    const Vec2 u{squared * mobile.x * force.x, squared * mobile.y * force.y};
    const Vec2 by = u - displacement_[node.value];
    model.nodes.position[node.value] += by;
    displacement_[node.value] = u;
    largest = std::max(largest, dot(u, u));
    farthest = std::max(farthest, dot(by, by));
  }
  moveRigid(model, step, largest, farthest);
  sinceScan_ += std::sqrt(farthest), sinceSearch_ += std::sqrt(farthest);
  now_.largestCorrection = std::sqrt(largest);
  if (now_.largestCorrection <= 2 * tolerance::kFarthestMove * step.shortest) return;
  throw RunError(fmt::format(
      "contact moves a surface node by {:g} m, which is many times the shortest segment, "
      "{:g} m; take a shorter step, or slower bodies.",
      now_.largestCorrection, step.shortest));
}

/// Eq. 7: Fᵢ = Σ weight × force of the rows.
void Contact::sumForces() {
  for (const ContactRow& row : rows_) {
    const Vec2 force = row.force();
    for (int k = 0; k < row.count; ++k) {
      const auto at = static_cast<std::size_t>(k);
      forces_[row.node[at].value] += row.weight[at] * force;
    }
  }
}

/// Sets velocities, and the data for the next step.
void Contact::finish(Model& model, const ContactStep& step) {
  for (const NodeId node : touched_) {
    const std::uint32_t n = node.value;
    if (isOfRigid(node, step))
      model.nodes.velocity[n] =
          1 / step.length.position * (model.nodes.position[n] - step.before[n]);
    else
      model.nodes.velocity[n] += (1 / step.length.position) * displacement_[n];
  }
  const StageTimer timer(step.times, &StageTimes::localSearch);
  formerTouches_.clear();
  for (const ContactRow& row : rows_)
    formerTouches_.push_back({pairOf(row), row.normalForce, row.tangentForce, row.toleratedGap});
  mergeByPair(formerTouches_);
  touches.swap(formerTouches_);
  formerCorrection_ = std::exchange(lastCorrection, now_.largestCorrection);
  isFinished_ = true;
}

}  // namespace yadefrag
