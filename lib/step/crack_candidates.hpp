#pragma once
// Candidates of faces that have just come to light, without a search of the whole scene.

#include <span>
#include <vector>

#include "contact/candidates.hpp"
#include "contact/touch.hpp"
#include "core/vec2.hpp"
#include "surface/relink.hpp"

namespace yadefrag {

/// The entries of `sides`, of the segments before and after them, and those that are candidates
/// with any of these: ascending.
std::vector<EntryId> entriesAround(const ContactSurfaces& surfaces, const Candidates& candidates,
                                   std::span<const SurfaceSide> sides);

/// Pairs of these entries whose boxes, with half the halo around, overlap.
std::vector<BoxPair> overlapsAmong(const ContactSurfaces& surfaces, std::span<const Vec2> positions,
                                   std::span<const EntryId> entries, double halo);

/// Of the slaves that a node became, each is outside whatever one of them was outside before: they
/// are at the same place, and where it is inside by what the last correction left, geometry alone
/// would call the new ones inside for good. Returns the pairs that are outside from now on,
/// ascending.
std::vector<SlaveMaster> inheritFlags(Candidates& candidates, const ContactSurfaces& surfaces,
                                      std::span<const NodeId> originals, std::size_t nodeCount);

/// Of the slaves that a node became, each touches what one of them touched: they are at the same
/// place, and a slave's number may have gone to another of these nodes.
void inheritTouches(std::vector<Touch>& touches, const ContactSurfaces& surfaces,
                    std::span<const NodeId> originals, std::size_t nodeCount);

}  // namespace yadefrag
