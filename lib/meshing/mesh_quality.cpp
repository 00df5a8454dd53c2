#include "meshing/mesh_quality.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <numeric>
#include <queue>
#include <utility>

#include "core/tolerances/mesh.hpp"
#include "meshing/curve_numbering.hpp"
#include "meshing/triangle_quality.hpp"

namespace yadefrag {
namespace {

constexpr std::size_t kDirections = MeshQuality::kDirections;
using Triangle = std::array<std::uint32_t, 3>;

std::size_t directionOf(Vec2 d) {
  double angle = std::atan2(d.y, d.x);
  if (angle < 0) angle += M_PI;
  const auto bin = static_cast<std::size_t>(angle / M_PI * kDirections);
  return bin % kDirections;
}

struct Edge {
  std::uint32_t low, high;
  bool isInner;
};

/// The triangles, with nodes at the same position merged into one.
std::vector<Triangle> welded(std::span<const Vec2> nodes, std::span<const Triangle> triangles) {
  std::vector<std::uint32_t> order(nodes.size());
  std::iota(order.begin(), order.end(), 0U);
  const auto before = [&](std::uint32_t a, std::uint32_t b) {
    return std::pair(nodes[a].x, nodes[a].y) < std::pair(nodes[b].x, nodes[b].y);
  };
  std::sort(order.begin(), order.end(), before);
  std::vector<std::uint32_t> first(nodes.size());
  for (std::size_t i = 0; i < order.size(); ++i)
    first[order[i]] =
        i > 0 && nodes[order[i]] == nodes[order[i - 1]] ? first[order[i - 1]] : order[i];
  std::vector<Triangle> result(triangles.begin(), triangles.end());
  for (Triangle& t : result)
    for (std::uint32_t& node : t) node = first[node];
  return result;
}

std::vector<Edge> edgesOf(std::span<const Triangle> triangles) {
  std::vector<std::pair<std::uint32_t, std::uint32_t>> sides;
  sides.reserve(3 * triangles.size());
  for (const Triangle& t : triangles)
    for (int k = 0; k < 3; ++k) sides.push_back(std::minmax(t[k], t[(k + 1) % 3]));
  std::sort(sides.begin(), sides.end());
  std::vector<Edge> edges;
  for (std::size_t i = 0; i < sides.size(); ++i) {
    const bool isInner = i + 1 < sides.size() && sides[i] == sides[i + 1];
    edges.push_back({sides[i].first, sides[i].second, isInner});
    if (isInner) ++i;
  }
  return edges;
}

class Paths {
  static constexpr double kFar = std::numeric_limits<double>::infinity();

 public:
  Paths(std::span<const Vec2> nodes, std::span<const Edge> edges, double longest)
      : nodes_(nodes), longest_(longest) {
    first_.assign(nodes.size() + 1, 0);
    isInner_.assign(nodes.size(), true);
    for (const Edge& e : edges) {
      ++first_[e.low + 1];
      ++first_[e.high + 1];
      if (e.isInner) continue;
      isInner_[e.low] = isInner_[e.high] = false;
      walls_.push_back(e);
    }
    std::partial_sum(first_.begin(), first_.end(), first_.begin());
    std::vector<std::uint32_t> at(first_.begin(), first_.end() - 1);
    links_.resize(first_.back());
    for (const Edge& e : edges) {
      const double length = norm(nodes[e.high] - nodes[e.low]);
      links_[at[e.low]++] = {e.high, length};
      links_[at[e.high]++] = {e.low, length};
    }
    distance_.assign(nodes.size(), kFar);
  }

  void measure(std::size_t sources) {
    std::vector<std::uint32_t> inner;
    for (const std::uint32_t i : orderAlongCurve(nodes_))
      if (isInner_[i] && first_[i + 1] > first_[i]) inner.push_back(i);
    sources = std::min(sources, inner.size());
    for (std::size_t k = 0; k < sources; ++k)
      measureFrom(inner[(2 * k + 1) * inner.size() / (2 * sources)]);
  }

  void report(MeshQuality& quality) const {
    double sum = 0, count = 0, least = kFar, most = 0;
    for (std::size_t i = 0; i < kDirections; ++i) {
      sum += sum_[i];
      count += count_[i];
      quality.paths[i] = sum_[i] / count_[i];
      if (count_[i] == 0) continue;
      least = std::min(least, quality.paths[i]);
      most = std::max(most, quality.paths[i]);
    }
    quality.meanPath = sum / count;
    quality.pathSpread = count > 0 ? most - least : std::numeric_limits<double>::quiet_NaN();
  }

