#include "meshing/mesh_stages.hpp"

#include <algorithm>
#include <limits>

#include "curve/position_code.hpp"

namespace yadefrag {
namespace {

struct Coded {
  std::uint64_t code;
  std::uint32_t index;
  friend auto operator<=>(const Coded&, const Coded&) = default;
};

}  // namespace

std::vector<std::uint32_t> orderAlongCurve(std::span<const Vec2> points) {
  constexpr double kBoxes = 1 << 20;
  constexpr double inf = std::numeric_limits<double>::infinity();
  Vec2 low = {inf, inf};
  Vec2 high = {-inf, -inf};
  for (const Vec2 p : points) {
    low = {std::min(low.x, p.x), std::min(low.y, p.y)};
    high = {std::max(high.x, p.x), std::max(high.y, p.y)};
  }
  const double side = std::max(high.x - low.x, high.y - low.y);
  const double scale = side > 0 ? kBoxes / side : 0;
  std::vector<Coded> coded;
  coded.reserve(points.size());
  for (std::uint32_t i = 0; i < points.size(); ++i) {
    const auto x = static_cast<std::uint32_t>((points[i].x - low.x) * scale);
    const auto y = static_cast<std::uint32_t>((points[i].y - low.y) * scale);
    coded.push_back({PositionCode<2>::encode({x, y}), i});
  }
  std::sort(coded.begin(), coded.end());
  std::vector<std::uint32_t> order;
  order.reserve(coded.size());
  for (const Coded& c : coded) order.push_back(c.index);
  return order;
}

std::vector<std::uint32_t> numberAlongCurve(TriangleMesh& mesh) {
  std::vector<std::uint32_t> order = orderAlongCurve(mesh.nodes);
  std::vector<std::uint32_t> numberOf(order.size());
  std::vector<Vec2> nodes;
  nodes.reserve(order.size());
  for (std::uint32_t i = 0; i < order.size(); ++i) {
    numberOf[order[i]] = i;
    nodes.push_back(mesh.nodes[order[i]]);
  }
  mesh.nodes = std::move(nodes);
  for (auto& loop : mesh.loops)
    for (std::uint32_t& node : loop) node = numberOf[node];
  for (auto& side : mesh.joints) side[0] = numberOf[side[0]], side[1] = numberOf[side[1]];

  std::vector<Vec2> centroids;
  centroids.reserve(mesh.triangles.size());
  for (auto& t : mesh.triangles) {
    for (std::uint32_t& node : t) node = numberOf[node];
    std::rotate(t.begin(), std::min_element(t.begin(), t.end()), t.end());
    centroids.push_back((mesh.nodes[t[0]] + mesh.nodes[t[1]] + mesh.nodes[t[2]]) * (1. / 3));
  }
  std::vector<std::array<std::uint32_t, 3>> triangles;
  triangles.reserve(mesh.triangles.size());
  for (const std::uint32_t i : orderAlongCurve(centroids)) triangles.push_back(mesh.triangles[i]);
  mesh.triangles = std::move(triangles);
  return order;
}

}  // namespace yadefrag
