#pragma once
// Random bodies whose edges crack at random, and all laws that hold for what is left.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>
#include <set>
#include <vector>

#include "core/disjoint_sets.hpp"
#include "fracture/fracture.hpp"
#include "meshing/triangulate.hpp"
#include "step/world.hpp"
#include "surface/contact_surface.hpp"
#include "surface/surface_checks.hpp"

namespace yadefrag::test {

using RandomCracks = std::mt19937;

inline double any(RandomCracks& random) {
  return std::uniform_real_distribution<double>(-1, 1)(random);
}
inline int below(RandomCracks& random, int count) {
  return static_cast<int>(random() % static_cast<unsigned>(count));
}

/// A regular mesh, or a random one with or without a hole.
inline TriangleMesh randomMesh(RandomCracks& random, double left) {
  const int kind = below(random, 4);
  if (kind < 2)
    return structuredRectangle({left, 0}, {left + 1, 1}, 1 + below(random, 8), 1 + below(random, 8),
                               kind == 0 ? QuadPattern::kUnionJack : QuadPattern::kCrossed);
  const auto ring = [&](double radius, int corners, double sense) {
    std::vector<Vec2> points;
    for (int k = 0; k < corners; ++k) {
      const double angle = sense * 2 * std::numbers::pi * (k + .2 * any(random)) / corners;
      points.push_back(Vec2{left + .5, .5} + radius * Vec2{std::cos(angle), std::sin(angle)});
    }
    return points;
  };
  Polygon polygon{ring(.5, 5 + below(random, 12), 1), {}};
  if (kind == 3) polygon.holes.push_back(ring(.2, 3 + below(random, 5), -1));
  return triangulate(polygon, .12 + .1 * std::abs(any(random)));
}

inline BodySpec randomSpec(RandomCracks& random, const TriangleMesh& mesh, bool brittle) {
  BodySpec spec;
  spec.material = {1e9, .2, 1000 + 500 * any(random), false};
  spec.thickness = 1 + .5 * any(random);
  if (brittle) {
    spec.brittle.tensileStrength = 1e6;
    spec.brittle.strengthScatter = .3;
    spec.brittle.seed = random();
  }
  const int smoothOfEight = below(random, 9);
  for (std::size_t i = 0; i < mesh.nodes.size(); ++i) {
    spec.velocity.push_back({any(random), any(random)});
    spec.displacement.push_back({1e-3 * any(random), 1e-3 * any(random)});
    spec.held.push_back(static_cast<std::uint8_t>(below(random, 3) == 0 ? below(random, 4) : 0));
    spec.smoothNodes.push_back(below(random, 8) < smoothOfEight ? 1 : 0);
  }
  return spec;
}

/// One that cannot crack, and three others; an unbreakable one last at times.
inline void fill(World& world, RandomCracks& random) {
  const int bodies = 4 + below(random, 2);
  for (int body = 0; body < bodies; ++body) {
    const TriangleMesh mesh = randomMesh(random, 2. * body);
    world.addBody(mesh, randomSpec(random, mesh, body >= 1 && body <= 3));
  }
  if (below(random, 4) == 0) return;
  std::vector<Vec2> loads;
  for (std::size_t i = 0; i < world.model.nodes.size(); ++i)
    loads.push_back({any(random), any(random)});
  world.setLoads(loads);
}

/// The edges that have not cracked yet, in random order.
inline std::vector<EdgeId> shuffledEdges(const CrackEdges& edges, RandomCracks& random) {
  std::vector<EdgeId> left;
  for (std::size_t i = 0; i < edges.size(); ++i)
    if (edges.cracked[i] == 0) left.emplace_back(i);
  std::shuffle(left.begin(), left.end(), random);
  return left;
}

struct Sums {
  double mass = 0;
  Vec2 momentum, moment, load;
  double energy = 0;
};

inline Sums sumsOf(const Model& model) {
  Sums sums;
  const Nodes& nodes = model.nodes;
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    sums.mass += nodes.mass[i];
    sums.momentum += nodes.mass[i] * nodes.velocity[i];
    sums.moment += nodes.mass[i] * nodes.position[i];
    sums.energy += nodes.mass[i] * dot(nodes.velocity[i], nodes.velocity[i]);
    if (!nodes.load.empty()) sums.load += nodes.load[i];
  }
  return sums;
}

