#pragma once
// Between the global search, which uses boxes, and contact, which uses slaves and masters: the halo
// (paper §4.1, §4.4).
//
//   ┌───────────────────────────┐   Fig. 4: the halo of a piece, straight or an arc, is a strip of
//   │ δ   a ─────────────── b   │   width δ on both sides and beyond the ends. A slave in it is a
//   └───────────────────────────┘   candidate. Boxes of entries are enlarged by δ/2 each.

#include <span>
#include <vector>

#include "contact/candidates.hpp"
#include "contact/pass_rule.hpp"
#include "core/box.hpp"
#include "core/vec2.hpp"
#include "mesh/model.hpp"
#include "search/contact_search.hpp"
#include "surface/contact_surface.hpp"
#include "surface/relink.hpp"

namespace yadefrag {

/// Box of an entry's piece, enlarged by half the halo. If the points of two entries move by less
/// than δ/2 each before the entries touch, their boxes overlap.
Box entryBox(const ContactSurfaces& surfaces, std::span<const Vec2> positions, EntryId entry,
             double halo);

/// True if slaves of one of the two components may touch the other one.
inline bool mayTouch(const Model& model, ComponentId a, ComponentId b) {
  if (a == b) return model.components[a.value].selfContact;
  return !model.components[a.value].rigid || !model.components[b.value].rigid;
}

/// From pairs of entries with overlapping boxes, in both directions: slaves in their masters' halo
/// at `positions`, if `rule` permits them as slaves.
void selectPairs(const Model& model, const ContactSurfaces& surfaces, const PassRule& rule,
                 std::span<const Vec2> positions, double halo, std::span<const BoxPair> overlapping,
                 std::vector<SlaveMaster>& pairs);

// --- Candidates of new faces, without a search of the whole scene.

/// The entries of `sides`, of the segments before and after them, and all candidates of any of
/// these: ascending. The candidates are indexed.
std::vector<EntryId> entriesAround(const ContactSurfaces& surfaces, Candidates& candidates,
                                   std::span<const SurfaceSide> sides);

/// Pairs of these entries whose boxes, enlarged by half the halo, overlap.
std::vector<BoxPair> overlapsAmong(const ContactSurfaces& surfaces, std::span<const Vec2> positions,
                                   std::span<const EntryId> entries, double halo);

}  // namespace yadefrag
