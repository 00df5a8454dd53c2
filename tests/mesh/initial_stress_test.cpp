// The stretch by which a triangle comes to a stress.

#include "mesh/initial_stress.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "dynamics/element_state.hpp"
#include "mesh/assembly.hpp"
#include "meshing/structured.hpp"

namespace yadefrag::test {
namespace {

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
