#include "meshing/mesh_quality.hpp"

#include <gtest/gtest.h>
#include <algorithm>

#include <cmath>

#include "meshing/structured.hpp"
#include "meshing/triangulate.hpp"
#include "outline/polygons.hpp"

namespace yadefrag {
namespace {

using namespace test;

constexpr std::size_t kBins = MeshQuality::kDirections;

/// Rows of equilateral triangles of edges 1, turned by half a bin so that none is on a bin's end.
TriangleMesh lattice(std::uint32_t n) {
  TriangleMesh mesh;
  const double angle = M_PI / kBins / 2, c = std::cos(angle), s = std::sin(angle);
  for (std::uint32_t j = 0; j <= n; ++j)
    for (std::uint32_t i = 0; i <= n; ++i) {
      const Vec2 p{i + .5 * (j % 2), j * std::sqrt(.75)};
      mesh.nodes.push_back({c * p.x - s * p.y, s * p.x + c * p.y});
    }
  for (std::uint32_t j = 0; j < n; ++j)
    for (std::uint32_t i = 0; i < n; ++i) {
      const std::uint32_t a = j * (n + 1) + i, b = a + 1, d = a + n + 1, e = d + 1;
      if (j % 2 == 0) {
        mesh.triangles.push_back({a, b, d});
        mesh.triangles.push_back({b, e, d});
      } else {
        mesh.triangles.push_back({a, b, e});
        mesh.triangles.push_back({a, e, d});
      }
    }
  return mesh;
}

/// On a lattice the shortest path at an angle θ < 60° from a row is cos θ + sin θ/√3 times as long.
TEST(MeshQuality, LatticeHasItsClosedForm) {
  const TriangleMesh mesh = lattice(60);
  const MeshQuality quality = meshQuality(mesh.nodes, mesh.triangles);
  for (std::size_t i = 0; i < kBins; ++i) {
    double sum = 0;
    for (int k = 0; k < 100; ++k) {
      const double angle = std::fmod((i - .5 + (k + .5) / 100) / kBins * M_PI + M_PI, M_PI / 3);
      sum += std::cos(angle) + std::sin(angle) / std::sqrt(3.);
    }
    EXPECT_NEAR(quality.paths[i], sum / 100, .002) << i;
    EXPECT_NEAR(quality.edges[i], i % (kBins / 3) == 0 ? kBins / 3. : 0, .2) << i;
  }
  EXPECT_NEAR(quality.meanPath, 1.1027, .002);  // 6/π·(1/2 + 1/√3 − √3/4·…): ∫ over 60°
  EXPECT_NEAR(quality.minAngle, M_PI / 3, 1e-12);
  EXPECT_NEAR(quality.shortestEdge, 1, 1e-12);
  EXPECT_NEAR(quality.longestEdge, 1, 1e-12);
}

/// What was measured of rows in a square before there were others: in 12 bins of 15° the edges are
/// 0.03 to 2.03 times even, and a path along edges by direction is 1.037 to 1.124 times the line
/// within one field of rows; over the whole square, whose fields differ, the means differ less.
TEST(MeshQuality, RowsHaveDirections) {
  const TriangleMesh mesh = triangulate({box({0, 0}, {1, 1}), {}}, .01);
  const MeshQuality quality = meshQuality(mesh.nodes, mesh.triangles);
  double least = 2, most = 0;
  for (std::size_t i = 0; i < kBins; i += 3) {  // bins about multiples of 15°
    const double of12 = (quality.edges[(i + kBins - 1) % kBins] + quality.edges[i] +
                         quality.edges[(i + 1) % kBins] + quality.edges[(i + kBins - 2) % kBins]) /
                        3;
    least = std::min(least, of12);
    most = std::max(most, of12);
  }
  EXPECT_LT(least, .1);
  EXPECT_GT(most, 1.9);
  EXPECT_GT(quality.meanPath, 1.07);
  EXPECT_GT(quality.pathSpread, .025);
}

/// Across a slit, lines are not measured; around a hole neither.
TEST(MeshQuality, LinesStayInTheBody) {
  const Polygon slit{box({0, 0}, {1, 1}), {box({.1, .49}, {.9, .51})}};
  const TriangleMesh mesh = triangulate(slit, .02, {NodeLayout::kScattered, 1});
  EXPECT_LT(meshQuality(mesh.nodes, mesh.triangles).meanPath, 1.06);
}

TEST(MeshQuality, FacesOfACrackAreOneEdge) {
  TriangleMesh mesh = structuredRectangle({0, 0}, {1, 1}, 20, 20);
  const MeshQuality whole = meshQuality(mesh.nodes, mesh.triangles);
  for (std::size_t t = 0; t < mesh.triangles.size(); t += 3)
    for (std::uint32_t& node : mesh.triangles[t]) {
      mesh.nodes.push_back(Vec2(mesh.nodes[node]));
      node = static_cast<std::uint32_t>(mesh.nodes.size() - 1);
    }
  const MeshQuality cracked = meshQuality(mesh.nodes, mesh.triangles);
  EXPECT_EQ(cracked.edges, whole.edges);
  EXPECT_NEAR(cracked.meanPath, whole.meanPath, .01);  // from other nodes
}

TEST(MeshQuality, OneTriangleHasNoPaths) {
  const TriangleMesh mesh = triangulate({{{0, 0}, {1, 0}, {0, 1}}, {}}, 10);
  const MeshQuality quality = meshQuality(mesh.nodes, mesh.triangles);
  EXPECT_TRUE(std::isnan(quality.meanPath));
  EXPECT_EQ(quality.numTriangles, 1U);
}

}  // namespace
}  // namespace yadefrag
