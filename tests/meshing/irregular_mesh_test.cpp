// Meshes for bodies that crack: edges in all directions, triangles as good as rows give.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstring>
#include <set>
#include <utility>

#include "core/random_bits.hpp"
#include "dynamics/critical_time_step.hpp"
#include "mesh/assembly.hpp"
#include "meshing/triangulate.hpp"
#include "outline/polygons.hpp"

namespace yadefrag {
namespace {

using namespace test;

constexpr double kDegree = M_PI / 180;

MeshLayout scattered(std::uint64_t seed) { return {NodeLayout::kScattered, seed}; }

Loop turned(Loop loop, double degrees) {
  const double c = std::cos(degrees * kDegree), s = std::sin(degrees * kDegree);
  for (Vec2& p : loop) p = {c * p.x - s * p.y, s * p.x + c * p.y};
  return loop;
}

/// (s) Of a body that cracks, without loads.
double criticalStep(const TriangleMesh& mesh) {
  Model model;
  Component body;
  body.material = {1e9, .2, 2500};
  body.brittle.tensileStrength = 1e6;
  appendBody(model, mesh, body);
  return criticalTimeStep(model);
}

double latticeStep(double size) {
  TriangleMesh one;
  one.nodes = {{0, 0}, {size, 0}, {size / 2, size * std::sqrt(.75)}};
  one.triangles = {{0, 1, 2}};
  return criticalStep(one);
}

/// Largest relative deviation of the number of inner sides in each 5° from a uniform distribution.
double deviationOfDirections(const TriangleMesh& mesh) {
  std::set<std::pair<std::uint32_t, std::uint32_t>> once;
  std::array<double, 36> count{};
  double inner = 0;
  for (const auto& t : mesh.triangles)
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint32_t a = t[k], b = t[(k + 1) % 3];
      once.insert({a, b});
      if (!once.contains({b, a})) continue;
      const Vec2 side = mesh.nodes[b] - mesh.nodes[a];
      const double angle = std::atan2(side.y, side.x) + M_PI;
      ++count[static_cast<std::size_t>(angle / M_PI * 36) % 36];
      ++inner;
    }
  double most = 0;
  for (const double n : count) most = std::max(most, std::abs(n * 36 / inner - 1));
  return most;
}

void expectWithoutDirection(const TriangleMesh& mesh, double size) {
  EXPECT_LT(deviationOfDirections(mesh), .15);
  EXPECT_GT(mesh.minAngle, 30 * kDegree);
  EXPECT_GT(criticalStep(mesh), .6 * latticeStep(size));
}

TEST(IrregularMesh, HasNoDirection) {
  std::uint64_t seed = 0;
  for (const double degrees : {0., 15., 30.})
    for (const double size : {.01, .007}) {
      SCOPED_TRACE(testing::Message() << degrees << " degrees, size " << size);
      const Polygon square{turned(box({0, 0}, {1, 1}), degrees), {}};
      expectWithoutDirection(triangulate(square, size, scattered(++seed)), size);
    }
}

TEST(IrregularMesh, RowsHaveDirections) {
  EXPECT_GT(deviationOfDirections(triangulate({box({0, 0}, {1, 1}), {}}, .01)), 2);
}

TEST(IrregularMesh, HasAsManyTrianglesAsRows) {
  const Polygon square{box({0, 0}, {1, 1}), {}};
  const auto rows = static_cast<double>(triangulate(square, .01).triangles.size());
  const auto irregular =
      static_cast<double>(triangulate(square, .01, scattered(1)).triangles.size());
  EXPECT_NEAR(irregular, rows, .08 * rows);
}

/// Curved outlines, holes, concave corners, bodies of few layers.
TEST(IrregularMesh, FillsAnyOutline) {
  std::vector<Polygon> polygons = {
      {circle({0, 0}, 1, 90), {}},
      {circle({0, 0}, 1, 90), {circle({0, 0}, .3, 27)}},
      {circle({0, 0}, 1, 90), {circle({0, 0}, .85, 76)}},
      {{{0, 0}, {2, 0}, {2, 1}, {1, 1}, {1, 2}, {0, 2}}, {}},
      {box({0, 0}, {4, 2}), {circle({1, 1}, .3, 24), box({2, .5}, {3, 1.5})}}};
  for (const double layers : {1., 1.5, 2., 3., 4.})
    polygons.push_back({box({0, 0}, {3, .07 * layers}), {}});
  for (std::size_t i = 0; i < polygons.size(); ++i)
    for (std::uint64_t seed = 0; seed < 4; ++seed) {
      SCOPED_TRACE(testing::Message() << "polygon " << i << ", seed " << seed);
      const TriangleMesh mesh = triangulate(polygons[i], .07, scattered(seed));
      expectSound(mesh);
      EXPECT_NEAR(area(mesh), area(polygons[i]), 1e-13 * area(polygons[i]));
      EXPECT_GT(mesh.minAngle, 30 * kDegree);
      EXPECT_GT(criticalStep(mesh), .55 * latticeStep(.07));
      EXPECT_EQ(mesh.loops[0].size(), triangulate(polygons[i], .07).loops[0].size());
    }
}

TEST(IrregularMesh, SharpCornersKeepTheirAngles) {
  const Polygon needle{{{0, 0}, {1, -.1}, {1, .1}}, {}};
  const TriangleMesh mesh = triangulate(needle, .05, scattered(1));
  expectSound(mesh);
  EXPECT_GT(mesh.minAngle, 10.5 * kDegree);  // the corner has 11.4°
}

TEST(IrregularMesh, TrianglesGrowInwardsFromAFineBoundary) {
  const Polygon disc{circle({0, 0}, 1, 400), {}};
  const TriangleMesh mesh = triangulate(disc, .2, scattered(1));
  expectSound(mesh);
  EXPECT_GT(mesh.minAngle, 28 * kDegree);
  EXPECT_LT(mesh.triangles.size(), 6000);
}

TEST(IrregularMesh, SeedChoosesTheMesh) {
  const Polygon polygon{circle({0, 0}, 1, 77), {box({-.2, -.3}, {.4, .1})}};
  const TriangleMesh a = triangulate(polygon, .05, scattered(5));
  const TriangleMesh b = triangulate(polygon, .05, scattered(5));
  EXPECT_EQ(a.nodes, b.nodes);
  EXPECT_EQ(a.triangles, b.triangles);
  EXPECT_NE(a.nodes, triangulate(polygon, .05, scattered(6)).nodes);
}

/// The sequence that the paper's authors publish, from the state that the seed is mixed into.
TEST(IrregularMesh, RandomNumbersAreSplitMix64) {
  EXPECT_EQ(mixBits(kRandomStride), 0xe220a8397b1dcdafULL);
  RandomSequence random(0);
  const double first = random.symmetric();
  EXPECT_EQ(
      first,
      static_cast<double>(mixBits(mixBits(kRandomStride) + kRandomStride) >> 11) * 0x1p-52 - 1);
  for (int i = 0; i < 1000; ++i) {
    const double x = random.symmetric();
    EXPECT_TRUE(x >= -1 && x < 1);
  }
}

}  // namespace
}  // namespace yadefrag