/// Sums of some 2000 values of either sign: each mass is exact to 2⁻⁵³ of the sum of its ten or so
/// thirds, and the sum to 2⁻⁵³ of itself per value added, some 10⁻¹³ in all.
inline void expectKept(const Sums& before, const Sums& after) {
  constexpr double kRounding = 1e-12;
  EXPECT_NEAR(after.mass / before.mass, 1, kRounding);
  EXPECT_NEAR(after.energy / before.energy, 1, kRounding);
  EXPECT_LT(norm(after.momentum - before.momentum), kRounding * before.mass);
  EXPECT_LT(norm(after.moment - before.moment), kRounding * 10 * before.mass);
  EXPECT_LT(norm(after.load - before.load), kRounding * 1000);
}

inline bool isParted(const Model& model, Side a, Side b) {
  return firstNode(model, a) != lastNode(model, b) || lastNode(model, a) != firstNode(model, b);
}

/// Each node is the corner of one fan and of nothing else, and weighs a third of it.
inline void checkFans(const Model& model, const CrackEdges& edges) {
  std::vector<std::vector<ElementId>> around(model.nodes.size());
  std::vector<double> mass(model.nodes.size());
  for (std::uint32_t e = 0; e < model.triangles.size(); ++e) {
    const Component& body = model.components[model.triangles.component[e].value];
    for (const NodeId node : model.triangles.nodes[e]) {
      around[node.value].emplace_back(e);
      mass[node.value] += body.material.density * body.thickness * model.triangles.area[e] / 3;
    }
  }
  std::vector<ElementId> fan;
  for (std::size_t n = 0; n < model.nodes.size(); ++n) {
    ASSERT_FALSE(around[n].empty());
    ASSERT_NEAR(model.nodes.mass[n] / mass[n], 1, 1e-14);
    const ComponentId component = model.triangles.component[around[n].front().value];
    ASSERT_EQ(model.nodes.component[n], component);
    if (!model.components[component.value].brittle.cracks()) continue;
    fan.clear();
    edges.appendFan(model, NodeId(n), fan);
    std::sort(fan.begin(), fan.end());
    ASSERT_EQ(fan, around[n]);  // ascending as it was found
  }
}

/// Edges and triangles refer to each other; triangles are connected where no edge has cracked.
inline void checkEdges(const Model& model, const CrackEdges& edges) {
  std::size_t known = 0;
  for (std::size_t e = 0; e < edges.ofElement.size(); ++e)
    for (std::uint8_t c = 0; c < 3; ++c) {
      const EdgeId edge = edges.ofElement[e][c];
      if (edge == EdgeId::none()) continue;
      ++known;
      const Side side{ElementId(e), c};
      ASSERT_TRUE(edges.side(edge, 0) == side || edges.side(edge, 1) == side);
    }
  ASSERT_EQ(known, 2 * edges.size());
  for (std::size_t i = 0; i < edges.size(); ++i) {
    const Side a = edges.side(EdgeId(i), 0), b = edges.side(EdgeId(i), 1);
    ASSERT_TRUE(edges.twin(a) == b && edges.twin(b) == a);
    if (edges.cracked[i] == 0) {
      ASSERT_FALSE(isParted(model, a, b));
    }
  }
}

/// By triangle: the number of the piece that nodes connect.
inline std::vector<std::uint32_t> piecesOf(const Model& model) {
  DisjointSets sets(model.triangles.size());
  std::vector<std::uint32_t> first(model.nodes.size(), ~0U), piece;
  for (std::uint32_t e = 0; e < model.triangles.size(); ++e)
    for (const NodeId node : model.triangles.nodes[e]) {
      first[node.value] = std::min(first[node.value], e);
      sets.join(first[node.value], e);
    }
  sets.number(piece);
  return piece;
}

