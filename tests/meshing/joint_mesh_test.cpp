// Meshes with lines along which sides of triangles lie.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <random>
#include <set>
#include <string>

#include "core/checks.hpp"
#include "core/tolerances/mesh.hpp"
#include "mesh/shapes.hpp"
#include "meshing/size_field.hpp"
#include "meshing/triangulate.hpp"

namespace yadefrag {
namespace {

using namespace test;

const MeshLayout kRowsOf{NodeLayout::kRows, 0}, kScatteredOf{NodeLayout::kScattered, 3};

/// How far p is from the segment.
double distance(Vec2 p, const std::array<Vec2, 2>& line) {
  const Vec2 along = line[1] - line[0];
  const double t = std::clamp(dot(p - line[0], along) / dot(along, along), 0., 1.);
  return norm(p - line[0] - t * along);
}

/// Each listed side is one of two triangles (brute force) and lies on its joint; together the sides
/// of a joint are as long as what of it is inside.
void expectChains(const TriangleMesh& mesh, const JointLines& joints,
                  const std::vector<double>& lengths) {
  std::map<std::pair<std::uint32_t, std::uint32_t>, int> triangles;
  for (const auto& t : mesh.triangles)
    for (int k = 0; k < 3; ++k) ++triangles[std::minmax(t[k], t[(k + 1) % 3])];
  std::vector<double> sums(joints.size());
  std::set<std::pair<std::uint32_t, std::uint32_t>> seen;
  for (const auto& [a, b, joint] : mesh.joints) {
    const auto side = triangles.find(std::minmax(a, b));
    ASSERT_NE(side, triangles.end());
    EXPECT_EQ(side->second, 2);
    EXPECT_TRUE(seen.insert(std::minmax(a, b)).second);
    for (const std::uint32_t node : {a, b})
      EXPECT_LT(distance(mesh.nodes[node], joints[joint]), 1e-12);
    sums[joint] += norm(mesh.nodes[a] - mesh.nodes[b]);
  }
  for (std::size_t i = 0; i < joints.size(); ++i) EXPECT_NEAR(sums[i], lengths[i], 1e-9) << i;
}

void expectMesh(const Polygon& polygon, const JointLines& joints,
                const std::vector<double>& lengths, double size, double angle) {
  for (const MeshLayout& layout : {kRowsOf, kScatteredOf}) {
    const TriangleMesh mesh = triangulate(polygon, size, layout, INFINITY, joints);
    expectSound(mesh);
    expectChains(mesh, joints, lengths);
    EXPECT_NEAR(area(mesh), area(polygon), 1e-12 * area(polygon));
    EXPECT_GT(mesh.minAngle, angle * kDegree) << (layout.nodes == NodeLayout::kRows);
    // Sides have about the size: a triangle of each joint's side is as large as others.
    for (const auto& [a, b, joint] : mesh.joints) {
      EXPECT_GT(norm(mesh.nodes[a] - mesh.nodes[b]), .6 * size);
      EXPECT_LT(norm(mesh.nodes[a] - mesh.nodes[b]), 1.5 * size);
    }
    const TriangleMesh again = triangulate(polygon, size, layout, INFINITY, joints);
    EXPECT_EQ(again.nodes, mesh.nodes);
    EXPECT_EQ(again.triangles, mesh.triangles);
    EXPECT_EQ(again.joints, mesh.joints);
  }
}

TEST(JointMesh, AnyLinesInAnyPlate) {
  const Polygon plate{box({0, 0}, {2, 1}), {}};
  expectMesh(plate, {{{{.5, .5}, {1.3, .55}}}}, {std::hypot(.8, .05)}, .05, 28);
  expectMesh(plate, {{{{.7, 0}, {1.1, 1}}}}, {std::hypot(.4, 1.)}, .05, 28);
  // Beyond the outline nothing is left of it.
  expectMesh(plate, {{{{-1, .4}, {3, .4}}}}, {2}, .05, 28);
  expectMesh(plate, {{{{-1, .41}, {.9, .41}}}}, {.9}, .05, 28);
  // Lines that cross, meet, and lie on each other.
  expectMesh(plate, {{{{.2, .5}, {1.8, .5}}}, {{{1, .1}, {1, .9}}}}, {1.6, .8}, .05, 28);
  // One ends on the other, to rounding.
  const double third = 1. / 3;
  expectMesh(plate, {{{{.2, third}, {1.8, third}}}, {{{1.1, .9}, {1.1, third + 1e-15}}}},
             {1.6, .9 - third}, .05, 28);
  // What two share is the first one's.
  expectMesh(plate, {{{{.2, .5}, {1.2, .5}}}, {{{.8, .5}, {1.8, .5}}}}, {1, .6}, .05, 28);
  expectMesh(plate, {{{{.2, .5}, {1.2, .5}}}, {{{1.2, .5}, {.2, .5}}}}, {1, 0}, .05, 28);
  // Holes and concave outlines cut lines.
  const Polygon holed{box({0, 0}, {4, 2}), {box({1, .5}, {2, 1.5})}};
  expectMesh(holed, {{{{-1, 1}, {5, 1}}}}, {3}, .1, 28);
  // Along the hole's edge nothing is a joint.
  expectMesh(holed, {{{{.5, .5}, {2.5, .5}}}}, {1}, .1, 28);
  const Polygon angle{{{0, 0}, {2, 0}, {2, 1}, {1, 1}, {1, 2}, {0, 2}}, {}};
  expectMesh(angle, {{{{.2, 2.2}, {2.2, .2}}}}, {1.2 * std::sqrt(2.)}, .1, 28);
}

TEST(JointMesh, RandomLines) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> x(0, 2), y(0, 1);
  for (int scene = 0; scene < 20; ++scene) {
    JointLines joints;
    for (int i = 0; i < 6; ++i)
      joints.push_back({{{x(random), y(random)}, {x(random), y(random)}}});
    std::vector<double> lengths;
    for (const auto& [a, b] : joints) lengths.push_back(norm(b - a));
    for (const MeshLayout& layout : {kRowsOf, kScatteredOf}) {
      const TriangleMesh mesh =
          triangulate({box({0, 0}, {2, 1}), {}}, .05, layout, INFINITY, joints);
      expectSound(mesh);
      expectChains(mesh, joints, lengths);
    }
  }
}

TEST(JointMesh, SizesByPlace) {
  const SizeField size({0, 0}, 1, 2, {.02, .1, .02, .1});
  const JointLines joints{{{{.1, .3}, {.9, .7}}}};
  const TriangleMesh mesh =
      triangulate({box({0, 0}, {1, 1}), {}}, size, kScatteredOf, INFINITY, joints);
  expectSound(mesh);
  expectChains(mesh, joints, {norm(joints[0][1] - joints[0][0])});
  for (const auto& [a, b, joint] : mesh.joints) {
    const Vec2 middle = (mesh.nodes[a] + mesh.nodes[b]) * .5;
    EXPECT_NEAR(norm(mesh.nodes[a] - mesh.nodes[b]) / size.at(middle), 1, .3);
  }
}

TEST(JointMesh, ImpossibleArgumentsAreRefused) {
  const Polygon plate{box({0, 0}, {4, 2}), {box({1, .5}, {2, 1.5})}};
  const auto expectRefused = [&](const std::array<Vec2, 2>& joint, const std::string& part) {
    const std::string text = refusalOf([&] {
      (void)triangulate(plate, .1, {}, INFINITY, JointLines{{{{.2, .2}, {3, .3}}}, joint});
    });
    EXPECT_EQ(text.find("joints[1] from ("), 0) << text;
    EXPECT_TRUE(contains(text, part));
  };
  expectRefused({{{5, 0}, {6, 1}}}, "must run inside the outline");
  expectRefused({{{1.2, .7}, {1.8, 1.2}}}, "must run inside the outline");  // in the hole
  expectRefused({{{0, 0}, {4, 0}}}, "must run inside the outline");         // along an edge
  expectRefused({{{1, .2}, {1, .2}}}, "two different ends");
  expectRefused({{{1, .2}, {NAN, 1}}}, "finite ends");
}

// --- size field

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

TEST(SizeField, ConstantFieldAndNoJointsGiveTheMeshOfOneSize) {
  const Polygon square{box({0, 0}, {1, 1}), {circle({.5, .5}, .2, 40)}};
  const TriangleMesh one = triangulate(square, .05);
  const TriangleMesh field = triangulate(square, sampled([](Vec2) { return .05; }, 8));
  EXPECT_EQ(one.triangles.size(), field.triangles.size());
  EXPECT_EQ(one.loops[0].size(), field.loops[0].size());
  EXPECT_EQ(triangulate(square, .05, {}, INFINITY, JointLines{}).nodes, one.nodes);
  EXPECT_TRUE(one.joints.empty());
}

TEST(SizeField, MemoryIsThatOfTheSizesThere) {
  const Polygon square{box({0, 0}, {1, 1}), {}};
  const SizeField field = sampled([](Vec2 p) { return norm(p) < .005 ? 1e-4 : .1; }, 256);
  EXPECT_THROW((void)triangulate(square, 1e-4, {}, 1e9), InputError);
  EXPECT_NO_THROW((void)triangulate(square, field, {}, 1e9));
}

}  // namespace
}  // namespace yadefrag
