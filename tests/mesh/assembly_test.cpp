#include <gtest/gtest.h>

#include <cmath>
#include <numeric>
#include <random>

#include "core/errors.hpp"
#include "dynamics/element_state.hpp"
#include "mesh/assembly.hpp"
#include "meshing/triangulate.hpp"

namespace yadefrag::test {
namespace {

Component glass() {
  Component c;
  c.material = {.young = 70e9, .poisson = .2, .density = 2500};
  c.thickness = .01;
  return c;
}

Model threeBodies() {
  Model model;
  for (int i = 0; i < 3; ++i)
    appendBody(model, structuredRectangle({2. * i, 0}, {2. * i + 1, 1}, 2 + i, 3), glass());
  return model;
}

TEST(Assembly, MassIsDensityTimesAreaTimesThickness) {
  const Model model = threeBodies();
  EXPECT_NEAR(std::accumulate(model.nodes.mass.begin(), model.nodes.mass.end(), 0.), 3 * 25, 1e-9);
  Model again = model;
  lumpMasses(again);
  EXPECT_EQ(again.nodes.mass, model.nodes.mass);
}

TEST(Assembly, InverseEdgesUndoTheEdges) {
  const Model model = threeBodies();
  for (std::size_t t = 0; t < model.triangles.size(); ++t) {
    const auto& [a, b, c] = model.triangles.nodes[t];
    const auto& i = model.triangles.inverseEdges[t];
    const Vec2 d1 = model.nodes.position[b.value] - model.nodes.position[a.value];
    const Vec2 d2 = model.nodes.position[c.value] - model.nodes.position[a.value];
    EXPECT_NEAR(d1.x * i[0] + d2.x * i[2], 1, 1e-14);
    EXPECT_NEAR(d1.x * i[1] + d2.x * i[3], 0, 1e-14);
    EXPECT_NEAR(d1.y * i[0] + d2.y * i[2], 0, 1e-14);
    EXPECT_NEAR(d1.y * i[1] + d2.y * i[3], 1, 1e-14);
  }
}

TEST(Assembly, ARemovedBodyLeavesTheOthersAsTheyWere) {
  const Model before = threeBodies();
  Model model = before;
  model.nodes.load.resize(model.nodes.size(), {1, 2});
  const std::vector<NodeId> renumbered = removeBody(model, ComponentId(1));
  ASSERT_EQ(renumbered.size(), before.nodes.size());
  ASSERT_EQ(model.components.size(), 3U);
  EXPECT_EQ(model.components[1].firstTriangle, model.components[1].lastTriangle);
  std::size_t kept = 0;
  for (std::size_t n = 0; n < renumbered.size(); ++n) {
    const bool gone = before.nodes.component[n] == ComponentId(1);
    ASSERT_EQ(renumbered[n] == NodeId::none(), gone);
    if (gone) continue;
    EXPECT_EQ(renumbered[n], NodeId(kept));
    EXPECT_EQ(model.nodes.position[kept], before.nodes.position[n]);
    EXPECT_EQ(model.nodes.mass[kept], before.nodes.mass[n]);
    EXPECT_EQ(model.nodes.component[kept], before.nodes.component[n]);
    ++kept;
  }
  EXPECT_EQ(model.nodes.size(), kept);
  EXPECT_EQ(model.nodes.velocity.size(), kept);
  EXPECT_EQ(model.nodes.held.size(), kept);
  EXPECT_EQ(model.nodes.load.size(), kept);
  for (const std::uint32_t c : {0U, 2U}) {
    const Component& now = model.components[c];
    const Component& was = before.components[c];
    ASSERT_EQ(now.lastTriangle - now.firstTriangle, was.lastTriangle - was.firstTriangle);
    for (std::uint32_t t = 0; t < now.lastTriangle - now.firstTriangle; ++t) {
      EXPECT_EQ(model.triangles.component[now.firstTriangle + t], ComponentId(c));
      for (int i = 0; i < 3; ++i)
        EXPECT_EQ(model.triangles.nodes[now.firstTriangle + t][i],
                  renumbered[before.triangles.nodes[was.firstTriangle + t][i].value]);
    }
  }
  EXPECT_EQ(appendBody(model, structuredRectangle({0, 5}, {1, 6}, 2, 2), glass()), ComponentId(3));
}

TEST(Assembly, ATriangleWithoutAreaIsRefusedBeforeAnythingChanges) {
  TriangleMesh mesh = structuredRectangle({0, 0}, {1, 1}, 2, 2);
  std::swap(mesh.triangles[3][0], mesh.triangles[3][1]);
  Model model;
  EXPECT_THROW(appendBody(model, mesh, glass()), InputError);
  EXPECT_EQ(model.nodes.size(), 0U);
  EXPECT_TRUE(model.components.empty());
}

// --- The stretch by which a triangle comes to a stress.

Component of(const ElasticMaterial& material) {
  Component component;
  component.material = material;
  return component;
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
