#pragma once
// Source of the pairs of surface entries: a collider that has searched in this step.

#include <vector>

#include "abi/yade.hpp"
#include "core/ids.hpp"
#include "entries/entry_bodies.hpp"

namespace yadefrag {

/// Pairs of entries whose bounds overlap, from the scene's collider. Colliders of this project
/// return them directly; those of other colliders are potential interactions. Returns false, and no
/// pairs, if no collider has made the bounds of all entries at the present positions: the world
/// then does its own search.
bool pairsOfCollider(const yade::Scene& scene, const yade::Engine& solver,
                     const EntryBodies& bodies, std::vector<BoxPair>& pairs);

}  // namespace yadefrag
