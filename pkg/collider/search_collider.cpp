#include "collider/search_collider.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <tuple>

#include "core/errors.hpp"
#include "core/parallel.hpp"
#include "core/tolerances/collider.hpp"
#include "materials/surface_segment.hpp"
#include "search/periodic.hpp"
#include "yade/helpers.hpp"
#include "yade/running.hpp"

namespace yadefrag {

using yade::Body;
using yade::Vector3r;

namespace {

std::array<Lattice::Vector, 3> periodsOf(const yade::Cell& cell) {
  std::array<Lattice::Vector, 3> periods{};
  for (int i = 0; i < 3; ++i)
    for (int axis = 0; axis < 3; ++axis) periods[i][axis] = cell.hSize(axis, i);
  return periods;
}

}  // namespace

/// One search. The scene is not changed before every body has been checked.
void SearchCollider::action() try {
  const int threads = threadsOf(*this);
  const auto before = std::tuple(verletDist, interval, lastIter_);
  try {
    chooseVerletDist();
    chooseInterval();
    if (!mayKeep() || !searchChanged(threads)) {
      boxes_.rollBack();
      searchAll(threads);
    }
  } catch (...) {
    std::tie(verletDist, interval, lastIter_) = before;
    boxes_.rollBack();
    search_.reset();  // its boxes are no longer those of the last search
    near_ = {};       // there may be too many
    keptWith_.reset();
    strideActive_ = onlySegments_ = false;
    throw;
  }
  sceneIsSearched();
} catch (const std::exception& error) {
  noteStop(error.what());
  throw;
}

void SearchCollider::searchAll(int threads) {
  const SweepRule rule = chooseSweeps();  // also sets slack_
  boxes_.prepare(*scene, *boundDispatcher, rule, slack_, threads);
  startSearchIfNeeded();
  updateSearch(threads);
  removeSegmentPairs();
  const double halves = keepNear(threads, [](const BoxPair&) { return 2; });
  boxes_.commit(*scene, threads);
  interactions_.apply(
      *scene, near_, boxes_.boxes(), [this](const Body* a, const Body* b) { return mayMeet(a, b); },
      threads);
  keptWith_ = choices();
  lastCheck_ = scene->iter;
  searchedSinceAll_ = 0;
  const auto bodies = static_cast<double>(scene->bodies->body.size());
  countWork(bodies, bodies, halves);
}

/// True if the results of the last search are still valid for bodies that did not move.
bool SearchCollider::mayKeep() const {
  return keptWith_ == choices() && search_ && strideActive_ && !doSort &&
         !scene->interactions->dirty && !scene->isPeriodic && !periodic_ && verletDist > 0 &&
         targetInterv > 0 && searchCounts_ == countComparisons &&
         interactions_.madeByOthers(*scene) <= 0;
}

/// Returns false if so many bodies have changed that all must be searched.
bool SearchCollider::searchChanged(int threads) {
  SweepRule rule = chooseSweeps();
  const double soon = tolerance::kLookAhead * interval;
  rule.lookAhead = soon * scene->dt;
  // If bodies are added at every step, the others are checked once in that time only.
  const bool quick = quickCheck_ && static_cast<double>(scene->iter - lastCheck_) < soon;
  const auto most =
      static_cast<std::size_t>(std::max(remainingWork() / tolerance::kChangeWork, 0.));
  if (!boxes_.prepareChanged(*scene, *boundDispatcher, rule, most, quick, threads)) return false;
  // The interactions of erased bodies were erased with them. If any other interaction was erased,
  // it may have to be created again by a full search.
  if (interactions_.madeByOthers(*scene) < 0 && !someErased()) return false;
  const Comparisons before = search_->comparisons();
  search_->setThreads(threads);
  search_->change(boxes_.boxes(), boxes_.changed());
  findPairs([this] { search_->findPairsOfChanged(near_.pairs); });
  comparisons = static_cast<long>(search_->comparisons().total() - before.total());
  comparisonsTotal += comparisons;
  searched = static_cast<long>(boxes_.changed().size());
  const auto& changed = boxes_.changed();
  const auto isChanged = [&](BoxId id) {
    return std::binary_search(changed.begin(), changed.end(), id) ? 1 : 0;
  };
  const double halves = keepNear(
      threads, [&](const BoxPair& pair) { return isChanged(pair.first) + isChanged(pair.second); });
  boxes_.commit(*scene, threads);
  interactions_.applyChanged(
      *scene, near_, boxes_.boxes(), boxes_.changed(),
      [this](const Body* a, const Body* b) { return mayMeet(a, b); },
      [this](Body::id_t id1, Body::id_t id2) { return isStillNear(id1, id2); });
  if (!quick) lastCheck_ = scene->iter;
  searchedSinceAll_ += boxes_.changed().size();
  countWork(quick ? 0 : static_cast<double>(boxes_.boxes().size()),
            static_cast<double>(boxes_.changed().size()), halves);
  return true;
}

/// All bodies are searched when the searches of changed bodies have cost as much as a full search.
/// For any sequence of events the cost is then at most twice that of the cheaper method.
double SearchCollider::remainingWork() const {
  return static_cast<double>(scene->bodies->body.size()) -
         tolerance::kChangeWork * static_cast<double>(searchedSinceAll_);
}

bool SearchCollider::someErased() const {
  const auto& bodies = scene->bodies->body;
  const auto& changed = boxes_.changed();
  return std::any_of(changed.begin(), changed.end(), [&](BoxId id) { return !bodies[id.value]; });
}

bool SearchCollider::isStillNear(Body::id_t id1, Body::id_t id2) const {
  const BoxPair pair{BoxId(static_cast<std::size_t>(id1)), BoxId(static_cast<std::size_t>(id2))};
  Nearness unused;
  return overlaps(boxes_.boxes()[pair.first.value], boxes_.boxes()[pair.second.value]) &&
         isNear(pair, SphereReach(boxes_.balls(), 0), unused);
}

/// A negative verletDist is a multiple of the smallest radius. Without any sphere it is kept for
/// later. (YADE would set it to 0 permanently; a scene that a factory fills would then be searched
/// at every step.)
void SearchCollider::chooseVerletDist() {
  if (!std::isfinite(verletDist))
    throw InputError(fmt::format(
        "{}.verletDist is {:g}: it must be a length in m, 0, or minus a multiple of the smallest "
        "radius.",
        getClassName(), verletDist));
  if (verletDist >= 0) return;
  double least = INFINITY;
  for (const auto& body : scene->bodies->body) {
    if (!body || !body->shape) continue;
    if (const auto* sphere = dynamic_cast<const yade::Sphere*>(body->shape.get()))
      least = std::min(least, sphere->radius);
  }
  if (least < INFINITY) verletDist *= -least;
}

void SearchCollider::chooseInterval() {
  const auto bodies = static_cast<double>(scene->bodies->body.size());
  if (targetInterv <= 0 || !adaptInterval || !(interval > 0)) interval = targetInterv;
  counts_.addSteps(static_cast<double>(scene->iter - lastIter_));
  if (targetInterv > 0 && adaptInterval && sweepsEnded_ && trueHalo &&
      counts_.isRound(interval, bodies))
    interval = counts_.next(interval, bodies);
  lastIter_ = scene->iter;
}

/// `halves` counts a pair twice if both its bodies were searched.
void SearchCollider::countWork(double checked, double searchedNow, double halves) {
  searched = static_cast<long>(searchedNow);
  searchedTotal += searched;
  if (sweepsEnded_) counts_.add(checked, searchedNow, halves);
  sweepsEnded_ = quickCheck_ = false;
}

/// Permitted displacements of bodies, and of neighbours by the cell's deformation, before the next
/// search.
SweepRule SearchCollider::chooseSweeps() {
  lattice_.reset();
  if (scene->isPeriodic) lattice_.emplace(periodsOf(*scene->cell));
  slack_ = cellSlack();
  SweepRule rule(std::max(verletDist, 0.), minSweepDistFactor, scene->dt, interval);
  if (lattice_) rule.shortestPeriod = lattice_->shortest();
  return rule;
}

/// Margin for the cell's deformation within the interval for which the bodies' sweeps are made.
double SearchCollider::cellSlack() const {
  if (!scene->isPeriodic || !(verletDist > 0) || targetInterv <= 0) return 0;
  const yade::Cell& cell = *scene->cell;
  const Vector3r span = cellSpan() + Vector3r::Ones();
  const Vector3r speed = (cell.velGrad * cell.hSize).cwiseAbs() * span;
  const double wanted = .5 * tolerance::kSweepSpare * interval * scene->dt * speed.maxCoeff();
  return std::min(wanted < verletDist ? wanted : verletDist, lattice_->shortest() / 16);
}

/// Largest distance of two neighbours in cells: in a sheared cell it exceeds that of their boxes.
Vector3r SearchCollider::cellSpan() const {
  Vector3r span;
  for (int axis = 0; axis < 3; ++axis)
    span[axis] = images_.span()[axis] + std::floor(lattice_->reach()[axis]);
  return span;
}

void SearchCollider::startSearchIfNeeded() {
  if (search_ && searchCounts_ == countComparisons && !doSort && !scene->interactions->dirty &&
      periodic_ == scene->isPeriodic)
    return;
  if (!search_ || searchCounts_ != countComparisons) {
    // The paper's counts are those of the method itself.
    const bool isFree = method_ == SearchMethod::kLebesgue && !countComparisons;
    search_ = std::make_unique<IncrementalSearch>(isFree ? SearchMethod::kFastest : method_,
                                                  countComparisons);
    searchCounts_ = countComparisons;
  }
  search_->clear();
  ++numReinit;
}

void SearchCollider::updateSearch(int threads) {
  const Comparisons before = search_->comparisons();
  search_->setThreads(threads);
  if (scene->isPeriodic) {
    const Vector3r& size = scene->cell->getSize();
    // Twice the tolerance: the exact test below must not be stricter than this one.
    images_.build(boxes_.boxes(), {size[0], size[1], size[2]}, 2 * overlapTolerance);
    search_->update(images_.boxes());
    findPairs([this] { search_->findPairs(near_.pairs); });
    images_.toSlots(near_.pairs);
  } else {
    search_->update(boxes_.boxes());
    findPairs([this] { search_->findPairs(near_.pairs); });
  }
  comparisons = static_cast<long>(search_->comparisons().total() - before.total());
  comparisonsTotal += comparisons;
}

/// FESolver searches these itself.
void SearchCollider::removeSegmentPairs() {
  const std::vector<std::uint8_t>& isSegment = boxes_.isSegment();
  if (isSegment.empty()) return;
  std::erase_if(near_.pairs, [&](const BoxPair& pair) {
    return isSegment[pair.first.value] != 0 && isSegment[pair.second.value] != 0;
  });
}

bool SearchCollider::isNear(const BoxPair& pair, const SphereReach& reach, Nearness& out) const {
  if (!scene->isPeriodic) return !trueHalo || reach.mayTouch(pair, Vector3r::Zero(), out.byHalf);
  const yade::Cell& cell = *scene->cell;
  if (trueHalo && reach.areBalls(pair) && ballsFit(pair)) {
    const auto& balls = boxes_.balls();
    out.cellDist = nearestImage(balls[pair.first.value].centre, balls[pair.second.value].centre);
    return reach.mayTouch(pair, cell.intrShiftPos(out.cellDist), out.byHalf);
  }
  const Vector3r& size = cell.getSize();
  const PeriodicRules rules{{size[0], size[1], size[2]}, overlapTolerance, allowBiggerThanPeriod};
  const PeriodicOverlap meets =
      periodicOverlap(boxes_.boxes()[pair.first.value], boxes_.boxes()[pair.second.value], rules);
  // YADE's text, since scripts may search for it, preceded by the body.
  if (meets.kind == PeriodicOverlap::kTooLarge)
    throw InputError(fmt::format(
        "Body #{} spans over half of the cell size {:g} (axis={}): Body larger than half of the "
        "cell size encountered. See allowBiggerThanPeriod and Cell.flipFlippable.",
        meets.secondTooLarge ? pair.second.value : pair.first.value,
        rules.size[static_cast<std::size_t>(meets.axis)], meets.axis));
  out.cellDist = yade::Vector3i(meets.shift[0], meets.shift[1], meets.shift[2]);
  return meets.kind == PeriodicOverlap::kOverlap;
}

/// A sphere with a radius of up to half the shortest period meets at most one copy of another, the
/// nearest one. (YADE uses the box as the body's size, and refuses small bodies in a strongly
/// sheared cell.)
bool SearchCollider::ballsFit(const BoxPair& pair) const {
  const double longest = 2 * std::max(boxes_.balls()[pair.first.value].radius,
                                      boxes_.balls()[pair.second.value].radius);
  return longest <= .5 * lattice_->shortest();
}

/// The shift of `b`, in whole cells, that brings it nearest to `a`.
yade::Vector3i SearchCollider::nearestImage(const Vector3r& a, const Vector3r& b) const {
  const Vector3r apart = b - a;
  const Lattice::Cells cells = lattice_->nearest({apart[0], apart[1], apart[2]});
  return {cells[0], cells[1], cells[2]};
}

/// Sets the state that YADE expects after a run of a collider.
void SearchCollider::sceneIsSearched() {
  ++numAction;
  doSort = false;
  numBodies_ = scene->bodies->body.size();
  periodic_ = scene->isPeriodic;
  strideActive_ = verletDist > 0;
  onlySegments_ = boxes_.onlySegments();
  keepListsShort = scene->bodies->useRedirection;
  scene->doSort = false;
  scene->interactions->dirty = false;
  scene->interactions->iterColliderLastRun = -1;
  scene->bodies->checkedByCollider = true;
  scene->bodies->insertedBodies.clear();
  scene->bodies->erasedBodies.clear();
  scene->forces.addMaxId(static_cast<Body::id_t>(numBodies_));
  Vector3r span = Vector3r::Zero();
  if (periodic_) span = cellSpan();
  watch_.start(*scene, boxes_, slack_, span);
}

/// Faces of cracks are ignored if all bodies are segments: FESolver handles their contact.
bool SearchCollider::bodiesCame() const {
  const auto& bodies = scene->bodies->body;
  if (!onlySegments_ || bodies.size() < numBodies_) return bodies.size() != numBodies_;
  const auto isOther = [](const yade::shared_ptr<Body>& body) {
    if (!body) return false;
    const auto* segment = dynamic_cast<const SurfaceSegment*>(body->shape.get());
    return !segment || segment->entry < 0;
  };
  return std::any_of(bodies.begin() + static_cast<std::ptrdiff_t>(numBodies_), bodies.end(),
                     isOther);
}

bool SearchCollider::isActivated() {
  if (doSort || scene->interactions->dirty || periodic_ != scene->isPeriodic) return true;
  const bool came = bodiesCame();
  if (onlySegments_) return came || scene->doSort;
  if (!strideActive_) return true;
  newton = MotionWatch::findIntegrator(*scene);
  if (newton) fastestBodyMaxDist = MotionWatch::fastestBody(*scene, *newton);
  sweepsEnded_ = watch_.boundsBroken(*scene);
  quickCheck_ = came && !sweepsEnded_;
  return came || scene->doSort || sweepsEnded_;
}

void SearchCollider::invalidatePersistentData() { doSort = true; }

}  // namespace yadefrag
