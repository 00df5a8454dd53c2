#pragma once
// Where every body is, so that one that is to be added looks only at those it comes near.

#include <vector>

#include "core/box.hpp"
#include "mesh/model.hpp"
#include "surface/contact_surface.hpp"

namespace yadefrag {

/// Boxes and boundary segments by component. They hold as long as nothing moves: many bodies are
/// mostly added in a row, and each then costs no more than itself.
class BodyPlaces {
 public:
  /// Learns what has come since the last call.
  void update(const Model& model, const ContactSurfaces& surfaces);
  /// Bodies move or go.
  void forget() { *this = {}; }

  /// Absent for one that has gone.
  [[nodiscard]] const Box& box(ComponentId body) const { return boxes_[body.value]; }
  [[nodiscard]] const std::vector<SegmentId>& segments(ComponentId body) const {
    return segments_[body.value];
  }

 private:
  std::vector<Box> boxes_;
  std::vector<std::vector<SegmentId>> segments_;
  std::size_t knownNodes_ = 0, knownSegments_ = 0;
};

/// Grows the box by a point.
void include(Box& box, Vec2 point);

}  // namespace yadefrag
