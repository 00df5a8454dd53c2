#pragma once
// New bodies beside those that are there: whether they overlap, which contact would not detect,
// since it only prevents new overlaps, and outlines moved onto bodies that they are to touch.

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/box.hpp"
#include "core/errors.hpp"
#include "core/ids.hpp"
#include "mesh/model.hpp"
#include "mesh/triangle_mesh.hpp"
#include "meshing/polygon.hpp"
#include "surface/contact_surface.hpp"

namespace yadefrag {

/// Boxes and boundary segments by component. They are valid as long as nothing moves: bodies are
/// usually added in sequence, and each one then causes only its own cost.
class BodyPlaces {
 public:
  /// Adds the bodies that were added since the last call.
  void update(const Model& model, const ContactSurfaces& surfaces);
  /// Must be called when bodies move or are removed.
  void clear() { *this = {}; }

  /// Absent for a removed body.
  [[nodiscard]] const Box& box(ComponentId body) const { return boxes_[body.value]; }
  [[nodiscard]] const std::vector<SegmentId>& segments(ComponentId body) const {
    return segments_[body.value];
  }

 private:
  std::vector<Box> boxes_;
  std::vector<std::vector<SegmentId>> segments_;
  std::size_t knownNodes_ = 0, knownSegments_ = 0;
};

/// Extends the box to contain a point.
void include(Box& box, Vec2 point);

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
class World;

/// The place where the new body and existing ones overlap most, by more than rounding, at present
/// positions. Depths are exact up to the length of the shortest side there. Bodies whose nodes are
/// all held there may overlap each other.
std::optional<Overlap> findOverlap(const Model& model, const ContactSurfaces& surfaces,
                                   const BodyPlaces& places, const TriangleMesh& mesh,
                                   const BodySpec& spec);

/// Bodies with elements.
[[nodiscard]] std::vector<ComponentId> bodiesOf(const Model& model);

/// An outline moved onto the present boundaries of all bodies.
[[nodiscard]] Snapped snapOnBodies(const World& world, const Polygon& polygon,
                                   const SnapRule& rule);

// --- Depth of overlaps between bodies, from their triangles only: a check of contact that is
// independent of surfaces, slaves and masters. Tips that pass each other overlap without a
// node of one inside the other. No cost unless it is called.

/// (m) The shortest translation that separates two triangles (counter-clockwise); 0 if they do not
/// overlap. It is along the normal of one of their sides.
[[nodiscard]] double overlapOf(const std::array<Vec2, 3>& a, const std::array<Vec2, 3>& b);

/// (m) The deepest overlap of any two triangles without a common node; at most a triangle's height,
/// since the triangles are separated one by one.
[[nodiscard]] double deepestOverlap(const Model& model, int threads = 1);
/// (m) The deepest overlap among triangles with a node that `among` marks, by node.
[[nodiscard]] double deepestOverlap(const Model& model, std::span<const std::uint8_t> among,
                                    int threads = 1);

}  // namespace yadefrag
