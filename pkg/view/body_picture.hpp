#pragma once
// Data for drawing finite-element bodies in the 3D view. They are a copy: the thread that draws
// must not wait for a step.

#include <array>
#include <string>
#include <vector>

#include "abi/yade.hpp"
#include "core/vec2.hpp"

namespace yadefrag {

class FESolver;

using Colour = std::array<float, 3>;

struct PictureTriangle {
  std::array<Vec2, 3> corners;  ///< m
  Colour colour;
};

/// Picture of one body.
struct BodyPicture {
  int entry = -1;  ///< the surface entry with which the body is drawn
  std::vector<PictureTriangle> triangles;
  std::vector<std::array<Vec2, 2>> outline;  ///< m, all sides of its boundary
  std::vector<std::array<Vec2, 2>> held;     ///< m, cohesive cracks
};

/// Pictures by component. `field`: 'component', 'fragment' or 'mises', blue at 0 and red at the
/// largest value.
[[nodiscard]] std::vector<BodyPicture> picturesOf(const FESolver& solver, const std::string& field);

/// A distinct colour for each number.
[[nodiscard]] Colour colourOf(std::uint32_t number);

}  // namespace yadefrag
