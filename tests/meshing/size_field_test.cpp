#include "meshing/size_field.hpp"

#include <gtest/gtest.h>
#include <algorithm>

#include <cmath>
#include <functional>

#include "core/errors.hpp"
#include "core/tolerances/mesh.hpp"
#include "meshing/triangulate.hpp"
#include "outline/polygons.hpp"

namespace yadefrag {
namespace {

using namespace test;

constexpr double kDegree = M_PI / 180;

/// On a grid of `cells` × `cells` over the unit square.
SizeField sampled(const std::function<double(Vec2)>& size, std::uint32_t cells) {
  std::vector<double> values;
  const double cell = 1. / cells;
  for (std::uint32_t j = 0; j <= cells; ++j)
    for (std::uint32_t i = 0; i <= cells; ++i) values.push_back(size({i * cell, j * cell}));
  return {{0, 0}, cell, cells + 1, values};
}

TEST(SizeField, IsLinearBetweenItsPointsAndConstantBeyond) {
  const auto plane = [](Vec2 p) { return .1 + .1 * p.x + .05 * p.y; };
  const SizeField field = sampled(plane, 10);
  for (const Vec2 p : {Vec2{0, 0}, {.33, .77}, {1, 1}, {.999, .001}})
    EXPECT_NEAR(field.at(p), plane(p), 1e-15);
  EXPECT_NEAR(field.at({-3, .5}), plane({0, .5}), 1e-15);
  EXPECT_NEAR(field.at({2, 7}), plane({1, 1}), 1e-15);
  EXPECT_EQ(field.smallest(), .1);
  EXPECT_NEAR(field.largest(), .25, 1e-15);
}

TEST(SizeField, GrowsNoFasterThanTheBound) {
  const SizeField field = sampled([](Vec2 p) { return norm(p - Vec2{.5, .5}) < .1 ? .01 : 1; }, 64);
  for (int i = 0; i < 64; ++i)
    for (int j = 0; j < 64; ++j) {
      const Vec2 p{i / 64., j / 64.};
      const double way = std::max(0., norm(p - Vec2{.5, .5}) - .1);
      // A path along the grid's sides and diagonals is up to 8.3 % longer than the line.
      EXPECT_LE(field.at(p), .01 + tolerance::kEdgeGrowth * (1.083 * way + .02));
      EXPECT_GE(field.at(p), .01 + tolerance::kEdgeGrowth * (way - .02));
    }
}

TEST(SizeField, RefusesWhatIsNoLength) {
  for (const double wrong : {0., -1., std::nan(""), double{INFINITY}})
    EXPECT_THROW((void)SizeField({0, 0}, 1, 2, {1, 1, wrong, 1}), InputError);
  EXPECT_THROW((void)SizeField({0, 0}, 1, 2, {1, 1}), InputError);
  EXPECT_THROW((void)SizeField({0, 0}, 1, 2, {1, 1, 1}), InputError);
  EXPECT_THROW((void)SizeField({0, 0}, 0, 2, {1, 1, 1, 1}), InputError);
}

/// Fine in the middle, and along one side; the size jumps, and the growth of edges is limited.
TEST(SizeField, TrianglesFollowIt) {
  const std::vector<std::function<double(Vec2)>> sizes = {
      [](Vec2 p) {
        return norm(p - Vec2{.5, .5}) < .1 ? .005 : .05;
      },
      [](Vec2 p) { return .005 + .2 * p.y; }, [](Vec2 p) { return p.x < .5 ? .006 : .03; }};
  const Polygon square{box({0, 0}, {1, 1}), {}};
  for (const auto& size : sizes)
    for (const NodeLayout layout : {NodeLayout::kRows, NodeLayout::kScattered}) {
      const SizeField field = sampled(size, 128);
      const TriangleMesh mesh = triangulate(square, field, {layout, 3});
      expectSound(mesh);
      EXPECT_GT(mesh.minAngle, 27 * kDegree);
      double sum = 0;
      for (const auto& t : mesh.triangles)
        for (int k = 0; k < 3; ++k) {
          const Vec2 a = mesh.nodes[t[k]], b = mesh.nodes[t[(k + 1) % 3]];
          const double ratio = norm(b - a) / field.at((a + b) * .5);
          EXPECT_GT(ratio, .4);
          EXPECT_LT(ratio, 2.2);
          sum += ratio / (3. * static_cast<double>(mesh.triangles.size()));
        }
      EXPECT_NEAR(sum, 1, .12);
    }
}

TEST(SizeField, ConstantFieldGivesTheMeshOfOneSize) {
  const Polygon square{box({0, 0}, {1, 1}), {circle({.5, .5}, .2, 40)}};
  const TriangleMesh one = triangulate(square, .05);
  const TriangleMesh field = triangulate(square, sampled([](Vec2) { return .05; }, 8));
  EXPECT_EQ(one.triangles.size(), field.triangles.size());
  EXPECT_EQ(one.loops[0].size(), field.loops[0].size());
}

TEST(SizeField, MemoryIsThatOfTheSizesThere) {
  const Polygon square{box({0, 0}, {1, 1}), {}};
  const SizeField field = sampled([](Vec2 p) { return norm(p) < .005 ? 1e-4 : .1; }, 256);
  EXPECT_THROW((void)triangulate(square, 1e-4, {}, 1e9), InputError);
  EXPECT_NO_THROW((void)triangulate(square, field, {}, 1e9));
}

}  // namespace
}  // namespace yadefrag
