#pragma once
// Checks whether a new body overlaps others. Contact only prevents new overlaps, and would not
// detect existing ones.

#include <optional>
#include <string>

#include "core/errors.hpp"
#include "core/ids.hpp"
#include "mesh/triangle_mesh.hpp"
#include "step/body_places.hpp"

namespace yadefrag {

struct Overlap {
  ComponentId body;  ///< the existing body
  Vec2 place;        ///< m, inside both, where the overlap is deepest
  double depth = 0;  ///< m, of that place below the nearer of the two surfaces
};

/// A new body overlaps another by `depth` (m).
class OverlapError : public InputError {
 public:
  OverlapError(const std::string& message, double deep) : InputError(message), depth(deep) {}
  double depth;
};

struct BodySpec;

/// The place where the new body and existing ones overlap most, by more than rounding, at present
/// positions. Depths are exact up to the length of the shortest side there. Bodies whose nodes are
/// all held there may overlap each other.
std::optional<Overlap> findOverlap(const Model& model, const ContactSurfaces& surfaces,
                                   const BodyPlaces& places, const TriangleMesh& mesh,
                                   const BodySpec& spec);

}  // namespace yadefrag
