// Second part of search_collider: a search of those bodies only that changed.

#include <algorithm>

#include "collider/search_collider.hpp"
#include "core/tolerances/collider.hpp"

namespace yadefrag {

using yade::Body;
using yade::Vector3r;

/// True if what the last search found still stands for bodies that stayed where they were.
bool SearchCollider::mayKeep() const {
  return keptWith_ == choices() && search_ && strideActive_ && !doSort &&
         !scene->interactions->dirty && !scene->isPeriodic && !periodic_ && verletDist > 0 &&
         targetInterv > 0 && searchCounts_ == countComparisons &&
         interactions_.madeByOthers(*scene) <= 0;
}

/// False if so many have changed that all have to be searched.
bool SearchCollider::searchChanged(int threads) {
  SweepRule rule = chooseSweeps();
  const double soon = tolerance::kLookAhead * interval;
  rule.lookAhead = soon * scene->dt;
  // Where bodies come at every step, the others are looked at now and then only.
  const bool quick = quickLook_ && static_cast<double>(scene->iter - lastLook_) < soon;
  const auto most = static_cast<std::size_t>(std::max(workLeft() / tolerance::kChangeWork, 0.));
  if (!boxes_.prepareChanged(*scene, *boundDispatcher, rule, most, quick, threads)) return false;
  // Bodies that were erased took their interactions with them. Any other that is gone would have to
  // be made again.
  if (interactions_.madeByOthers(*scene) < 0 && !someErased()) return false;
  const Comparisons before = search_->comparisons();
  search_->setThreads(threads);
  search_->change(boxes_.boxes(), boxes_.changed());
  findPairs([this] { search_->findPairsOfChanged(pairs_); });
  comparisons = static_cast<long>(search_->comparisons().total() - before.total());
  comparisonsTotal += comparisons;
  const std::size_t pairsOfHalf = pairsOfHalf_;
  searched = static_cast<long>(boxes_.changed().size());
  findNeighbours(threads);
  pairsOfHalf_ = pairsOfHalf;  // that of all
  boxes_.commit(*scene, threads);
  interactions_.applyChanged(
      *scene, near_, boxes_.changed(),
      [this](const Body* a, const Body* b) { return mayCollide(a, b, scene->subdomain); },
      [this](Body::id_t id1, Body::id_t id2) { return isStillNear(id1, id2); });
  if (!quick) lastLook_ = scene->iter;
  searchedSinceAll_ += boxes_.changed().size();
  countWork(quick ? 0 : static_cast<double>(boxes_.boxes().size()),
            static_cast<double>(boxes_.changed().size()), halvesOfChanged());
  return true;
}

/// When those that changed have cost as much work as a search of all, all are searched: no order of
/// events can make this cost more than twice the cheaper of the two.
double SearchCollider::workLeft() const {
  return static_cast<double>(scene->bodies->body.size()) -
         tolerance::kChangeWork * static_cast<double>(searchedSinceAll_);
}

/// How often a searched body has a neighbour that is near only because sweeps are not half as long.
double SearchCollider::halvesOfChanged() const {
  const auto& changed = boxes_.changed();
  const auto isChanged = [&](Body::id_t id) {
    return std::binary_search(changed.begin(), changed.end(), BoxId(static_cast<std::size_t>(id)));
  };
  double halves = 0;
  for (const Neighbours& pair : near_)
    if (!pair.nearByHalf) halves += isChanged(pair.first) + isChanged(pair.second);
  return halves;
}

bool SearchCollider::someErased() const {
  const auto& bodies = scene->bodies->body;
  const auto& changed = boxes_.changed();
  return std::any_of(changed.begin(), changed.end(), [&](BoxId id) { return !bodies[id.value]; });
}

bool SearchCollider::isStillNear(Body::id_t id1, Body::id_t id2) const {
  const BoxPair pair{BoxId(static_cast<std::size_t>(id1)), BoxId(static_cast<std::size_t>(id2))};
  Neighbours unused;
  return overlaps(boxes_.boxes()[pair.first.value], boxes_.boxes()[pair.second.value]) &&
         isNear(pair, Halo(boxes_.balls(), 0), unused);
}

}  // namespace yadefrag
