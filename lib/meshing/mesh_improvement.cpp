#include "meshing/mesh_stages.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>
#include <utility>

#include "core/tolerances/mesh.hpp"
#include "meshing/triangle_quality.hpp"

namespace yadefrag {
namespace {

constexpr std::uint32_t kNone = LinkedTriangles::kNone;

constexpr int next(int k) { return k == 2 ? 0 : k + 1; }
constexpr int previous(int k) { return k == 0 ? 2 : k - 1; }

class Improver {
 public:
  Improver(LinkedTriangles& mesh, bool evenHeights)
      : mesh_(mesh), evenHeights_(evenHeights), triangleOf_(mesh.nodes.size()) {}

  void run() {
    flipAll();
    for (int round = 0; round < kRounds; ++round) {
      linkNodes();
      for (std::uint32_t i = mesh_.numBoundary; i < mesh_.nodes.size(); ++i) centre(i);
      flipAll();
    }
    for (int round = 0; round < kSharpRounds; ++round) {
      linkNodes();
      for (std::uint32_t i = mesh_.numBoundary; i < mesh_.nodes.size(); ++i) sharpen(i);
    }
  }

 private:
  static constexpr int kRounds = 8;
  static constexpr int kSharpRounds = 4;

  void linkNodes() {
    for (std::uint32_t t = 0; t < mesh_.triangles.size(); ++t)
      for (const std::uint32_t node : mesh_.triangles[t]) triangleOf_[node] = t;
  }

  void flipAll() {
    for (int round = 0; round < 20; ++round) {
      std::size_t flips = 0;
      for (std::uint32_t t = 0; t < mesh_.triangles.size(); ++t)
        for (int k = 0; k < 3; ++k) flips += flipIfBetter(t, k);
      if (flips == 0) return;
    }
  }

  bool flipIfBetter(std::uint32_t t, int k) {
    const std::uint32_t u = mesh_.neighbours[t][k];
    if (u == kNone) return false;
    const int m = mesh_.cornerAcross(u, t);
    const Vec2 a = mesh_.at(t, k), b = mesh_.at(t, next(k)), c = mesh_.at(t, previous(k));
    const Vec2 d = mesh_.at(u, m);
    const double crossA = cross(b - a, c - a), dotA = dot(b - a, c - a);
    const double crossD = cross(c - d, b - d), dotD = dot(c - d, b - d);
    // The sine of the sum of the two opposite angles, times the four sides; negative if the sum
    // exceeds 180°.
    const double sine = crossA * dotD + dotA * crossD;
    const double sides =
        std::sqrt((crossA * crossA + dotA * dotA) * (crossD * crossD + dotD * dotD));
    if (sine >= -tolerance::kFlip * sides) return false;
    if (areaOf(a, b, d) <= 0 || areaOf(a, d, c) <= 0) return false;
    flip(t, k, u, m);
    return true;
  }

  /// Triangles (a b c) and (d c b) become (a b d) and (d c a).
  void flip(std::uint32_t t, int k, std::uint32_t u, int m) {
    const std::uint32_t overCa = mesh_.neighbours[t][next(k)];
    const std::uint32_t overBd = mesh_.neighbours[u][next(m)];
    mesh_.triangles[t][previous(k)] = mesh_.triangles[u][m];
    mesh_.triangles[u][previous(m)] = mesh_.triangles[t][k];
    mesh_.neighbours[t][next(k)] = u;
    mesh_.neighbours[u][next(m)] = t;
    mesh_.neighbours[t][k] = overBd;
    mesh_.neighbours[u][m] = overCa;
    if (overBd != kNone) mesh_.neighbours[overBd][mesh_.cornerAcross(overBd, u)] = t;
    if (overCa != kNone) mesh_.neighbours[overCa][mesh_.cornerAcross(overCa, t)] = u;
  }

  /// The sides opposite to an inner node, counter-clockwise, as pairs of points.
  std::span<const std::pair<Vec2, Vec2>> ringOf(std::uint32_t node) {
    ring_.clear();
    std::uint32_t t = triangleOf_[node];
    do {
      const int k = mesh_.cornerOf(t, node);
      ring_.emplace_back(mesh_.at(t, next(k)), mesh_.at(t, previous(k)));
      t = mesh_.neighbours[t][next(k)];
    } while (t != triangleOf_[node]);
    return ring_;
  }

  /// Tangent of the smallest angle around p, or the measure of the lowest triangle if that is less.
  [[nodiscard]] double worst(std::span<const std::pair<Vec2, Vec2>> ring, Vec2 p) const {
    double least = 2;
    for (const auto& [a, b] : ring) least = std::min(least, tanMinAngle(p, a, b));
    return evenHeights_ ? std::min(least, heightMeasure(ring, p)) : least;
  }

  /// Measure of the least height around p: kGoodTan for the height kGoodHeight, otherwise in
  /// proportion.
  static double heightMeasure(std::span<const std::pair<Vec2, Vec2>> ring, Vec2 p) {
    double least = std::numeric_limits<double>::infinity(), around = 0;
    for (const auto& [a, b] : ring) {
      const double side = norm(b - a);
      const double longest = std::max({side, norm(a - p), norm(b - p)});
      least = std::min(least, cross(a - p, b - p) / longest);
      around += side;
    }
    const double good = tolerance::kGoodHeight * around / static_cast<double>(ring.size());
    return tolerance::kGoodTan * least / good;
  }

  /// Moves a node to the area-weighted mean of the circumcentres, which makes Delaunay triangles
  /// even.
  void centre(std::uint32_t node) {
    const auto ring = ringOf(node);
    const Vec2 p = mesh_.nodes[node];
    Vec2 sum;
    double area = 0;
    for (const auto& [a, b] : ring) {
      const Vec2 u = a - p, v = b - p;
      const double twice = cross(u, v);
      sum += Vec2{v.y * dot(u, u) - u.y * dot(v, v), u.x * dot(v, v) - v.x * dot(u, u)} * .5;
      area += twice;
    }
    const Vec2 q = p + sum * (1 / area);
    const double now = worst(ring, p);
    const double then = worst(ring, q);
    if (then >= std::min(now, tolerance::kGoodTan)) mesh_.nodes[node] = q;
  }

  /// Moves a node with a small angle to a position at which its smallest angle is larger, if one is
  /// found.
  void sharpen(std::uint32_t node) {
    const auto ring = ringOf(node);
    Vec2 p = mesh_.nodes[node];
    double best = worst(ring, p);
    if (best > tolerance::kGoodTan) return;
    double step = .2 * norm(ring[0].first - p);
    for (int halving = 0; halving < 6; ++halving, step /= 2)
      for (int tries = 0; tries < 8; ++tries) {
        const Vec2 from = p;
        for (const Vec2 way : {Vec2{1, 0}, Vec2{0, 1}, Vec2{-1, 0}, Vec2{0, -1}, Vec2{.7, .7},
                               Vec2{-.7, .7}, Vec2{-.7, -.7}, Vec2{.7, -.7}}) {
          const double there = worst(ring, from + step * way);
          if (there <= best) continue;
          best = there;
          p = from + step * way;
        }
        if (p == from) break;
      }
    mesh_.nodes[node] = p;
  }

  LinkedTriangles& mesh_;
  bool evenHeights_;
  std::vector<std::uint32_t> triangleOf_;  // one triangle at each node
  std::vector<std::pair<Vec2, Vec2>> ring_;
};

}  // namespace

void improve(LinkedTriangles& mesh, bool evenHeights) { Improver(mesh, evenHeights).run(); }

}  // namespace yadefrag
