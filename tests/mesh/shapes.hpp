#pragma once
// Outlines, polygons, turned points, sums over nodes and checks of meshes that tests share.

#include <gtest/gtest.h>
#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <numbers>
#include <random>
#include <utility>
#include <vector>

#include "mesh/model.hpp"
#include "mesh/triangle_mesh.hpp"
#include "meshing/triangle_quality.hpp"

namespace yadefrag::test {

using Loop = std::vector<Vec2>;

inline constexpr double kDegree = std::numbers::pi / 180;

/// By an angle (rad) about the origin.
inline Vec2 turnedBy(Vec2 p, double angle) {
  return {std::cos(angle) * p.x - std::sin(angle) * p.y,
          std::sin(angle) * p.x + std::cos(angle) * p.y};
}

inline Loop turnedLoop(Loop loop, double angle) {
  for (Vec2& p : loop) p = turnedBy(p, angle);
  return loop;
}

inline Loop box(Vec2 low, Vec2 high) { return {low, {high.x, low.y}, high, {low.x, high.y}}; }

inline Polygon rectangle(Vec2 low, Vec2 high) { return {box(low, high), {}}; }

inline TriangleMesh oneTriangle(Vec2 a, Vec2 b, Vec2 c) {
  TriangleMesh mesh;
  mesh.nodes = {a, b, c};
  mesh.triangles = {{0, 1, 2}};
  mesh.loops = {{0, 1, 2}};
  return mesh;
}

inline Vec2 middleOf(const TriangleMesh& mesh, std::size_t triangle) {
  const auto& [a, b, c] = mesh.triangles[triangle];
  return (1. / 3) * (mesh.nodes[a] + mesh.nodes[b] + mesh.nodes[c]);
}

/// By triangle: the value at its middle.
template <class Value, class At>
std::vector<Value> byTriangle(const TriangleMesh& mesh, At at) {
  std::vector<Value> values;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
    values.push_back(static_cast<Value>(at(middleOf(mesh, t))));
  return values;
}

/// Moves points at random, by up to `most` (m) in the directions that `isFree(x)` has, 1 or 0.
template <class Random, class IsFree>
void jitter(TriangleMesh& mesh, Vec2 most, Random random, IsFree isFree) {
  std::uniform_real_distribution<double> any(-1, 1);
  for (Vec2& x : mesh.nodes) {
    const Vec2 moved{most.x * any(random), most.y * any(random)}, free = isFree(x);
    x += {free.x * moved.x, free.y * moved.y};
  }
}

/// Corners at even angles, the first one at `start` (rad).
inline Loop circle(Vec2 centre, double radius, int corners, double start = 0) {
  Loop loop;
  for (int k = 0; k < corners; ++k) {
    const double angle = start + 2 * std::numbers::pi * k / corners;
    loop.push_back(centre + radius * Vec2{std::cos(angle), std::sin(angle)});
  }
  return loop;
}

struct Moments {
  Vec2 linear;         ///< kg m/s
  double angular = 0;  ///< kg m²/s, about the origin
};

inline Moments momentsOf(const Nodes& nodes) {
  Moments sum;
  for (std::size_t n = 0; n < nodes.size(); ++n) {
    sum.linear += nodes.mass[n] * nodes.velocity[n];
    sum.angular += nodes.mass[n] * cross(nodes.position[n], nodes.velocity[n]);
  }
  return sum;
}

/// By places of the stress-free bodies.
inline std::vector<NodeId> nodesWhere(const Nodes& nodes, const std::function<bool(Vec2)>& where) {
  std::vector<NodeId> found;
  for (std::size_t n = 0; n < nodes.size(); ++n)
    if (where(nodes.reference[n])) found.emplace_back(n);
  return found;
}

// --- Polygons and checks that the mesh tests share.

/// A star around `centre`: corners at even angles, at random distances from 1 − roughness times the
/// radius.
template <class Random>
Loop star(Random& random, Vec2 centre, double radius, int corners, double roughness) {
  std::uniform_real_distribution<double> part(1 - roughness, 1);
  Loop loop = circle({}, 1, corners);
  for (Vec2& p : loop) p = centre + radius * part(random) * p;
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
