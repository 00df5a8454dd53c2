// The oracle of overlaps, against closed forms and against every pair of triangles.

#include "step/overlap_depth.hpp"

#include <gtest/gtest.h>
#include <algorithm>
#include <cmath>

#include <random>

#include "meshing/structured.hpp"
#include "step/world.hpp"

namespace yadefrag::test {
namespace {

using Corners = std::array<Vec2, 3>;

void addSquare(World& world, Vec2 low, double side) {
  BodySpec spec;
  spec.material = {1e9, .3, 1e3, false};
  world.addBody(structuredRectangle(low, low + Vec2{side, side}, 4, 4), spec);
}

/// Two squares that overlap by d along one axis, and, in the second scene, a corner in a corner by
/// (d, 3d): bodies that lie in each other like this are refused, so one is moved afterwards.
TEST(OverlapDepth, OfSquaresIsTheirOverlap) {
  for (const double d : {1e-9, 1e-4, .02}) {
    for (const Vec2 at : {Vec2{1 - d, .1}, Vec2{.1, 1 - d}, Vec2{1 - d, 1 - 3 * d}}) {
      World world;
      addSquare(world, {}, 1);
      addSquare(world, {3, 3}, 1);
      Model& model = world.model;
      EXPECT_EQ(deepestOverlap(model), 0);
      for (std::size_t n = 0; n < model.nodes.size(); ++n)
        if (model.nodes.component[n] == ComponentId(1U)) model.nodes.position[n] += at - Vec2{3, 3};
      EXPECT_NEAR(deepestOverlap(model), d, 1e-15);
    }
  }
}

/// The tip of an obtuse triangle in a side, by d along the side's normal.
TEST(OverlapDepth, OfATipInASideIsTheTipsDepth) {
  const Corners below{Vec2{-1, -1}, Vec2{1, -1}, Vec2{0, 3}};
  for (const double d : {1e-6, .01}) {
    const Corners tip{Vec2{0, -1 + d}, Vec2{-2, -2}, Vec2{2, -2}};
    const Corners turned{tip[1], tip[2], tip[0]};
    EXPECT_NEAR(overlapOf(below, turned), d, 1e-15);
    EXPECT_NEAR(overlapOf(turned, below), d, 1e-15);
  }
}

TEST(OverlapDepth, BodiesThatTouchOverlapByNothing) {
  World world;
  addSquare(world, {}, 1);
  addSquare(world, {1, .1}, 1);
  EXPECT_EQ(deepestOverlap(world.model), 0);
}

/// Random triangles without common nodes: the push is enough, nothing shorter in any of 720
/// directions is, and the search misses no pair.
TEST(OverlapDepth, IsTheShortestPushOfAnyPair) {
  std::mt19937_64 random(2);
  std::uniform_real_distribution<double> even(0, 1);
  for (int scene = 0; scene < 20; ++scene) {
    Model model;
    std::vector<Corners> all;
    while (all.size() < 60) {
      const Vec2 at{8 * even(random), 8 * even(random)};
      Corners corners;
      for (Vec2& corner : corners) corner = at + Vec2{even(random), even(random)};
      if (cross(corners[1] - corners[0], corners[2] - corners[0]) < .1) continue;
      all.push_back(corners);
      const std::size_t first = model.nodes.size();
      for (const Vec2 corner : corners) model.nodes.position.push_back(corner);
      model.triangles.nodes.push_back({NodeId(first), NodeId(first + 1), NodeId(first + 2)});
      model.triangles.area.push_back(1);
    }
    double deepest = 0;
    for (std::size_t i = 0; i < all.size(); ++i)
      for (std::size_t k = 0; k < i; ++k) {
        double least = INFINITY;
        for (int turn = 0; turn < 720; ++turn) {
          const double angle = turn * 3.14159265358979 / 360;
          const Vec2 away{std::cos(angle), std::sin(angle)};
          double highest = -INFINITY, lowest = INFINITY;
          for (const Vec2 p : all[i]) highest = std::max(highest, dot(p, away));
          for (const Vec2 p : all[k]) lowest = std::min(lowest, dot(p, away));
          least = std::min(least, std::max(0., highest - lowest));
        }
        const double found = overlapOf(all[i], all[k]);
        ASSERT_LE(found, least + 1e-15);
        // A quarter of a degree beside the best direction, a diameter of 1.4 reaches 0.006 farther.
        ASSERT_GE(found, least - .007);
        deepest = std::max(deepest, found);
      }
    EXPECT_EQ(deepestOverlap(model), deepest);
    model.triangles.area.assign(all.size(), 0);
    EXPECT_EQ(deepestOverlap(model), 0) << "dropped triangles are not there";
  }
}

}  // namespace
}  // namespace yadefrag::test
