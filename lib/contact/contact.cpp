#include "contact/contact.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <utility>

#include "core/errors.hpp"
#include "core/parallel.hpp"
#include "core/tolerances/contact.hpp"
#include "core/tolerances/step.hpp"

namespace yadefrag {

/// Deletes candidates and stored contacts.
void Contact::reset() {
  candidates.clear();
  touches.clear();
  rows_.clear();
  now_ = {};
  touched_.clear();
  forces_.clear();
  isTouched_.clear();
}

void Contact::resize(std::size_t nodes) {
  if (!forces_.empty()) makeRoom(nodes);
}

/// Allocates memory on the first contact: bodies that never touch need none.
void Contact::makeRoom(std::size_t nodes) {
  forces_.resize(nodes);
  isTouched_.resize(nodes);
}

void Contact::reserve(std::size_t nodes) {
  forces_.reserve(nodes);
  isTouched_.reserve(nodes);
  sweeps_.reserve(nodes);
}

void Contact::correct(Model& model, const ContactSurfaces& surfaces, const ContactStep& step) {
  assert(forces_.empty() || forces_.size() == model.nodes.size());  // `resize` follows new nodes
  assert(std::ranges::none_of(touches, [&](const StoredContact& touch) {
    return surfaces.isGone(touch.pair.slave) || surfaces.isGone(touch.pair.master);
  }));
  begin(step);
  if (!candidates.slaves.empty()) {
    detect(model, surfaces, step);
    if (sweeps_.size() > 0) {
      solve(model, surfaces, step);
      keepRows(model, surfaces, step);
      move(model, step);
    }
  }
  finish(step);
}

void Contact::begin(const ContactStep& step) {
  rows_.swap(formerRows_);
  former_ = std::exchange(now_, {});
  isFinished_ = false;
  rows_.clear();
  sweeps_.clear();
  clearForces();
  assert(step.rigid.nodesOf.rows() == step.rigid.masses.size() &&
         step.rigid.nodesOf.values.size() == step.rigid.members.size());
  rigidLoads_.assign(step.rigid.masses.size(), {});
}

void Contact::clearForces() {
  for (const NodeId node : touched_) {
    forces_[node.value] = {};
    isTouched_[node.value] = 0;
  }
  touched_.clear();
}

void Contact::undo() {
  if (isFinished_) touches.swap(formerTouches_);
  rows_.swap(formerRows_);
  now_ = former_;
  clearForces();
  sumForces();
}

void Contact::detect(const Model& model, const ContactSurfaces& surfaces, const ContactStep& step) {
  const StageTimer timer(step.times, &StageTimes::localSearch);
  if (!RowFinder::mayFind(candidates, {step.shortest, step.move, step.constants}, travelled_))
    return;
  const RowFinder::Positions positions{step.before, model.nodes.position};
  move_ = std::min(step.move, finder_.measure(surfaces, positions, step.threads));
  const ContactSizes sizes(step.shortest, move_, step.constants);
  near_.swap(finder_.find(candidates, surfaces, positions, sizes, travelled_, step.threads));
  if (near_.empty()) return;
  makeRoom(model.nodes.size());
  makeRows(model, surfaces, step);
}

/// Those of the rows that were detected become the system, with their forces of the last step.
void Contact::makeRows(const Model& model, const ContactSurfaces& surfaces,
                       const ContactStep& step) {
  indexTouches(surfaces.entries());
  measureFriction(model);
  const Inertia inertia{model.nodes, step.length, step.drag, step.rigid.masses};
  std::size_t kept = 0;
  bool hasFirst = false;  // the row before is in the system
  for (const NearRow& near : near_) {
    ContactRow row = rowOf(near, surfaces, model.nodes, step);
    const StoredContact* const former = storedContactOf({row.slave, row.master});
    const bool isHeld = isHeldByCohesion(row, step.coupled);
    const bool isPair = near.isSecond && hasFirst;
    // Cohesion keeps corners of one split node together. Their rows would be as many as its
    // cracks, and coupled with all of them (Ring.OnTheMeshOfAPolygon).
    hasFirst = !isHeld || former != nullptr || near.gap < -tolerance::kHeldDepth * step.shortest;
    if (!hasFirst) continue;
    if (former != nullptr)
      row.normalForce = former->normalForce, row.tangentForce = former->tangentForce;
    RowSystem::Row& added = sweeps_.add(row, inertia);
    if (!isHeld)
      added.gap -= toleratedGap(added, near.before, step);
    else  // not reduced; but for the stored value the depth would drift
      added.gap -= std::max(std::min(0., near.before), former ? former->toleratedGap : -INFINITY);
    if (isPair) sweeps_.linkLast();
    near_[kept++] = near;
  }
  near_.resize(kept);
}

/// (m) A part of the overlap at xⁿ (`before`: m, the gap) is left to later steps. What is removed
/// becomes a velocity, which should be small beside that of the fastest node, or beside that by
/// which the row's own force changes in a step.
double Contact::toleratedGap(const RowSystem::Row& row, double before,
                             const ContactStep& step) const {
  const double deep = -std::min(0., before);
  // What the sweeps leave at rest goes slowly: pushed out at once, blocks would creep on a slope.
  const bool isShallow = deep < tolerance::kShallow * step.shortest;
  const double decay = isShallow ? std::min(step.constants.overlapDecay, tolerance::kShallowDecay)
                                 : step.constants.overlapDecay;
  const double most = std::max(move_, tolerance::kOwnPart * row.normalForce * row.normalResponse);
  return std::min(0., decay * std::min(deep, most) - deep);
}

/// Without forces.
ContactRow Contact::rowOf(const NearRow& near, const ContactSurfaces& surfaces, const Nodes& nodes,
                          const ContactStep& step) const {
  ContactRow row;
  row.slave = near.slave, row.master = near.master;
  if (!surfaces.anySmooth()) {
    // Without the generality of stencils: most rows are of this kind.
    const auto add = [&](EntryId entry, double weight) {
      if (weight == 0) return;
      const auto at = static_cast<std::size_t>(row.count++);
      row.node[at] = surfaces.nodeOf(entry);
      row.weight[at] = weight;
    };
    add(near.slave, 1);
    add(near.master, near.xi - 1), add(surfaces.next[near.master.value], -near.xi);
  } else {
    const PieceRange range = pieceRange(surfaces.piece[near.master.value]);
    row.add(surfaces.slave(near.slave), 1);
    row.add(surfaces.master(near.master, range.begin + near.xi * (range.end - range.begin)), -1);
  }
  row.normal = near.normal, row.gap = near.gap;
  row.friction = frictionOf({near.slave, near.master}, surfaces);
  if (row.friction > 0) row.slip = near.slip;
  if (!step.rigid.empty()) findRigid(row, nodes, step);
  return row;
}

void Contact::solve(Model& model, const ContactSurfaces& surfaces, const ContactStep& step) {
  const StageTimer timer(step.times, &StageTimes::correction);
  const double least = tolerance::kLeastChange * step.shortest;
  const RowSweeps::Stop stop{std::max(step.constants.stop * move_, least), step.constants.rowSweeps,
                             least};
  (void)sweeps_.begin(stop, step.coupled, &model.nodes.position);
  // Not with cohesion, which holds pieces at their gaps: overlaps of 2e-3 of a segment otherwise.
  if (step.coupled == nullptr) {
    measureGaps(model.nodes, surfaces, step.threads);
    sweeps_.improve(tolerance::kLastSweeps);
  }
  now_.largestCorrection = sweeps_.end(step.coupled, &model.nodes.position);
  now_.sweeps = sweeps_.sweeps();
}

/// (m) At the positions that the forces lead to.
double Contact::gapReached(const NearRow& near, const Nodes& nodes,
                           const ContactSurfaces& surfaces) const {
  const auto placeOf = [&](NodeId node) {
    return nodes.position[node.value] + sweeps_.shiftOf(node);
  };
  const auto lineGap = [](Vec2 slave, Vec2 first, Vec2 second) {
    return cross(slave - first, second - first) / norm(second - first);
  };
  if (!surfaces.anySmooth())  // most are
    return lineGap(placeOf(surfaces.nodeOf(near.slave)), placeOf(surfaces.nodeOf(near.master)),
                   placeOf(surfaces.nodeOf(surfaces.next[near.master.value])));
  const Stencil at = surfaces.slave(near.slave), on = surfaces.master(near.master, .5);
  Vec2 slave;
  for (int k = 0; k < at.count; ++k) slave += at.weight[k] * placeOf(at.node[k]);
  const Vec2 first = placeOf(on.node[0]), second = placeOf(on.node[1]);
  return on.count == 3 ? nearestOnArc(first, second, placeOf(on.node[2]), slave).gap
                       : lineGap(slave, first, second);
}

/// The gaps reached differ from the linear ones by the second order of the rotation. Only of rows
/// with a force, without rigid bodies.
void Contact::measureGaps(const Nodes& nodes, const ContactSurfaces& surfaces, int threads) {
  perRow_.resize(near_.size());
  forEachPart(near_.size(), threads, [&](std::size_t begin, std::size_t end, int) {
    for (std::size_t r = begin; r < end; ++r) {
      const RowSystem::Row& row = sweeps_.row(r);
      const bool isMeasured = row.normalForce > 0 && row.turn == RowSystem::kNone;
      const double linear = sweeps_.gapAfter(row) + near_[r].gap - row.gap;
      perRow_[r] = isMeasured ? gapReached(near_[r], nodes, surfaces) - linear : 0;
    }
  });
  for (std::size_t r = 0; r < near_.size(); ++r) {
    if (perRow_[r] == 0) continue;
    near_[r].gap += perRow_[r];
    sweeps_.setGap(r, sweeps_.row(r).gap + perRow_[r]);
  }
}

/// Only rows with a force are kept.
void Contact::keepRows(const Model& model, const ContactSurfaces& surfaces,
                       const ContactStep& step) {
  const StageTimer timer(step.times, &StageTimes::correction);
  const PieceGeometry before(surfaces, step.before);
  perRow_.resize(near_.size());
  const auto list = [&](std::size_t begin, std::size_t end, auto& kept) {
    for (std::size_t r = begin; r < end; ++r) {
      const RowSystem::Row& solved = sweeps_.row(r);
      const bool hasForce = solved.normalForce != 0 || solved.tangentForce != 0;
      perRow_[r] = 0;
      // Without a force a row is open, unless no node of it can move.
      if (!hasForce && solved.normalResponse > 0) continue;
      const double tolerated = near_[r].gap - solved.gap;
      perRow_[r] = -(sweeps_.gapAfter(solved) + tolerated);
      if (!hasForce) continue;
      balanceFriction(near_[r], solved, before);
      ContactRow& row = kept.emplace_back(rowOf(near_[r], surfaces, model.nodes, step));
      row.toleratedGap = tolerated;
      row.normalForce = solved.normalForce, row.tangentForce = solved.tangentForce;
    }
  };
  listInParts(near_.size(), step.threads, rowParts_, rows_, list);
  for (const double depth : perRow_) now_.maxPenetration = std::max(now_.maxPenetration, depth);
}

/// Friction acts at the slave, and against it at the foot: with a gap between them at xⁿ it has a
/// moment. The normal forces have the opposite one if the foot is moved along the side. The gap
/// changes by the second order only.
void Contact::balanceFriction(NearRow& near, const RowSystem::Row& solved,
                              const PieceGeometry& before) const {
  if (solved.tangentForce == 0 || !(solved.normalForce > 0)) return;
  const MovingPiece& piece = finder_.piece(near.master);
  const double length =
      piece.isArc != 0 ? norm(before.tangent(near.master, near.xi)) : piece.length;
  near.xi -= near.before * solved.tangentForce / solved.normalForce / length;
}

/// Moves the nodes from x* to x* + u, with the velocities of that.
void Contact::move(Model& model, const ContactStep& step) {
  const StageTimer timer(step.times, &StageTimes::correction);
  sumForces();
  const double squared = step.length.squared();
  double largest = 0;
  for (const NodeId node : touched_) {
    if (isOfRigid(node, step)) continue;
    const Vec2 mobile = mobility(model.nodes, node, step.drag);
    const Vec2 force = forces_[node.value];
    const Vec2 u{squared * mobile.x * force.x, squared * mobile.y * force.y};
    model.nodes.position[node.value] += u;
    model.nodes.velocity[node.value] += (1 / step.length.position) * u;
    largest = std::max(largest, dot(u, u));
  }
  moveRigid(model, step, largest);
  const double own = std::sqrt(largest);
  now_.largestCorrection += own;
  if (own <= 2 * tolerance::kFarthestMove * step.shortest) return;
  throw RunError(fmt::format(
      "contact moves a surface node by {:g} m, which is many times the shortest segment, "
      "{:g} m; take a shorter step, or slower bodies.",
      own, step.shortest));
}

/// Eq. 7: Fᵢ = Σ weight × force of the rows.
void Contact::sumForces() {
  for (const ContactRow& row : rows_) {
    const Vec2 force = row.force();
    for (int k = 0; k < row.count; ++k) {
      const auto at = static_cast<std::size_t>(k);
      const NodeId node = row.node[at];
      if (isTouched_[node.value] == 0) touched_.push_back(node);
      isTouched_[node.value] = 1;
      forces_[node.value] += row.weight[at] * force;
    }
  }
}

/// Sets the data for the next step.
void Contact::finish(const ContactStep& step) {
  formerTouches_.clear();
  for (const ContactRow& row : rows_)
    formerTouches_.push_back(
        {{row.slave, row.master}, row.normalForce, row.tangentForce, row.toleratedGap});
  touches.swap(formerTouches_);
  travelled_ += step.move + now_.largestCorrection;
  isFinished_ = true;
}

}  // namespace yadefrag
