// Second part of search_collider: a search of changed bodies only.

#include <algorithm>

#include "collider/search_collider.hpp"
#include "core/tolerances/collider.hpp"

namespace yadefrag {

using yade::Body;
using yade::Vector3r;

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

}  // namespace yadefrag
