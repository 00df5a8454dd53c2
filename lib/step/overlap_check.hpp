#pragma once
// Does a body that is to be added overlap others? Contact keeps apart what was apart, and would not
// see it.

#include <optional>

#include "core/ids.hpp"
#include "mesh/triangle_mesh.hpp"
#include "step/body_places.hpp"

namespace yadefrag {

struct Overlap {
  ComponentId body;  ///< the one that is there already
  Vec2 place;        ///< m, inside both
};

struct BodySpec;

/// Some place where the new body and one that is there overlap by more than rounding, at present
/// positions. Bodies that are held altogether there may overlap one another.
std::optional<Overlap> findOverlap(const Model& model, const ContactSurfaces& surfaces,
                                   const BodyPlaces& places, const TriangleMesh& mesh,
                                   const BodySpec& spec);

}  // namespace yadefrag
