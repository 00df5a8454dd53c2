#include "meshing/structured.hpp"

#include <gtest/gtest.h>

#include "core/errors.hpp"
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

}  // namespace
}  // namespace yadefrag
