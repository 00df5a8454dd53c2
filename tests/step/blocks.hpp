#pragma once
// Blocks that touch exactly, as in masonry, jointed rock and dry stacks.

#include <random>
#include <utility>
#include <vector>

#include "meshing/triangulate.hpp"
#include "step/world.hpp"

namespace yadefrag::test {

inline constexpr double kBlockSide = .1;  // m

struct BlockWall {
  int blocks;           ///< in a row, and rows
  double gap = 0;       ///< m, half the width of each joint
  double jitter = .25;  ///< of a side: how far inner corners are out of place
  double friction = .5;
};

/// Outlines of the floor, and of four-sided blocks that fill a square on it. Two neighbours have
/// their corners at the same places if the gap is 0.
inline std::vector<std::vector<Vec2>> blockOutlines(const BlockWall& wall) {
  const int count = wall.blocks + 1;
  std::mt19937_64 random(5);
  const auto some = [&] { return wall.jitter * (2 * double(random() >> 11) * 0x1p-53 - 1); };
  std::vector<Vec2> corners;
  for (int row = 0; row < count; ++row)
    for (int column = 0; column < count; ++column) {
      const bool inner = row > 0 && row < wall.blocks && column > 0 && column < wall.blocks;
      const double dx = inner ? some() : 0, dy = inner ? some() : 0;
      corners.push_back(kBlockSide * Vec2{column + dx, row + dy});
    }
  const double wide = kBlockSide * wall.blocks;
  std::vector<std::vector<Vec2>> outlines{
      {{-wide, -kBlockSide}, {2 * wide, -kBlockSide}, {2 * wide, 0}, {-wide, 0}}};
  for (int row = 0; row < wall.blocks; ++row)
    for (int column = 0; column < wall.blocks; ++column) {
      const auto at = [&](int x, int y) {
        return corners[static_cast<std::size_t>(row + y) * static_cast<std::size_t>(count) +
                       static_cast<std::size_t>(column + x)];
      };
      std::vector<Vec2> outline{at(0, 0), at(1, 0), at(1, 1), at(0, 1)};
      const Vec2 middle = .25 * (outline[0] + outline[1] + outline[2] + outline[3]);
      for (Vec2& corner : outline) {
        const Vec2 inwards = middle - corner;
        corner += (wall.gap / norm(inwards)) * inwards;
      }
      outlines.push_back(std::move(outline));
    }
  return outlines;
}

/// The blocks, under gravity, on the floor, which is held. The nodes of neighbours are at the same
/// places, too.
inline void addBlockWall(World& world, const BlockWall& wall) {
  bool isFloor = true;
  for (const std::vector<Vec2>& outline : blockOutlines(wall)) {
    const TriangleMesh mesh = triangulate({outline, {}}, isFloor ? kBlockSide : kBlockSide / 2);
    BodySpec spec;
    spec.material = {30e9, .2, 2500, false};
    spec.friction = wall.friction;
    spec.selfContact = false;
    if (isFloor) spec.held.assign(mesh.nodes.size(), kHeldXY);
    world.addBody(mesh, spec);
    isFloor = false;
  }
  world.dynamicsSettings.gravity = {0, -9.81};
}

}  // namespace yadefrag::test
