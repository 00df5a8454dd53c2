#pragma once
// Checks whether a new body overlaps others. Contact only prevents new overlaps, and would not
// detect existing ones.

#include <optional>

#include "core/ids.hpp"
#include "mesh/triangle_mesh.hpp"
#include "step/body_places.hpp"

namespace yadefrag {

struct Overlap {
  ComponentId body;  ///< the existing body
  Vec2 place;        ///< m, inside both
};

struct BodySpec;

/// A point at which the new body and an existing one overlap by more than rounding, at present
/// positions. Bodies whose nodes are all held there may overlap each other.
std::optional<Overlap> findOverlap(const Model& model, const ContactSurfaces& surfaces,
                                   const BodyPlaces& places, const TriangleMesh& mesh,
                                   const BodySpec& spec);

}  // namespace yadefrag
