#include "step/search_schedule.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/tolerances/contact.hpp"
#include "core/tolerances/dynamics.hpp"
#include "core/tolerances/step.hpp"
#include "step/state.hpp"

namespace yadefrag {

double shortestSegment(const Model& model, const ContactSurfaces& surfaces,
                       std::span<const Vec2> positions) {
  const bool anyRigid = std::ranges::any_of(model.components, &Component::rigid);
  double least = INFINITY;
  for (std::size_t s = 0; s < surfaces.segments(); ++s) {
    if (surfaces.isGone(SegmentId(s))) continue;
    const ComponentId owner = surfaces.component[surfaces.segmentEntry[s].value];
    if (anyRigid && model.components[owner.value].rigid) continue;
    const NodeId a = surfaces.segmentNode[s];
    const NodeId b = surfaces.segmentNode[surfaces.segmentNext[s].value];
    const Vec2 along = positions[b.value] - positions[a.value];
    least = std::min(least, dot(along, along));
  }
  return std::isfinite(least) ? std::sqrt(least) : 0;
}

void SearchSchedule::rebuild(const StepData& data) {
  if (isVoid() && data.scratch.canTouch) watchAll(data);
  const SearchBounds bounds = std::exchange(loaded, {});
  if (data.scratch.canTouch) {
    // A loaded state may crack before its first search.
    passRule_.update(data.state.surfaces, data.state.model.nodes.reference,
                     data.settings.contactSettings, !data.scratch.rigidNodes.empty());
  } else {
    // There will be no search, but bounds for a collider, which watches them by itself.
    shortest = data.scratch.finest;
    halo = tolerance::kNarrowestHalo * shortest;
  }
  data.scratch.dynamics.setSpeedLimit(data.scratch.canTouch ? bounds.speed : tolerance::kMostSpeed);
  search_.reset();
  data.state.contact.candidates.index(data.state.surfaces.entries());
  motion_.farthest = bounds.farthest;
}

void SearchSchedule::invalidate() {
  nodes.clear();
  positions.clear();
  makeVoid();
  loaded = {};
}

void SearchSchedule::begin() {
  former_.motion = motion_;
  former_.hasSearched = former_.hasCandidates = false;
  former_.candidates.clear();
}

/// Stores the state before the step changes the checked nodes or the candidates.
void SearchSchedule::keep() {
  if (former_.hasSearched) return;
  former_.search = *this;
  former_.hasSearched = true;
}

void SearchSchedule::undo(Contact& contact) {
  if (former_.hasSearched && !former_.hasCandidates) search_.reset();  // it may be incomplete
  if (former_.hasCandidates) contact.candidates = std::move(former_.candidates);
  if (former_.hasSearched) std::swap(static_cast<SearchState&>(*this), former_.search);
  motion_ = former_.motion;
}

void SearchSchedule::watchAll(const StepData& data) {
  nodes.clear();
  for (const NodeId node : data.state.surfaces.segmentNode)
    if (data.state.model.nodes.mass[node.value] > 0) nodes.push_back(node);
  std::sort(nodes.begin(), nodes.end());
}

/// Bounds of the displacements, before the step moves nodes.
void SearchSchedule::boundMotion(const StepData& data, double dt) {
  if (!data.scratch.canTouch) return;
  const StageTimer timer(data.times(), &StageTimes::search);
  const double most = data.scratch.dynamics.speedLimit() * dt;
  motion_.isQuiet = data.state.contact.candidates.size() == 0 && !isDue() &&
                    data.state.fracture.cohesion.edge.empty() &&
                    motion_.farthest + most <= halo / 2 &&
                    most <= tolerance::kFarthestMove * data.scratch.finest;
}

/// Uses x*. If no node is faster than predicted, a quiet step needs no check of the nodes.
void SearchSchedule::measureMove(const StepData& data, double dt) {
  const StageTimer timer(data.times(), &StageTimes::search);
  if (data.scratch.dynamics.anyAboveSpeedLimit()) {
    updateSpeedLimit(data, dt);
    motion_.isQuiet = false;
  } else {
    motion_.most = data.scratch.dynamics.speedLimit() * dt;
  }
  if (motion_.isQuiet) {
    motion_.largest = motion_.most;
  } else {
    double most = 0;
    const std::span<const Vec2> before = data.scratch.dynamics.previousPosition();
    for (const NodeId node : nodes) {
      const Vec2 moved = data.state.model.nodes.position[node.value] - before[node.value];
      most = std::max(most, dot(moved, moved));
    }
    motion_.largest = std::sqrt(most);
  }
  motion_.farthest += motion_.largest;
}

/// Determines the largest speed of all nodes, and sets the limit that the next steps check.
void SearchSchedule::updateSpeedLimit(const StepData& data, double dt) {
  double most = 0;
  for (const Vec2 velocity : data.state.model.nodes.velocity)
    most = std::max(most, dot(velocity, velocity));
  most = std::sqrt(most);
  motion_.most = most * dt;
  data.scratch.dynamics.setSpeedLimit(
      std::min(tolerance::kSpeedSpare * most, tolerance::kMostSpeed));
}

/// Predicts whether the next step may leave the halo.
void SearchSchedule::foreseeSearch(const StepData& data, double dt) {
  if (isDue()) return;
  const StageTimer timer(data.times(), &StageTimes::search);
  const double most = motion_.largest + data.state.contact.largestCorrection();
  if (motion_.farthest + tolerance::kHaloSpare * most <= halo / 2) return;
  double farthest = 0;
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    const std::uint32_t node = nodes[i].value;
    const double moved = norm(data.state.model.nodes.position[node] - positions[i]);
    farthest = std::max(farthest, moved);
    const double next = tolerance::kHaloSpare * norm(data.state.model.nodes.velocity[node]) * dt;
    if (moved + next > halo / 2) return makeDue();
  }
  motion_.farthest = farthest;
}

