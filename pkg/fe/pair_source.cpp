#include "fe/pair_source.hpp"

#include <algorithm>

#include "collider/search_collider.hpp"

namespace yadefrag {
namespace {

struct Found {
  const yade::Collider* collider = nullptr;
  bool behindSolver = false;
};

Found findCollider(const yade::Scene& scene, const yade::Engine& solver) {
  bool solverPassed = false;
  for (const auto& engine : scene.engines) {
    if (engine.get() == &solver) solverPassed = true;
    const auto* collider = dynamic_cast<const yade::Collider*>(engine.get());
    if (collider && !collider->dead) return {collider, solverPassed};
  }
  return {};
}

/// True if bodies have not moved since the bounds were made: in this step, or at the end of the
/// last one.
bool boundsAreFresh(const EntryBodies& bodies, long searchedAt) {
  for (std::size_t e = 0; e < bodies.ids().size(); ++e) {
    if (!bodies.hasBody(EntryId(e))) continue;
    const auto& bound = bodies.body(EntryId(e)).bound;
    if (!bound || bound->lastUpdateIter != searchedAt) return false;
  }
  return true;
}

}  // namespace

bool pairsOfCollider(const yade::Scene& scene, const yade::Engine& solver,
                     const EntryBodies& bodies, std::vector<BoxPair>& pairs) {
  pairs.clear();
  const Found found = findCollider(scene, solver);
  const long searchedAt = scene.iter - (found.behindSolver ? 1 : 0);
  if (!found.collider || !boundsAreFresh(bodies, searchedAt)) return false;
  const auto take = [&](yade::Body::id_t id1, yade::Body::id_t id2) {
    const EntryId a = bodies.entryOf(id1), b = bodies.entryOf(id2);
    if (a != EntryId::none() && b != EntryId::none())
      pairs.push_back(orderedPair(BoxId(a.value), BoxId(b.value)));
  };
  if (const auto* ours = dynamic_cast<const SearchCollider*>(found.collider)) {
    if (ours->lastSearch() != searchedAt) return false;
    for (const BoxPair& pair : ours->entryPairs())
      take(static_cast<yade::Body::id_t>(pair.first.value),
           static_cast<yade::Body::id_t>(pair.second.value));
  } else {
    for (const auto& contact : *scene.interactions) take(contact->getId1(), contact->getId2());
  }
  std::sort(pairs.begin(), pairs.end());
  return true;
}

}  // namespace yadefrag
