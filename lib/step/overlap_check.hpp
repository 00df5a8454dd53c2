#pragma once
// Do bodies overlap from the start? Contact keeps apart what was apart, and would not see it.

#include <optional>

#include "core/ids.hpp"
#include "mesh/model.hpp"
#include "surface/contact_surface.hpp"

namespace yadefrag {

struct Overlap {
  ComponentId a, b;
  Vec2 place;  ///< m, inside both
};

/// Some place where one of the bodies from `firstNew` on and another one overlap by more than
/// rounding, at present positions. Bodies that are held altogether there may overlap one another.
std::optional<Overlap> findOverlap(const Model& model, const ContactSurfaces& surfaces,
                                   ComponentId firstNew);

}  // namespace yadefrag