/// (m) δ for the next kHaloSteps steps with displacements of `move` (m), at most half the shortest
/// segment (§4.1), or the given value; wider only for bodies so fast that they would leave it at
/// once.
double SearchSchedule::wideHalo(const ContactSettings& settings, double move) const {
  const double wanted = settings.halo > 0 ? settings.halo * shortest
                                          : std::clamp(tolerance::kHaloSteps * move,
                                                       tolerance::kNarrowestHalo * shortest,
                                                       tolerance::kWidestHalo * shortest);
  return std::max(wanted, 2 * move);
}

/// As wide as this step's own displacement demands.
void SearchSchedule::chooseHalo(const StepData& data) {
  shortest =
      shortestSegment(data.state.model, data.state.surfaces, data.state.model.nodes.position);
  halo = wideHalo(data.settings.contactSettings, 2 * tolerance::kHaloSpare * motion_.largest);
}

void SearchSchedule::considerPairs(const StepData& data, std::span<const BoxPair> overlapping) {
  passRule_.update(data.state.surfaces, data.state.model.nodes.reference,
                   data.settings.contactSettings, !data.scratch.rigidNodes.empty());
  pairs_.clear();
  selectPairs(data.state.model, data.state.surfaces, passRule_, data.state.model.nodes.position,
              halo, overlapping, pairs_);
  former_.candidates =
      replaceCandidates(data.state.contact.candidates, pairs_, data.state.surfaces.entries());
  former_.hasCandidates = true;
  positions.resize(nodes.size());
  for (std::size_t i = 0; i < nodes.size(); ++i)
    positions[i] = data.state.model.nodes.position[nodes[i].value];
  motion_.farthest = 0;
  validity = Validity::kValid;
  ++count;
  // If all nodes are checked in every step, no bound of their speed is needed.
  if (data.state.contact.candidates.size() > 0)
    data.scratch.dynamics.setSpeedLimit(tolerance::kMostSpeed);
}

/// No contact is missed: independently of predictions, x* is decisive.
void SearchSchedule::searchIfLeft(const StepData& data, double dt) {
  const StageTimer timer(data.times(), &StageTimes::search);
  if (isDue()) return searchNow(data, dt);
  if (motion_.farthest <= halo / 2) return;
  double most = 0;
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    const Vec2 moved = data.state.model.nodes.position[nodes[i].value] - positions[i];
    most = std::max(most, dot(moved, moved));
  }
  motion_.farthest = std::sqrt(most);
  if (!(motion_.farthest <= halo / 2)) searchNow(data, dt);
}

/// The search, at x*: boxes of all entries, update of the position codes, pairs.
void SearchSchedule::searchNow(const StepData& data, double dt) {
  keep();
  chooseHalo(data);
  updateSpeedLimit(data, dt);
  // The pairs are sorted later, so that their order does not matter.
  if (!search_) search_ = makeSearch(SearchMethod::kFastest);
  boxes_.resize(data.state.surfaces.entries());
  for (std::size_t e = 0; e < boxes_.size(); ++e) {
    boxes_[e] =
        data.state.surfaces.isGone(EntryId(e))
            ? Box::absent()
            : entryBox(data.state.surfaces, data.state.model.nodes.position, EntryId(e), halo);
  }
  search_->setThreads(data.settings.threads);
  search_->update(boxes_);
  overlapping_.clear();
  search_->findPairs(overlapping_);
  considerPairs(data, overlapping_);
}

void SearchSchedule::addCorrection(double most) { motion_.farthest += most; }

void SearchSchedule::appear(NodeId node, Vec2 place) {
  nodes.push_back(node);
  positions.push_back(place);
}

void SearchSchedule::removeDropped(const Model& model) {
  std::size_t kept = 0;
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    if (model.nodes.mass[nodes[i].value] == 0) continue;
    nodes[kept] = nodes[i];
    positions[kept++] = positions[i];
  }
  nodes.resize(kept);
  positions.resize(kept);
}

void SearchSchedule::addCandidatesAround(const StepData& data, std::span<const SurfaceSide> sides) {
  const std::vector<Vec2>& places = data.state.model.nodes.position;
  data.state.contact.candidates.index(data.state.surfaces.entries());
  const std::vector<EntryId> around =
      entriesAround(data.state.surfaces, data.state.contact.candidates, sides);
  pairs_.clear();
  selectPairs(data.state.model, data.state.surfaces, passRule_, places, halo,
              overlapsAmong(data.state.surfaces, places, around, halo), pairs_);
  addCandidates(data.state.contact.candidates, pairs_, around);
}

}  // namespace yadefrag
