#include "search/curve_key.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

namespace yadefrag {
namespace {

constexpr double kInfinite = std::numeric_limits<double>::infinity();

Box cube(double x, double y, double z) { return {{x, y, z}, {x + 1, y + 1, z + 1}}; }

/// Boxes on a grid of 8 × 8 × `high` places, 1.1 m from each other: the edge of a position-code
/// box.
std::vector<Box> grid(int high) {
  std::vector<Box> boxes;
  for (int x = 0; x < 8; ++x)
    for (int y = 0; y < 8; ++y)
      for (int z = 0; z < high; ++z) boxes.push_back(cube(1.1 * x, 1.1 * y, 1.1 * z));
  return boxes;
}

TEST(CurveKey, IsThePositionCodeOfTheLowerCorner) {
  const std::vector<Box> space = grid(8), plane = grid(1);
  const CurveKey inSpace(space), inPlane(plane);
  for (std::uint32_t x = 0; x < 8; ++x)
    for (std::uint32_t y = 0; y < 8; ++y) {
      const Box box = cube(1.1 * x + .1, 1.1 * y + .1, .1);
      EXPECT_EQ(inPlane(box), PositionCode<2>::encode({x, y}));
      EXPECT_EQ(inSpace(box), PositionCode<3>::encode({x, y, 0}));
    }
}

TEST(CurveKey, TakesTheNearestPlaceForBoxesOutside) {
  const std::vector<Box> boxes = grid(8);
  const CurveKey key(boxes);
  EXPECT_EQ(key(cube(-1e300, .1, .1)), key(cube(.1, .1, .1)));
  constexpr std::uint32_t last = PositionCode<3>::kMask;
  EXPECT_EQ(key(cube(1e300, 1e300, 1e300)), PositionCode<3>::encode({last, last, last}));
  EXPECT_EQ(key({{-kInfinite, .1, .1}, {kInfinite, 1, 1}}), key(cube(.1, .1, .1)));
}

// Without any box with a finite side there is no plan; the order does not matter then.
TEST(CurveKey, NeedsNoFiniteBox) {
  const std::vector<Box> walls(2, Box{{-kInfinite, 0, 0}, {kInfinite, 1, 1}});
  EXPECT_EQ(CurveKey(walls)(walls[0]), CurveKey(walls)(walls[1]));
  EXPECT_EQ(CurveKey(std::span<const Box>())(cube(0, 0, 0)), 0U);
}

}  // namespace
}  // namespace yadefrag
