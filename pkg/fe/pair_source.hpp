#pragma once
// Where pairs of surface entries come from: a collider that has searched in this step.

#include <vector>

#include "abi/yade.hpp"
#include "core/ids.hpp"
#include "fe/entry_bodies.hpp"

namespace yadefrag {

/// Pairs of entries whose bounds overlap, from the scene's collider: our own hands them over, from
/// any other they are potential interactions. Returns false, and no pairs, if no collider has made
/// all of the entries' bounds at the present positions: the world then searches by itself.
bool pairsOfCollider(const yade::Scene& scene, const yade::Engine& solver,
                     const EntryBodies& bodies, std::vector<BoxPair>& pairs);

}  // namespace yadefrag
