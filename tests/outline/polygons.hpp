#pragma once
// Polygons and checks that the mesh tests share.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <random>
#include <utility>
#include <vector>

#include "mesh/shapes.hpp"
#include "mesh/triangle_mesh.hpp"
#include "meshing/triangle_quality.hpp"

namespace yadefrag::test {

/// A star-shaped loop about the origin with random radii in [least, 1].
inline Loop star(std::mt19937& random, int n, double least) {
  Loop loop = circle({0, 0}, 1, n);
  for (Vec2& p : loop) p *= std::uniform_real_distribution(least, 1.)(random);
  return loop;
}

inline double signedArea(const Loop& loop) {
  double twice = 0;
  for (std::size_t i = 2; i < loop.size(); ++i)
    twice += cross(loop[i - 1] - loop[0], loop[i] - loop[0]);
  return twice / 2;
}

inline double area(const Polygon& polygon) {
  double sum = std::abs(signedArea(polygon.outline));
  for (const Loop& hole : polygon.holes) sum -= std::abs(signedArea(hole));
  return sum;
}

inline double area(const TriangleMesh& mesh) {
  double sum = 0;
  for (const auto& t : mesh.triangles)
    sum += areaOf(mesh.nodes[t[0]], mesh.nodes[t[1]], mesh.nodes[t[2]]);
  return sum;
}

/// What holds for every mesh: counter-clockwise triangles that share their sides properly, no
/// unused nodes, and the loops as their only boundary.
inline void expectSound(const TriangleMesh& mesh) {
  using Side = std::pair<std::uint32_t, std::uint32_t>;
  std::map<Side, int> sides;
  std::vector<bool> used(mesh.nodes.size());
  for (const auto& t : mesh.triangles) {
    ASSERT_GT(areaOf(mesh.nodes[t[0]], mesh.nodes[t[1]], mesh.nodes[t[2]]), 0);
    for (int k = 0; k < 3; ++k) {
      ASSERT_EQ(++sides[Side(t[k], t[(k + 1) % 3])], 1);
      used[t[k]] = true;
    }
  }
  EXPECT_EQ(std::count(used.begin(), used.end(), false), 0);
  std::vector<Side> open;
  for (const auto& [side, count] : sides)
    if (!sides.contains(Side(side.second, side.first))) open.push_back(side);
  std::vector<Side> wanted;
  for (const auto& loop : mesh.loops)
    for (std::size_t i = 0; i < loop.size(); ++i)
      wanted.emplace_back(loop[i], loop[(i + 1) % loop.size()]);
  std::sort(wanted.begin(), wanted.end());
  EXPECT_EQ(open, wanted);

  // Euler's relation of a plane region with one outer loop.
  const auto nodes = static_cast<long>(mesh.nodes.size());
  const auto triangles = static_cast<long>(mesh.triangles.size());
  const long edges = (3 * triangles + static_cast<long>(open.size())) / 2;
  EXPECT_EQ(nodes - edges + triangles, 2 - static_cast<long>(mesh.loops.size()));
}

}  // namespace yadefrag::test
