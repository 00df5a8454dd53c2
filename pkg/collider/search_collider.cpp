#include "collider/search_collider.hpp"

#include <omp.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "collider/error_messages.hpp"
#include "core/parallel.hpp"
#include "core/tolerances/collider.hpp"
#include "entries/surface_segment.hpp"
#include "fe/running.hpp"
#include "search/contact_search.hpp"
#include "search/periodic_overlap.hpp"

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
  const int threads = threadsToUse();
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

int SearchCollider::threadsToUse() const {
  const int most = omp_get_max_threads();
  return ompThreads > 0 ? std::min(ompThreads, most) : most;
}

/// A negative verletDist is a multiple of the smallest radius. Without any sphere it is kept for
/// later. (YADE would set it to 0 permanently; a scene that a factory fills would then be searched
/// at every step.)
void SearchCollider::chooseVerletDist() {
  if (!std::isfinite(verletDist)) throwBadVerletDist(getClassName(), verletDist);
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

std::vector<BoxPair> SearchCollider::entryPairs() {
  const std::vector<std::uint8_t>& isSegment = boxes_.isSegment();
  if (isSegment.empty()) return {};
  std::vector<Box> boxes(boxes_.boxes().begin(), boxes_.boxes().end());
  for (std::size_t id = 0; id < boxes.size(); ++id)
    if (id >= isSegment.size() || isSegment[id] == 0) boxes[id] = Box::absent();
  std::vector<BoxPair> pairs = overlappingPairs(boxes);
  const auto& bodies = scene->bodies->body;
  std::erase_if(pairs, [&](const BoxPair& pair) {
    const Body *first = bodies[pair.first.value].get(), *second = bodies[pair.second.value].get();
    if (!first || !second || !mayMeet(first, second)) return true;
    const auto& a = static_cast<const SurfaceSegment&>(*first->shape);
    const auto& b = static_cast<const SurfaceSegment&>(*second->shape);
    // Pieces created by scripts are one rigid body.
    return a.component == b.component && !(a.component >= 0 && a.selfContact);
  });
  return pairs;
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
  if (meets.kind == PeriodicOverlap::kTooLarge)
    throwTooLarge(meets.secondTooLarge ? pair.second.value : pair.first.value, meets.axis,
                  rules.size[static_cast<std::size_t>(meets.axis)]);
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

/// Bodies whose present bounds, without sweeps, overlap `bound`.
yade::vector<Body::id_t> SearchCollider::probeBoundingVolume(const yade::Bound& bound) {
  if (periodic_)
    throw std::invalid_argument(getClassName() +
                                ".probeBoundingVolume: not possible in a periodic scene.");
  yade::vector<Body::id_t> found;
  if (!search_ || boxes_.boxes().empty()) return found;
  std::vector<BoxId> near;
  search_->findOverlaps(
      {{bound.min[0], bound.min[1], bound.min[2]}, {bound.max[0], bound.max[1], bound.max[2]}},
      near);
  for (const BoxId id : near) {
    const auto& bodies = scene->bodies->body;
    if (id.value >= bodies.size() || !bodies[id.value] || !bodies[id.value]->bound) continue;
    const Body& body = *bodies[id.value];
    const Vector3r sweep = Vector3r::Constant(body.bound->sweepLength);
    const Vector3r moved = body.state->se3.position - body.bound->refPos;
    const Vector3r low = body.bound->min + sweep + moved;
    const Vector3r high = body.bound->max - sweep + moved;
    if ((low.array() <= bound.max.array()).all() && (high.array() >= bound.min.array()).all())
      found.push_back(body.getId());
  }
  std::sort(found.begin(), found.end());
  return found;
}

void SearchCollider::pySetAttr(const yade::string& key, const yade::py::object& value) {
  if (key == "newton")
    newton = yade::py::extract<yade::shared_ptr<yade::NewtonIntegrator>>(value)();
  else
    Collider::pySetAttr(key, value);
}

yade::py::dict SearchCollider::pyDict() const {
  yade::py::dict result = Collider::pyDict();
  result["newton"] = newton;
  return result;
}

}  // namespace yadefrag
