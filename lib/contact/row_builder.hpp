#pragma once
// Rows of the contact system from actives. Normal and foot are those at xⁿ, where the forces act,
// so that the angular momentum is conserved; the gap is that at the predicted positions.

#include <span>

#include "contact/contact_row.hpp"
#include "contact/local_search.hpp"
#include "surface/piece_geometry.hpp"

namespace yadefrag {

/// `before`: positions xⁿ; `faceAngle`: as in tolerance::Contact. The row's gap is that of the
/// active; its `toleratedGap` is 0, its friction is not set.
ContactRow makeRow(const ContactSurfaces& surfaces, const PieceGeometry& before,
                   const Active& active, double faceAngle, bool hasFriction = false);

/// (m) Gap of a row's slave relative to its master's line or arc; negative: penetration.
template <bool kSmooth>
double gapOf(const ContactRow& row, const PieceGeometryOf<kSmooth>& geometry) {
  return geometry.foot(row.master, geometry.slave(row.slave)).gap;
}

}  // namespace yadefrag
