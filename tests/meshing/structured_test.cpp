#include <gtest/gtest.h>

#include <algorithm>

#include "core/errors.hpp"
#include "curve/position_code.hpp"
#include "meshing/mesh_stages.hpp"
#include "meshing/triangulate.hpp"
#include "outline/polygons.hpp"

namespace yadefrag {
namespace {

using namespace test;

std::vector<double> nodalAreas(const TriangleMesh& mesh) {
  std::vector<double> areas(mesh.nodes.size());
  for (const auto& t : mesh.triangles)
    for (const std::uint32_t node : t)
      areas[node] += areaOf(mesh.nodes[t[0]], mesh.nodes[t[1]], mesh.nodes[t[2]]) / 3;
  return areas;
}

TEST(Structured, IsSound) {
  for (const QuadPattern pattern : {QuadPattern::kUnionJack, QuadPattern::kCrossed})
    for (const auto& [nx, ny] : {std::pair(1, 1), {4, 2}, {7, 3}, {100, 1}}) {
      const TriangleMesh mesh = structuredRectangle({1, 2}, {4, 3}, nx, ny, pattern);
      expectSound(mesh);
      EXPECT_NEAR(area(mesh), 3, 1e-14);
      const int perQuad = pattern == QuadPattern::kCrossed ? 4 : 2;
      EXPECT_EQ(mesh.triangles.size(), perQuad * nx * ny);
      EXPECT_EQ(mesh.loops[0].size(), 2 * (nx + ny));
      EXPECT_EQ(mesh.nodes[mesh.loops[0][0]], (Vec2{1, 2}));
      EXPECT_EQ(mesh.nodes[mesh.loops[0][nx + ny]], (Vec2{4, 3}));
      EXPECT_EQ(mesh.loopVertices[0][nx], 1);
      EXPECT_EQ(mesh.minAngle, minAngle(mesh.nodes, mesh.triangles));
    }
}

TEST(Structured, CornersBalance) {
  const auto expectBalanced = [](const TriangleMesh& mesh, int nx, int ny) {
    const std::vector<double> areas = nodalAreas(mesh);
    const auto& loop = mesh.loops[0];
    for (const int corner : {nx, nx + ny, 2 * nx + ny})
      EXPECT_NEAR(areas[loop[corner]], areas[loop[0]], 1e-15);
  };
  expectBalanced(structuredRectangle({0, 0}, {1, 1}, 4, 2), 4, 2);
  expectBalanced(structuredRectangle({0, 0}, {1, 1}, 3, 5, QuadPattern::kCrossed), 3, 5);
}

TEST(Structured, BadInput) {
  EXPECT_THROW((void)structuredRectangle({0, 0}, {0, 1}, 1, 1), InputError);
  EXPECT_THROW((void)structuredRectangle({0, 0}, {1, std::nan("")}, 1, 1), InputError);
  EXPECT_THROW((void)structuredRectangle({0, 0}, {1, 1}, 0, 1), InputError);
  EXPECT_THROW((void)structuredRectangle({0, 0}, {1, 1}, 100000, 100000), InputError);
}

// --- curve numbering

TEST(Numbering, OrderIsAPermutationAlongTheCurve) {
  std::mt19937 random(5);
  // Corners at 0 and 2^20, so that the curve's boxes are the unit squares.
  std::vector<Vec2> points = {{0, 0}, {1 << 20, 1 << 20}};
  for (int i = 0; i < 5000; ++i)
    points.push_back({std::uniform_real_distribution(0., 1048576.)(random),
                      std::uniform_real_distribution(0., 1048576.)(random)});
  const std::vector<std::uint32_t> order = orderAlongCurve(points);
  ASSERT_EQ(order.size(), points.size());
  std::vector<bool> seen(points.size());
  std::uint64_t last = 0;
  for (const std::uint32_t i : order) {
    ASSERT_FALSE(seen[i]);
    seen[i] = true;
    const std::uint64_t code = PositionCode<2>::encode(
        {static_cast<std::uint32_t>(points[i].x), static_cast<std::uint32_t>(points[i].y)});
    ASSERT_GE(code, last);
    last = code;
  }
}

TEST(Numbering, NoPointsOnePointEqualPoints) {
  EXPECT_TRUE(orderAlongCurve({}).empty());
  EXPECT_EQ(orderAlongCurve(std::vector<Vec2>{{3, 4}}), (std::vector<std::uint32_t>{0}));
  EXPECT_EQ(orderAlongCurve(std::vector<Vec2>{{3, 4}, {3, 4}}), (std::vector<std::uint32_t>{0, 1}));
}

TEST(Numbering, ANeighbourIsNearInMemory) {
  const TriangleMesh mesh = structuredRectangle({0, 0}, {1, 1}, 128, 128);
  for (const auto& t : mesh.triangles) {
    EXPECT_LT(t[0], std::min(t[1], t[2]));
  }
  // Row by row, the span of a triangle would be 129 nodes.
  std::vector<std::uint32_t> spans;
  for (const auto& t : mesh.triangles) spans.push_back(std::max(t[1], t[2]) - t[0]);
  std::nth_element(spans.begin(), spans.begin() + spans.size() / 2, spans.end());
  EXPECT_LT(spans[spans.size() / 2], 16);
}

}  // namespace
}  // namespace yadefrag
