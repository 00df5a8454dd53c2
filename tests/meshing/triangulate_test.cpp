#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <random>
#include <set>
#include <utility>

#include "core/checks.hpp"
#include "core/random_bits.hpp"
#include "mesh/assembly.hpp"
#include "mesh/shapes.hpp"
#include "meshing/mesh_stages.hpp"
#include "meshing/triangulate.hpp"
#include "time/critical_time_step.hpp"

namespace yadefrag {
namespace {

using namespace test;

/// The loop's nodes are the vertices of `given`, in order or, if `turned`, against it from vertex 0
/// on, with long edges divided equally.
void expectLoop(const TriangleMesh& mesh, std::size_t loop, Loop given, bool turned, double size) {
  const auto count = static_cast<std::uint32_t>(given.size());
  if (turned) std::reverse(given.begin() + 1, given.end());
  std::size_t at = 0;
  for (std::uint32_t i = 0; i < count; ++i) {
    const Vec2 a = given[i];
    const Vec2 b = given[(i + 1) % count];
    const int parts = std::max(1, static_cast<int>(std::round(norm(b - a) / size)));
    for (int k = 0; k < parts; ++k, ++at) {
      ASSERT_LT(at, mesh.loops[loop].size());
      const Vec2 p = mesh.nodes[mesh.loops[loop][at]];
      if (k == 0)
        ASSERT_EQ(p, a);
      else
        ASSERT_LT(norm(p - a - (b - a) * (double(k) / parts)), 1e-14 * (norm(a) + norm(b)));
      ASSERT_EQ(mesh.loopVertices[loop][at], turned && i > 0 ? count - i : i);
    }
  }
  EXPECT_EQ(at, mesh.loops[loop].size());
}

void expectMesh(const Polygon& polygon, double size, double angle) {
  const TriangleMesh mesh = triangulate(polygon, size);
  expectSound(mesh);
  EXPECT_NEAR(area(mesh), area(polygon), 1e-13 * area(polygon));
  ASSERT_EQ(mesh.loops.size(), 1 + polygon.holes.size());
  ASSERT_EQ(mesh.loopVertices.size(), mesh.loops.size());
  expectLoop(mesh, 0, polygon.outline, signedArea(polygon.outline) < 0, size);
  for (std::size_t i = 0; i < polygon.holes.size(); ++i)
    expectLoop(mesh, i + 1, polygon.holes[i], signedArea(polygon.holes[i]) > 0, size);
  EXPECT_EQ(mesh.minAngle, minAngle(mesh.nodes, mesh.triangles));
  EXPECT_GT(mesh.minAngle, angle * kDegree);
}

TEST(Triangulate, FillsAnyOutline) {
  for (int k = 0; k < 60; ++k) expectMesh({box({0, 0}, {1 + .01 * k, .5}), {}}, .02 + .003 * k, 30);
  for (const double layers : {1., 2., 3., 4.}) expectMesh({box({0, 0}, {50, layers}), {}}, 1, 30);
  for (int n = 16; n < 100; n += 5) {
    expectMesh({circle({1, 2}, 3, n), {}}, .2, 25);
    expectMesh({circle({0, 0}, 1, n), {circle({0, 0}, .8, n)}}, .07, 25);
  }
  expectMesh({box({0, 0}, {4, 2}), {circle({1, 1}, .3, 24), box({2, .5}, {3, 1.5})}}, .1, 30);
  // A concave corner.
  expectMesh({{{0, 0}, {2, 0}, {2, 1}, {1, 1}, {1, 2}, {0, 2}}, {}}, .1, 30);
  // Clockwise loops are turned and keep their numbers.
  Loop outline = box({0, 0}, {4, 2});
  std::reverse(outline.begin(), outline.end());
  expectMesh({outline, {{{1, .5}, {2, .5}, {2.5, 1}, {1.5, 1.5}}}}, .3, 20);
  // A large size leaves the vertices.
  expectMesh({box({0, 0}, {1, 1}), {}}, 1e9, 40);
  EXPECT_EQ(triangulate({box({0, 0}, {1, 1}), {}}, 1e9).nodes.size(), 4);
}

TEST(Triangulate, SidesAreNearTheSize) {
  const double size = .05;
  const TriangleMesh mesh = triangulate({box({0, 0}, {2, 1}), {circle({1, .5}, .25, 31)}}, size);
  double sum = 0;
  for (const auto& t : mesh.triangles)
    for (int k = 0; k < 3; ++k) {
      const double side = norm(mesh.nodes[t[k]] - mesh.nodes[t[(k + 1) % 3]]);
      EXPECT_GT(side, .6 * size);
      EXPECT_LT(side, 1.6 * size);
      sum += side / (3 * static_cast<double>(mesh.triangles.size()));
    }
  EXPECT_NEAR(sum, size, .06 * size);
}

TEST(Triangulate, TrianglesGrowInwardsWhereEdgesDifferInLength) {
  expectMesh({circle({0, 0}, 1, 400), {}}, .2, 25);
  expectMesh({box({0, 0}, {1, 1}), {circle({.5, .5}, .02, 32)}}, .1, 25);
  EXPECT_LT(triangulate({circle({0, 0}, 1, 400), {}}, .2).triangles.size(), 6000);
  Loop outline;
  for (int i = 0; i < 100; ++i) outline.push_back({i * .01, 0});
  outline.insert(outline.end(), {{1, 0}, {1, 1}, {0, 1}});
  expectMesh({outline, {}}, .1, 15);
  expectMesh({box({0, 0}, {1, 1}), {box({.2, .5}, {.8, .501})}}, .05, 5);  // a slit
  expectMesh({{{0, 0}, {1, 0}, {1, .001}}, {}}, .05, 0);                   // a needle
}

TEST(Triangulate, RandomStarsWithHoles) {
  std::mt19937 random(3);
  for (int k = 0; k < 200; ++k) {
    Polygon polygon{star(random, {}, 1, 5 + k % 40, .55), {circle({0, .1}, .15, 7)}};
    polygon.holes.push_back(circle({0, -.15}, .08, 5));
    if (k % 2) std::reverse(polygon.outline.begin(), polygon.outline.end());
    if (k % 3) std::reverse(polygon.holes[0].begin(), polygon.holes[0].end());
    // At a vertex of a star the angle is the polygon's own.
    expectMesh(polygon, std::uniform_real_distribution(.03, .3)(random), 0);
    if (HasFailure()) FAIL() << "star " << k;
  }
}

TEST(Triangulate, EdgesOneRoundingApartAreRefused) {
  std::mt19937 random(9);
  for (int k = 0; k < 300; ++k) {
    const Vec2 tip = {1, std::uniform_real_distribution(.1, .9)(random)};
    const Vec2 onEdge = std::uniform_real_distribution(.1, .9)(random) * tip;
    const auto holeAt = [&](Vec2 p) {
      return Polygon{{{0, 0}, tip, {0, 3}}, {{p, p + Vec2{.01, .05}, p + Vec2{0, .1}}}};
    };
    expectSound(triangulate(holeAt(onEdge + Vec2{0, 1e-6}), .13));
    Vec2 near = onEdge;
    while (cross(tip, near) <= 0) near.y = std::nextafter(near.y, 1.);
    EXPECT_THROW((void)triangulate(holeAt(near), .13), InputError);
    if (HasFailure()) FAIL() << "hole " << k;
  }
}

TEST(Triangulate, NodesInsideAreNotOnTheBoundary) {
  const double size = .1;
  const TriangleMesh mesh = triangulate({box({0, 0}, {2, 1}), {}}, size);
  std::vector<bool> onLoop(mesh.nodes.size());
  for (const std::uint32_t node : mesh.loops[0]) onLoop[node] = true;
  for (std::size_t i = 0; i < mesh.nodes.size(); ++i) {
    const Vec2 p = mesh.nodes[i];
    const double depth = std::min({p.x, p.y, 2 - p.x, 1 - p.y});
    EXPECT_TRUE(onLoop[i] ? depth == 0 : depth > .4 * size) << p.x << " " << p.y;
  }
}

TEST(Triangulate, NumbersFollowTheCurve) {
  const TriangleMesh mesh = triangulate({box({0, 0}, {1, 1}), {}}, .05);
  const auto order = orderAlongCurve(mesh.nodes);
  for (std::uint32_t i = 0; i < order.size(); ++i) ASSERT_EQ(order[i], i);
}

TEST(Triangulate, BadSizes) {
  const Polygon square{box({0, 0}, {1, 1}), {}};
  const auto messageFor = [](const Polygon& polygon, double size, double mostBytes = INFINITY) {
    return refusalOf([&] { (void)triangulate(polygon, size, {}, mostBytes); });
  };
  for (const double size : {0., -1., std::nan(""), double(INFINITY)})
    EXPECT_TRUE(contains(messageFor(square, size), "must be positive and finite."));
  EXPECT_EQ(messageFor(square, 1e-5),
            "Size 1e-05 m would give about 2.309e+10 triangles; a mesh can have 2.147e+09.");
  EXPECT_EQ(messageFor(square, .001, 4e8),
            "Size 0.001 m would give about 2.309e+06 triangles, which take about 0.9238 GB, but "
            "there are 0.4 GB of memory; 0.00152 m would fill it.");
  EXPECT_EQ(messageFor(square, .1, 4e8), "");
  EXPECT_TRUE(
      contains(messageFor({box({1e9, 0}, {1e9 + 1e-3, 1e-3}), {}}, 5e-4), "lost in the rounding"));
}

// --- Meshes for bodies that crack: edges in all directions, triangles as good as rows give.

MeshLayout scattered(std::uint64_t seed) { return {NodeLayout::kScattered, seed}; }

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
  return criticalStep(oneTriangle({0, 0}, {size, 0}, {size / 2, size * std::sqrt(.75)}));
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

TEST(IrregularMesh, HasNoDirection) {
  std::uint64_t seed = 0;
  for (const double degrees : {0., 15., 30.})
    for (const double size : {.01, .007}) {
      SCOPED_TRACE(testing::Message() << degrees << " degrees, size " << size);
      const Polygon square{turnedLoop(box({0, 0}, {1, 1}), degrees * kDegree), {}};
      const TriangleMesh mesh = triangulate(square, size, scattered(++seed));
      EXPECT_LT(deviationOfDirections(mesh), .15);
      EXPECT_GT(mesh.minAngle, 30 * kDegree);
      EXPECT_GT(criticalStep(mesh), .6 * latticeStep(size));
    }
  EXPECT_GT(deviationOfDirections(triangulate({box({0, 0}, {1, 1}), {}}, .01)), 2) << "rows";
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

TEST(IrregularMesh, SharpCornersAndFineBoundaries) {
  const Polygon needle{{{0, 0}, {1, -.1}, {1, .1}}, {}};
  const TriangleMesh mesh = triangulate(needle, .05, scattered(1));
  expectSound(mesh);
  EXPECT_GT(mesh.minAngle, 10.5 * kDegree);  // the corner has 11.4°
  // Triangles grow inwards.
  const TriangleMesh disc = triangulate({circle({0, 0}, 1, 400), {}}, .2, scattered(1));
  expectSound(disc);
  EXPECT_GT(disc.minAngle, 28 * kDegree);
  EXPECT_LT(disc.triangles.size(), 6000);
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
