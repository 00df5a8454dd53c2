// Second part of interaction_update: checks only bodies that changed.

#include <algorithm>

#include "collider/interaction_update.hpp"

namespace yadefrag {

using yade::Body;
using yade::Interaction;

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
