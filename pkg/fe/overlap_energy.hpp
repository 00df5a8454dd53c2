#pragma once
// Contacts with spheres that start with a large overlap. A sphere that is pressed on a boundary
// touches one piece. When a crack opens there, the adjacent piece gets a new corner, which the
// sphere overlaps at once. The spring of YADE's law is then compressed by this overlap although no
// force has done that work.

#include "fe/entry_bodies.hpp"

namespace yadefrag {

/// (J) Initial energy of the normal springs of such contacts in this step. These are contacts
/// deeper than the possible motion of their bodies, of spheres that also have an older contact with
/// these bodies. (If a sphere rolls from piece to piece, the older contact ends.)
[[nodiscard]] double initialOverlapEnergy(const yade::Scene& scene, const EntryBodies& bodies);

}  // namespace yadefrag