/// The sides of all triangles on the boundary: without a twin, or parted from it. Found from the
/// nodes alone, for elastic bodies as well.
inline std::vector<Side> boundarySides(const Model& model) {
  std::set<std::pair<NodeId, NodeId>> sides;
  const auto ends = [&](Side side) {
    return std::pair(firstNode(model, side), lastNode(model, side));
  };
  std::vector<Side> all;
  for (std::uint32_t e = 0; e < model.triangles.size(); ++e)
    for (std::uint8_t c = 0; c < 3; ++c) {
      all.push_back({ElementId(e), c});
      EXPECT_TRUE(sides.insert(ends(all.back())).second);  // none twice in the same sense
    }
  std::erase_if(all, [&](Side side) {
    const auto [first, last] = ends(side);
    return sides.contains({last, first});
  });
  return all;
}

/// The first layer runs along exactly these sides, material on the left.
inline void checkBoundary(const Model& model, const ContactSurfaces& s,
                          const std::vector<Side>& boundary) {
  for (const Side side : boundary) {
    const SegmentId segment = s.nodeSegment[firstNode(model, side).value];
    ASSERT_NE(segment, SegmentId::none());
    ASSERT_EQ(s.segmentNode[s.segmentNext[segment.value].value], lastNode(model, side));
    ASSERT_EQ(s.component[s.segmentEntry[segment.value].value],
              model.triangles.component[side.element.value]);
  }
  ASSERT_EQ(boundary.size(), s.segments());
}

inline std::size_t countLists(const std::vector<SegmentId>& next) {
  std::vector<bool> seen(next.size());
  std::size_t lists = 0;
  for (std::size_t i = 0; i < next.size(); ++i) {
    lists += seen[i] ? 0 : 1;
    for (std::size_t k = i; !seen[k]; k = next[k].value) seen[k] = true;
  }
  return lists;
}

/// An edge is a face if it cracked and an end of it parted; pieces are connected by nodes exactly
/// as they do by edges, and V − E + F = 2 − lists for each.
inline void checkPieces(const Model& model, const CrackEdges& edges, const ContactSurfaces& s,
                        const std::vector<Side>& boundary) {
  std::size_t parted = 0;
  for (std::size_t i = 0; i < edges.size(); ++i)
    if (isParted(model, edges.side(EdgeId(i), 0), edges.side(EdgeId(i), 1))) ++parted;
  std::size_t twinless = 0;
  for (const Side side : boundary) {
    const ComponentId body = model.triangles.component[side.element.value];
    const bool cracks = model.components[body.value].brittle.cracks();
    twinless += !cracks || edges.twin(side).element == ElementId::none() ? 1 : 0;
  }
  ASSERT_EQ(boundary.size(), twinless + 2 * parted);

  const std::vector<std::uint32_t> byNode = piecesOf(model);
  DisjointSets byEdge(model.triangles.size());
  for (std::size_t i = 0; i < edges.size(); ++i) {
    const Side a = edges.side(EdgeId(i), 0), b = edges.side(EdgeId(i), 1);
    if (edges.cracked[i] == 0) byEdge.join(a.element.value, b.element.value);
  }
  for (std::uint32_t e = 0; e < model.triangles.size(); ++e) {
    const Component& body = model.components[model.triangles.component[e].value];
    if (!body.brittle.cracks()) byEdge.join(body.firstTriangle, e);
  }
  const std::uint32_t pieces = byNode.empty() ? 0 : 1 + *std::ranges::max_element(byNode);
  const std::size_t doubled = 3 * model.triangles.size() + boundary.size();
  ASSERT_EQ(model.nodes.size() + model.triangles.size() + countLists(s.segmentNext),
            doubled / 2 + 2 * pieces);
  // Triangles connected by edges are connected by nodes: with the same number the pieces are the
  // same.
  std::vector<std::uint32_t> numbers;
  ASSERT_EQ(byEdge.number(numbers), pieces);
}

/// All of it.
inline void checkLaws(const Model& model, const CrackEdges& edges, const ContactSurfaces& s) {
  checkCrackedLinks(s);
  if (testing::Test::HasFatalFailure()) return;
  checkPiecesJoin(s);
  checkEdges(model, edges);
  if (!testing::Test::HasFatalFailure()) checkFans(model, edges);
  if (testing::Test::HasFatalFailure()) return;
  const std::vector<Side> boundary = boundarySides(model);
  checkBoundary(model, s, boundary);
  if (!testing::Test::HasFatalFailure()) checkPieces(model, edges, s, boundary);
}

}  // namespace yadefrag::test
