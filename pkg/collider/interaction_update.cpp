#include "collider/interaction_update.hpp"

#include <boost/make_shared.hpp>

#include <algorithm>
#include <utility>

#include "core/parallel.hpp"
#include "core/request.hpp"
#include "core/tolerances/collider.hpp"
#include "search/curve_key.hpp"
#include "yade/helpers.hpp"

namespace yadefrag {

using yade::Body;
using yade::Interaction;
using yade::InteractionContainer;

/// True if the searches include the body: it has a box that is updated.
static bool isSearched(const Body* body) { return !body || (body->bound && body->isBounded()); }

namespace {

using Bodies = std::vector<yade::shared_ptr<Body>>;

// Interactions, bodies and the nodes of their maps are scattered in memory: prefetch them in the
// order in which one leads to the next.
constexpr std::size_t kFar = 24, kMiddle = 16, kNear = 8;  // items ahead

void prefetchInteraction(const Interaction* is) {
  const char* at = reinterpret_cast<const char*>(is);
  requestLine(at + offsetof(Interaction, id1));
  requestLine(at + offsetof(Interaction, phys));
}

void prefetchBody(const Body* body) {
  const char* at = reinterpret_cast<const char*>(body);
  requestLine(at + offsetof(Body, groupMask));
  requestLine(at + offsetof(Body, intrs) + sizeof(Body::MapId2IntrT) - 1);
}

void prefetchFirstNode(const Body* body) {
  if (!body->intrs.empty()) requestLine(&*body->intrs.begin());
}

/// For item k of `count`, whose interaction is about to be inserted or erased; `idsOf(k)`: its two
/// bodies.
template <class IdsOf>
void prefetchBodies(const Bodies& bodies, std::size_t k, std::size_t count, const IdsOf& idsOf) {
  const auto both = [&](std::size_t at, auto prefetch) {
    if (at >= count) return;
    const auto [first, second] = idsOf(at);
    for (const Body::id_t id : {first, second})
      if (const Body* body = bodyAt(bodies, id)) prefetch(body);
  };
  both(k + kMiddle, prefetchBody);
  both(k + kNear, prefetchFirstNode);
}

}  // namespace

/// Functors of grids and PFacets insert potential interactions between nodes and connections
/// without a bound. Without boxes their distance is unknown, so that these interactions are always
/// kept. (YADE uses the origin as the box of a body without one.)
bool InteractionUpdate::mayErase(const Interaction& is, const Bodies& bodies) {
  return isSearched(bodyAt(bodies, is.getId1())) && isSearched(bodyAt(bodies, is.getId2()));
}

void InteractionUpdate::apply(yade::Scene& scene, const Neighbours& near,
                              std::span<const Box> boxes, const MayCollide& mayCollide,
                              int threads) {
  InteractionContainer& interactions = *scene.interactions;
  known_.assign(near.size(), 0);
  held_.clear();
  parts_.clear();
  if (interactions.size() > 0) markKnown(interactions, near, scene.bodies->body, threads);
  gone_.clear();
  for (const Part& part : parts_) {
    held_.insert(held_.end(), part.held.begin(), part.held.end());
    gone_.insert(gone_.end(), part.gone.begin(), part.gone.end());
  }
  std::reverse(gone_.begin(), gone_.end());
  eraseGone(scene);
  makeNew(scene, near, boxes, mayCollide);
  sizeAfter_ = interactions.size();
}

/// `gone_` is in descending order of places in YADE's list: erasing moves the last interaction into
/// the gap, and that one must not be among those still to be erased.
void InteractionUpdate::eraseGone(yade::Scene& scene) {
  const auto idsOf = [&](std::size_t k) {
    return std::pair(gone_[k]->getId1(), gone_[k]->getId2());
  };
  for (std::size_t k = 0; k < gone_.size(); ++k) {
    if (k + kFar < gone_.size()) prefetchInteraction(gone_[k + kFar]);
    prefetchBodies(scene.bodies->body, k, gone_.size(), idsOf);
    const Interaction* is = gone_[k];
    scene.interactions->erase(is->getId1(), is->getId2(), is->linIx);
  }
}

void InteractionUpdate::markKnown(InteractionContainer& interactions, const Neighbours& near,
                                  const Bodies& bodies, int threads) {
  partners_.build(
      bodies.size(), near.size(), [&](std::size_t i) { return near.first(i); },
      [&](std::size_t i) { return near.second(i); });
  parts_.resize(static_cast<std::size_t>(threads));
  forEachPart(interactions.size(), threads, [&](std::size_t begin, std::size_t end, int part) {
    for (std::size_t place = begin; place < end; ++place) {
      if (place + kFar < end) prefetchInteraction(interactions[place + kFar].get());
      markOne(*interactions[place], near, bodies, parts_[static_cast<std::size_t>(part)]);
    }
  });
}

void InteractionUpdate::markOne(Interaction& is, const Neighbours& near, const Bodies& bodies,
                                Part& part) {
  const bool swapped = is.getId1() > is.getId2();
  const Body::id_t first = swapped ? is.getId2() : is.getId1();
  const Body::id_t second = swapped ? is.getId1() : is.getId2();
  bool isNear = false;
  partners_.forEach(static_cast<std::size_t>(first), static_cast<std::uint32_t>(second),
                    [&](std::uint32_t index) {
                      isNear = true;
                      known_[index] = 1;
                      // A pair without contact may have come near across another face of the cell.
                      if (is.isReal()) return;
                      const yade::Vector3i cells = near.shift(index);
                      is.cellDist = swapped ? yade::Vector3i(-cells) : cells;
                    });
  if (isNear) return;
  if (is.isReal())
    part.held.emplace_back(first, second);
  else if (mayErase(is, bodies))
    part.gone.push_back(&is);
}

/// Codes on the curve, and indices, of the pairs without an interaction, in the order of the curve.
/// A few pairs keep the order of the search: the loop's time does not depend on them.
std::vector<CodedSlot> InteractionUpdate::unknown(const Neighbours& near,
                                                  std::span<const Box> boxes) const {
  std::vector<CodedSlot> found;
  for (std::size_t i = 0; i < near.size(); ++i)
    if (!known_[i]) found.push_back({0, static_cast<std::uint32_t>(i)});
  if (found.size() < tolerance::kFewNewPairs) return found;
  const CurveKey key(boxes);
  for (CodedSlot& pair : found) pair.code = key(boxes[near.pairs[pair.slot].first.value]);
  sortByCode(found);
  return found;
}

void InteractionUpdate::makeNew(yade::Scene& scene, const Neighbours& near,
                                std::span<const Box> boxes, const MayCollide& mayCollide) {
  const auto& bodies = scene.bodies->body;
  const std::vector<CodedSlot> pairs = unknown(near, boxes);
  const auto idsOf = [&](std::size_t k) {
    return std::pair(near.first(pairs[k].slot), near.second(pairs[k].slot));
  };
  for (std::size_t k = 0; k < pairs.size(); ++k) {
    prefetchBodies(bodies, k, pairs.size(), idsOf);
    const auto [first, second] = idsOf(k);
    if (!mayCollide(bodies[static_cast<std::size_t>(first)].get(),
                    bodies[static_cast<std::size_t>(second)].get()))
      continue;
    const auto made = boost::make_shared<Interaction>(first, second);
    made->cellDist = near.shift(pairs[k].slot);
    scene.interactions->insert(made);
  }
}

void InteractionUpdate::applyChanged(yade::Scene& scene, const Neighbours& near,
                                     std::span<const Box> boxes, std::span<const BoxId> changed,
                                     const MayCollide& mayCollide, const IsNear& isNear) {
  known_.assign(near.size(), 0);
  gone_.clear();
  checkHeld(scene, isNear);
  checkBodies(scene, near, changed);
  std::sort(gone_.begin(), gone_.end(),
            [](const Interaction* a, const Interaction* b) { return a->linIx > b->linIx; });
  gone_.erase(std::unique(gone_.begin(), gone_.end()), gone_.end());
  eraseGone(scene);
  makeNew(scene, near, boxes, mayCollide);
  sizeAfter_ = scene.interactions->size();
}

void InteractionUpdate::checkHeld(yade::Scene& scene, const IsNear& isNear) {
  const auto& bodies = scene.bodies->body;
  std::erase_if(held_, [&](const auto& ids) {
    const yade::shared_ptr<Interaction>& is = scene.interactions->find(ids.first, ids.second);
    if (!is) return true;
    if (is->isReal()) return false;
    if (!isNear(ids.first, ids.second) && mayErase(*is, bodies)) gone_.push_back(is.get());
    return true;
  });
}

void InteractionUpdate::checkBodies(yade::Scene& scene, const Neighbours& near,
                                    std::span<const BoxId> changed) {
  const auto& bodies = scene.bodies->body;
  const auto placeOf = [&](Body::id_t id) {
    return std::lower_bound(changed.begin(), changed.end(), BoxId(static_cast<std::size_t>(id))) -
           changed.begin();
  };
  // Every pair is in the rows of both its bodies. Bodies that have not changed share the last row,
  // which is ignored.
  const auto rowOf = [&](std::size_t i) {
    const Body::id_t id = i % 2 ? near.second(i / 2) : near.first(i / 2);
    const auto place = static_cast<std::size_t>(placeOf(id));
    const bool found =
        place < changed.size() && changed[place].value == static_cast<std::uint32_t>(id);
    return found ? place : changed.size();
  };
  fillRows(nearOf_, changed.size() + 1, 2 * near.size(), rowOf,
           [](std::size_t i) { return static_cast<std::uint32_t>(i / 2); });
  mark_.resize(bodies.size(), 0);
  for (std::size_t row = 0; row < changed.size(); ++row) {
    const auto id = static_cast<Body::id_t>(changed[row].value);
    const Body* body = bodies[changed[row].value].get();
    if (!body) continue;
    const auto partnerOf = [&](std::uint32_t pair) {
      return static_cast<std::size_t>(near.first(pair) == id ? near.second(pair)
                                                             : near.first(pair));
    };
    for (const std::uint32_t pair : nearOf_.row(row)) mark_[partnerOf(pair)] = pair + 1;
    for (const auto& [other, is] : body->intrs) {
      if (const std::uint32_t pair = mark_[static_cast<std::size_t>(other)]; pair > 0)
        known_[pair - 1] = 1;
      else if (is->isReal())
        held_.emplace_back(std::min(id, other), std::max(id, other));
      else if (mayErase(*is, bodies))
        gone_.push_back(is.get());
    }
    for (const std::uint32_t pair : nearOf_.row(row)) mark_[partnerOf(pair)] = 0;
  }
}

}  // namespace yadefrag
