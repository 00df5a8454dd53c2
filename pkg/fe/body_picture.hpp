#pragma once
// What the 3D view shows of finite-element bodies: a copy, for the thread that draws must not wait
// for a step.

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

/// Of one body.
struct BodyPicture {
  int entry = -1;  ///< the surface entry that stands for it: it is drawn with that one
  std::vector<PictureTriangle> triangles;
  std::vector<std::array<Vec2, 2>> outline;  ///< m, all sides of its boundary
  std::vector<std::array<Vec2, 2>> held;     ///< m, cracked edges that cohesion still holds
};

/// By component. `field`: 'component', 'fragment' or 'mises', blue at 0 and red at the largest.
[[nodiscard]] std::vector<BodyPicture> picturesOf(const FESolver& solver, const std::string& field);

/// Colours that tell numbers apart.
[[nodiscard]] Colour colourOf(std::uint32_t number);

}  // namespace yadefrag
