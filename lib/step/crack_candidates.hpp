#pragma once
// Candidates of new faces, without a search of the whole scene.

#include <span>
#include <vector>

#include "contact/candidates.hpp"
#include "core/vec2.hpp"
#include "surface/relink.hpp"

namespace yadefrag {

/// The entries of `sides`, of the segments before and after them, and all candidates of any of
/// these: ascending. The candidates are indexed.
std::vector<EntryId> entriesAround(const ContactSurfaces& surfaces, Candidates& candidates,
                                   std::span<const SurfaceSide> sides);

/// Pairs of these entries whose boxes, enlarged by half the halo, overlap.
std::vector<BoxPair> overlapsAmong(const ContactSurfaces& surfaces, std::span<const Vec2> positions,
                                   std::span<const EntryId> entries, double halo);

}  // namespace yadefrag
