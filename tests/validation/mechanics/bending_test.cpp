// A clamped beam, eight times as long as high, bent at its end: deflection over Timoshenko's,
// PL³/3E'I + 1.2 PL/GA, in plane strain, by how many triangles there are over its height.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "dynamics/blocks.hpp"
#include "meshing/triangulate.hpp"

namespace yadefrag {
namespace {

constexpr double kLong = 8, kHigh = 1;  // m

TriangleMesh latticeOf(int layers) {
  return triangulate({{{0, 0}, {kLong, 0}, {kLong, kHigh}, {0, kHigh}}, {}}, kHigh / layers);
}

TriangleMesh gridOf(int layers) {
  return structuredRectangle({0, 0}, {kLong, kHigh}, 8 * layers, layers);
}

/// All diagonals the same way; `mirrored`: the other way.
TriangleMesh diagonalOf(int layers, bool mirrored) {
  TriangleMesh mesh;
  const auto along = static_cast<std::uint32_t>(8 * layers);
  for (int j = 0; j <= layers; ++j)
    for (std::uint32_t i = 0; i <= along; ++i)
      mesh.nodes.push_back({kLong * i / along, kHigh * j / layers});
  for (std::uint32_t j = 0; j < static_cast<std::uint32_t>(layers); ++j)
    for (std::uint32_t i = 0; i < along; ++i) {
      const std::uint32_t a = j * (along + 1) + i;
      const std::uint32_t d = a + along + 1;
      if (mirrored)
        mesh.triangles.insert(mesh.triangles.end(), {{a, a + 1, d}, {a + 1, d + 1, d}});
      else
        mesh.triangles.insert(mesh.triangles.end(), {{a, a + 1, d + 1}, {a, d + 1, d}});
    }
  return mesh;
}

/// Tip's deflection at rest over theory, for a load that bends by 10⁻⁵ of the length.
double deflection(const TriangleMesh& mesh, double poisson, ElementKind element) {
  const ElasticMaterial material{.young = 1, .poisson = poisson, .density = 1};
  const double area = kHigh;
  const double inertia = kHigh * kHigh * kHigh / 12;
  const double flexibility =
      kLong * kLong * kLong / (3 * material.young / (1 - poisson * poisson) * inertia) +
      1.2 * kLong / (material.shearModulus() * area);
  const double load = 1e-5 * kLong / flexibility;
  Model model;
  Component component;
  component.material = material;
  component.element = element;
  appendBody(model, mesh, component);
  Nodes& nodes = model.nodes;
  nodes.load.resize(nodes.size());
  std::vector<std::size_t> tip;
  for (std::size_t n = 0; n < nodes.size(); ++n) {
    if (nodes.position[n].x < 1e-9) nodes.held[n] = kHeldXY;
    if (nodes.position[n].x > kLong - 1e-9) tip.push_back(n);
  }
  for (const std::size_t n : tip) nodes.load[n].y = load / static_cast<double>(tip.size());
  // Damped critically in the lowest mode, ω = 3.52 √(E'I/ρA)/L², until it is at rest.
  const double omega = 3.52 * std::sqrt(inertia / area) / (kLong * kLong);
  Stepper run = runOf(std::move(model), .9, {.damping = 2 * omega});
  run.step(static_cast<int>(25 / omega / run.dt));
  double sum = 0;
  for (const std::size_t n : tip) sum += run.model.nodes.position[n].y - mesh.nodes[n].y;
  return sum / static_cast<double>(tip.size()) / (load * flexibility);
}

TEST(Bending, LinearTrianglesAreTooStiff) {
  const int layers[] = {1, 2, 4, 8};
  const double known[] = {.22, .65, .89, .97};
  for (int i = 0; i < 3; ++i)
    EXPECT_NEAR(deflection(latticeOf(layers[i]), .3, ElementKind::kLinear), known[i], .015);
  EXPECT_NEAR(deflection(latticeOf(4), .48, ElementKind::kLinear), .61, .01);
  EXPECT_NEAR(deflection(latticeOf(4), .49, ElementKind::kLinear), .47, .01);
}

TEST(Bending, SmoothedStrainsBendAsTheoryOnPolygonsMeshes) {
  EXPECT_NEAR(deflection(latticeOf(1), .3, ElementKind::kSmoothed), .59, .02);
  EXPECT_NEAR(deflection(latticeOf(2), .3, ElementKind::kSmoothed), 1, .03);
  for (const double poisson : {.3, .48, .49})
    EXPECT_NEAR(deflection(latticeOf(4), poisson, ElementKind::kSmoothed), 1, .025) << poisson;
}

TEST(Bending, SmoothedStrainsBendOnGridsToo) {
  for (const TriangleMesh& mesh : {gridOf(4), diagonalOf(4, false), diagonalOf(4, true)}) {
    EXPECT_NEAR(deflection(mesh, .3, ElementKind::kSmoothed), 1, .05);
    EXPECT_NEAR(deflection(mesh, .48, ElementKind::kSmoothed), 1, .08);
    EXPECT_NEAR(deflection(mesh, .49, ElementKind::kSmoothed), 1, .1);
  }
}

}  // namespace
}  // namespace yadefrag
