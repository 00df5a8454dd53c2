#pragma once
// Positions of all bodies: a new body is checked only against those near it.

#include <vector>

#include "core/box.hpp"
#include "mesh/model.hpp"
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

}  // namespace yadefrag
