#pragma once
// Contacts with spheres that begin deep inside. A sphere that presses on a boundary is held by one
// piece. When a crack opens there, the piece beside it has a corner of its own, which the sphere
// overlaps at once. YADE's law starts with a spring that is compressed by this overlap, though no
// force has done the work.

#include "fe/entry_bodies.hpp"

namespace yadefrag {

/// (J) What normal springs of such contacts have begun with in this step: contacts deeper than
/// their bodies can have moved, of spheres that an older contact of these bodies still holds. (Of a
/// sphere that rolls from piece to piece the older one ends.)
[[nodiscard]] double energyBornInside(const yade::Scene& scene, const EntryBodies& bodies);

}  // namespace yadefrag
