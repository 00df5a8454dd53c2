// The world's part in contact: when to search, whom to ask, what to book.

#include <algorithm>
#include <cmath>

#include "core/tolerances/contact.hpp"
#include "core/tolerances/dynamics.hpp"
#include "core/tolerances/step.hpp"
#include "step/entry_pairs.hpp"
#include "step/world.hpp"
#include "surface/piece_geometry.hpp"

namespace yadefrag {

namespace {

/// (m) Of those from `first` on that are no rigid boundary's; 0 without any.
double shortestSegment(const Model& model, const ContactSurfaces& surfaces,
                       std::span<const Vec2> positions, SegmentId first = SegmentId(0)) {
  const bool anyRigid = std::ranges::any_of(model.components, &Component::rigid);
  double least = INFINITY;
  for (std::size_t s = first.value; s < surfaces.segments(); ++s) {
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

}  // namespace

double World::finestSegment() const { return shortestSegment(model, surfaces, reference); }

/// One body that cannot touch itself needs neither search nor candidates.
bool World::canTouch() const {
  const std::vector<ComponentId>& owners = surfaces.component;
  if (owners.empty()) return false;
  return model.components[owners.front().value].selfContact || severalBodies_;
}

double World::fastest(SegmentId first) const {
  double most = 0;
  for (const NodeId node : std::span(surfaces.segmentNode).subspan(first.value)) {
    const Vec2 velocity = model.nodes.velocity[node.value];
    most = std::max(most, dot(velocity, velocity));
  }
  return std::sqrt(most);
}

Box World::boxOf(EntryId entry) const {
  if (surfaces.isGone(entry)) return Box::absent();
  return entryBox(surfaces, model.nodes.position, entry, search.halo);
}

/// (m) δ for the next kHaloSteps steps of `move` (m), at most half the shortest segment (§4.1), or
/// as set; only bodies so fast that they would leave it at once get a wider one.
double World::wideHalo(double move) const {
  const double wanted =
      contactSettings.halo > 0
          ? contactSettings.halo * search.shortest
          : std::clamp(tolerance::kHaloSteps * move, tolerance::kNarrowestHalo * search.shortest,
                       tolerance::kWidestHalo * search.shortest);
  return std::max(wanted, 2 * move);
}

void World::chooseHalo(double dt, SegmentId first) {
  const double shortest = shortestSegment(model, surfaces, model.nodes.position, first);
  search.shortest = first.value == 0 ? shortest : std::min(search.shortest, shortest);
  motion_.fastest = first.value == 0 ? fastest(first) : std::max(motion_.fastest, fastest(first));
  const double fast = wideHalo(2 * tolerance::kHaloSpare * motion_.fastest * dt);
  // A step that needs more is refused; until then not all pairs shall become candidates.
  const double most = 4 * tolerance::kHaloSpare * tolerance::kFarthestMove * search.shortest;
  search.halo = std::min(fast, most);
}

void World::takePairs(std::span<const BoxPair> overlapping) {
  buildIfChanged();
  if (!canTouch()) {
    search.isDue = search.isVoid = false;
    return;
  }
  watchSpeed(lastDt);
  chooseWatched();
  considerPairs(overlapping, model.nodes.position);
}

/// `before`: m, by node, at the end of the last step.
void World::considerPairs(std::span<const BoxPair> overlapping, std::span<const Vec2> before) {
  passRule_.update(surfaces, reference, contactSettings.passes, hasRigid());
  pairs_.clear();
  selectPairs(model, surfaces, passRule_, model.nodes.position, search.halo, overlapping, pairs_);
  undo_.candidates = replaceCandidates(contact.candidates, pairs_, surfaces, before,
                                       contactSettings.entry == Entry::kFlags);
  undo_.hasCandidates = true;
  search.positions.resize(search.nodes.size());
  for (std::size_t i = 0; i < search.nodes.size(); ++i)
    search.positions[i] = model.nodes.position[search.nodes[i].value];
  motion_.farthest = 0;
  search.isDue = search.isVoid = false;
  ++numSearches;
  // Where all nodes are watched in every step, no bound on their speed is needed.
  if (!apart_.any() && contact.candidates.size() > 0) dynamics_.watchSpeed(tolerance::kAnySpeed);
}

/// Nothing is missed: whatever was foreseen, x* itself decides.
void World::searchIfLeft(double dt) {
  const StageTimer timer(timesIfAsked(), &StageTimes::search);
  if (search.isDue || search.isVoid) return searchNow(dt);
  if (motion_.farthest <= search.halo / 2) return;
  double most = 0;
  for (std::size_t i = 0; i < search.nodes.size(); ++i) {
    const Vec2 moved = model.nodes.position[search.nodes[i].value] - search.positions[i];
    most = std::max(most, dot(moved, moved));
  }
  motion_.farthest = std::sqrt(most);
  if (!(motion_.farthest <= search.halo / 2)) searchNow(dt);
}

/// The world's own search, at x*: all boxes but of bodies that are apart, position codes moved,
/// pairs.
void World::searchNow(double dt) {
  keepSearch();
  // As wide as the collider's would be, and at least as wide as this step's own motion.
  if (apart_.any()) {
    chooseHalo(dt);
  } else {
    search.shortest = shortestSegment(model, surfaces, model.nodes.position);
    search.halo = wideHalo(2 * tolerance::kHaloSpare * motion_.largest);
  }
  watchSpeed(dt);
  chooseWatched();
  if (!search_) search_ = makeSearch(SearchMethod::kLebesgue);
  boxes_.resize(surfaces.entries());
  for (std::size_t e = 0; e < boxes_.size(); ++e)
    boxes_[e] = apart_.isApart(surfaces.component[e]) ? Box::absent() : boxOf(EntryId(e));
  search_->setThreads(threads);
  search_->update(boxes_);
  overlapping_.clear();
  search_->findPairs(overlapping_);
  considerPairs(overlapping_, dynamics_.previousPosition());
}

void World::correctContact(const StepLength& length) {
  const ContactStep now{length,
                        dynamicsSettings.drag(length),
                        motion_.largest,
                        2 * motion_.largest + tolerance::kTouching * finest_,
                        finest_,
                        tolerance::kWidestHalo * finest_ + 2 * motion_.largest,
                        dynamics_.previousPosition(),
                        threads,
                        fracture.numCracks() > 0,
                        timesIfAsked()};
  undo_.hasCorrected = true;
  contact.correct(model, surfaces, contactSettings, now);
  motion_.farthest += contact.largestCorrection();
  apart_.comeNearer(2 * contact.largestCorrection());
}

void World::bookContact(const StepLength& length) {
  const StageTimer timer(timesIfAsked(), &StageTimes::correction);
  const std::span<const Vec2> former = dynamics_.previousVelocity();
  for (const ContactRow& row : contact.rows()) {
    const Vec2 mean = .5 * (relative(row, former) + relative(row, model.nodes.velocity));
    ledger.contact -= row.normalForce * dot(mean, row.normal) * length.velocity;
    ledger.friction -= row.tangentForce * dot(mean, row.tangent()) * length.velocity;
  }
}

}  // namespace yadefrag
