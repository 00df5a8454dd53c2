// Structured meshes, and what appendBody refuses. Masses: checkFans of fracture/random_cracks.hpp;
// matrices: elements/forces_test.cpp.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "core/errors.hpp"
#include "elements/element_state.hpp"
#include "mesh/assembly.hpp"
#include "mesh/shapes.hpp"
#include "meshing/mesh_stages.hpp"
#include "meshing/triangulate.hpp"
#include "search/position_code.hpp"

namespace yadefrag::test {
namespace {

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
    std::vector<double> areas(mesh.nodes.size());
    for (const auto& t : mesh.triangles)
      for (const std::uint32_t node : t)
        areas[node] += areaOf(mesh.nodes[t[0]], mesh.nodes[t[1]], mesh.nodes[t[2]]) / 3;
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

// --- The stretch by which a triangle comes to a stress.

Component of(const ElasticMaterial& material) {
  Component component;
  component.material = material;
  return component;
}

TEST(Assembly, ATriangleWithoutAreaIsRefusedBeforeAnythingChanges) {
  TriangleMesh mesh = structuredRectangle({0, 0}, {1, 1}, 2, 2);
  std::swap(mesh.triangles[3][0], mesh.triangles[3][1]);
  Model model;
  EXPECT_THROW(appendBody(model, mesh, of({70e9, .2, 2500})), InputError);
  EXPECT_EQ(model.nodes.size(), 0U);
  EXPECT_TRUE(model.components.empty());
}

TEST(InitialStress, IsThatOfTheTriangles) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> part(-.2, .2);
  for (const bool planeStress : {false, true})
    for (const double poisson : {-.3, 0., .2, .45}) {
      const ElasticMaterial material{1e9, poisson, 1000, planeStress};
      const TriangleMesh mesh = structuredRectangle({0, 0}, {1, .3}, 3, 2);
      std::vector<std::array<double, 3>> stress;
      for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
        stress.push_back({part(random) * 1e9, part(random) * 1e9, part(random) * 1e9});
      Model model;
      appendBody(model, mesh, of(material), {}, stress);
      for (std::size_t t = 0; t < stress.size(); ++t)
        for (std::size_t k = 0; k < 3; ++k)
          EXPECT_NEAR(stressOf(model, ElementId(t))[k], stress[t][k], 1e-12 * 1e9);
      // Nothing is where it was not drawn, and the mass is that of the areas without stress.
      EXPECT_EQ(model.nodes.position, mesh.nodes);
      double mass = 0, area = 0;
      for (const double one : model.nodes.mass) mass += one;
      for (const double one : model.triangles.area) area += one;
      EXPECT_NEAR(mass, 1000 * area, 1e-9);
    }
}

TEST(InitialStress, NoneChangesNoBit) {
  const TriangleMesh mesh = structuredRectangle({.1, 0}, {1, .3}, 3, 2);
  Model plain, stressed;
  const ElasticMaterial material{1e9, .3, 1000, false};
  appendBody(plain, mesh, of(material));
  appendBody(stressed, mesh, of(material), {},
             std::vector<std::array<double, 3>>(mesh.triangles.size()));
  EXPECT_EQ(plain.triangles.inverseEdges, stressed.triangles.inverseEdges);
  EXPECT_EQ(plain.triangles.area, stressed.triangles.area);
  EXPECT_EQ(plain.nodes.mass, stressed.nodes.mass);
}

TEST(InitialStress, WhatNoStretchGivesIsRefused) {
  const ElasticMaterial material{1e9, .3, 1000, false};
  EXPECT_TRUE(stretchOf(material, {4e8, 0, 0}));
  for (const std::array<double, 3> stress :
       {std::array{2e9, 0., 0.}, std::array{-1e10, -1e10, 0.}, std::array{0., 0., 1e9},
        std::array<double, 3>{NAN, 0., 0.}, std::array<double, 3>{0., INFINITY, 0.}})
    EXPECT_FALSE(stretchOf(material, stress)) << stress[0] << " " << stress[1];
}

}  // namespace
}  // namespace yadefrag::test
