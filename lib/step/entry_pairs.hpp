#pragma once
// Between the global search, which knows boxes, and contact, which knows slaves and masters: the
// halo (paper §4.1, §4.4).

#include <span>
#include <vector>

#include "contact/candidates.hpp"
#include "contact/pass_rule.hpp"
#include "core/box.hpp"
#include "mesh/model.hpp"
#include "search/contact_search.hpp"
#include "surface/contact_surface.hpp"

namespace yadefrag {

/// An entry's piece and half the halo around it: two entries whose points move by less than δ/2
/// each before they touch have boxes that overlap.
Box entryBox(const ContactSurfaces& surfaces, std::span<const Vec2> positions, EntryId entry,
             double halo);

/// Can a slave of one of the two components touch the other at all.
inline bool mayTouch(const Model& model, ComponentId a, ComponentId b) {
  if (a == b) return model.components[a.value].selfContact;
  return !model.components[a.value].rigid || !model.components[b.value].rigid;
}

/// Of pairs of entries with overlapping boxes, each way round: slaves in their masters' halo at
/// `positions`, as far as `rule` lets them be slaves.
void selectPairs(const Model& model, const ContactSurfaces& surfaces, const PassRule& rule,
                 std::span<const Vec2> positions, double halo, std::span<const BoxPair> overlapping,
                 std::vector<SlaveMaster>& pairs);

}  // namespace yadefrag