 private:
  struct Link {
    std::uint32_t to;
    double length;
  };

  /// Dijkstra's algorithm, up to the length of the longest path that is accepted.
  void measureFrom(std::uint32_t source) {
    using Entry = std::pair<double, std::uint32_t>;
    wallsNear(nodes_[source]);
    std::priority_queue<Entry, std::vector<Entry>, std::greater<>> queue;
    reach(source, 0);
    queue.emplace(0, source);
    while (!queue.empty()) {
      const auto [distance, node] = queue.top();
      queue.pop();
      if (distance > distance_[node]) continue;
      if (distance > tolerance::kLongestPath * longest_) break;
      count(source, node);
      for (std::uint32_t i = first_[node]; i < first_[node + 1]; ++i) {
        const auto [to, length] = links_[i];
        if (distance + length >= distance_[to]) continue;
        reach(to, distance + length);
        queue.emplace(distance + length, to);
      }
    }
    for (const std::uint32_t node : reached_) distance_[node] = kFar;
    reached_.clear();
  }

  void reach(std::uint32_t node, double distance) {
    if (distance_[node] == kFar) reached_.push_back(node);
    distance_[node] = distance;
  }

  void wallsNear(Vec2 p) {
    near_.clear();
    for (const Edge& e : walls_) {
      const Vec2 a = nodes_[e.low], b = nodes_[e.high];
      if (norm(a - p) < longest_ + norm(b - a)) near_.push_back(e);
    }
  }

  void count(std::uint32_t source, std::uint32_t target) {
    const Vec2 line = nodes_[target] - nodes_[source];
    const double length = norm(line);
    if (!isInner_[target] || length < tolerance::kShortestLine * longest_ || length > longest_)
      return;
    if (leavesBody(nodes_[source], nodes_[target])) return;
    const std::size_t i = directionOf(line);
    sum_[i] += distance_[target] / length;
    count_[i] += 1;
  }

  [[nodiscard]] bool leavesBody(Vec2 p, Vec2 q) const {
    return std::any_of(near_.begin(), near_.end(), [&](const Edge& e) {
      const Vec2 a = nodes_[e.low], b = nodes_[e.high];
      return (cross(q - p, a - p) > 0) != (cross(q - p, b - p) > 0) &&
             (cross(b - a, p - a) > 0) != (cross(b - a, q - a) > 0);
    });
  }

  std::span<const Vec2> nodes_;
  double longest_;  // m, longest line
  std::vector<std::uint32_t> first_;
  std::vector<Link> links_;
  std::vector<bool> isInner_;
  std::vector<Edge> walls_, near_;  // edges of the boundary; those of them near a source
  std::vector<double> distance_;    // m, along edges from the source
  std::vector<std::uint32_t> reached_;
  std::array<double, kDirections> sum_{}, count_{};
};

void countEdges(MeshQuality& quality, std::span<const Vec2> nodes, std::span<const Edge> edges) {
  double inner = 0;
  quality.shortestEdge = std::numeric_limits<double>::infinity();
  for (const Edge& e : edges) {
    const Vec2 d = nodes[e.high] - nodes[e.low];
    quality.shortestEdge = std::min(quality.shortestEdge, norm(d));
    quality.longestEdge = std::max(quality.longestEdge, norm(d));
    if (!e.isInner) continue;
    quality.edges[directionOf(d)] += 1;
    inner += 1;
  }
  for (double& n : quality.edges) {
    n *= kDirections / inner;
    quality.edgeDeviation = std::max(quality.edgeDeviation, std::abs(n - 1));
  }
}

}  // namespace

MeshQuality meshQuality(std::span<const Vec2> nodes, std::span<const Triangle> triangles,
                        std::size_t sources) {
  MeshQuality quality;
  quality.numTriangles = triangles.size();
  quality.minAngle = minAngle(nodes, triangles);
  const std::vector<Triangle> joined = welded(nodes, triangles);
  const std::vector<Edge> edges = edgesOf(joined);
  countEdges(quality, nodes, edges);
  double area = 0;
  for (const Triangle& t : triangles) area += areaOf(nodes[t[0]], nodes[t[1]], nodes[t[2]]);
  // The side of equilateral triangles with the same mean area.
  const double side = std::sqrt(area / (std::sqrt(.1875) * static_cast<double>(joined.size())));
  Paths paths(nodes, edges, std::min(.5 * std::sqrt(area), 50 * side));
  paths.measure(sources);
  paths.report(quality);
  return quality;
}

}  // namespace yadefrag
