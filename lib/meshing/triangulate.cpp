#include "meshing/triangulate.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <string>

#include "core/errors.hpp"
#include "core/tolerances/mesh.hpp"
#include "meshing/mesh_stages.hpp"
#include "meshing/triangle_quality.hpp"
#include "search/position_code.hpp"

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

namespace {

class Grid {
 public:
  Grid(Vec2 low, Vec2 high, int nx, int ny) : low_(low), high_(high), nx_(nx), ny_(ny) {}

  TriangleMesh build(QuadPattern pattern) {
    for (int j = 0; j <= ny_; ++j)
      for (int i = 0; i <= nx_; ++i) mesh_.nodes.push_back({x(i), y(j)});
    for (int j = 0; j < ny_; ++j)
      for (int i = 0; i < nx_; ++i)
        pattern == QuadPattern::kCrossed ? addCrossed(i, j) : addDiagonal(i, j);
    addLoop();
    numberAlongCurve(mesh_);
    mesh_.minAngle = minAngle(mesh_.nodes, mesh_.triangles);
    return std::move(mesh_);
  }

 private:
  // Computed from the nearer end, so that the grid is symmetric to the last bit.
  static double between(double a, double b, int i, int n) {
    if (2 * i == n) return (a + b) / 2;
    return 2 * i < n ? a + (b - a) * i / n : b - (b - a) * (n - i) / n;
  }
  [[nodiscard]] double x(int i) const { return between(low_.x, high_.x, i, nx_); }
  [[nodiscard]] double y(int j) const { return between(low_.y, high_.y, j, ny_); }
  [[nodiscard]] std::uint32_t node(int i, int j) const {
    return static_cast<std::uint32_t>(j) * (nx_ + 1) + i;
  }

  void addDiagonal(int i, int j) {
    const std::uint32_t a = node(i, j), b = node(i + 1, j), c = node(i + 1, j + 1),
                        d = node(i, j + 1);
    if ((i + j) % 2 == 0) {
      mesh_.triangles.push_back({a, b, c});
      mesh_.triangles.push_back({a, c, d});
    } else {
      mesh_.triangles.push_back({a, b, d});
      mesh_.triangles.push_back({b, c, d});
    }
  }

  void addCrossed(int i, int j) {
    const std::array<std::uint32_t, 4> corner = {node(i, j), node(i + 1, j), node(i + 1, j + 1),
                                                 node(i, j + 1)};
    const auto middle = static_cast<std::uint32_t>(mesh_.nodes.size());
    mesh_.nodes.push_back({between(low_.x, high_.x, 2 * i + 1, 2 * nx_),
                           between(low_.y, high_.y, 2 * j + 1, 2 * ny_)});
    for (int k = 0; k < 4; ++k) mesh_.triangles.push_back({corner[k], corner[(k + 1) % 4], middle});
  }

  void addLoop() {
    std::vector<std::uint32_t> loop;
    std::vector<std::uint32_t> vertices;
    const auto add = [&](int i, int j, std::uint32_t vertex) {
      loop.push_back(node(i, j));
      vertices.push_back(vertex);
    };
    for (int i = 0; i < nx_; ++i) add(i, 0, 0);
    for (int j = 0; j < ny_; ++j) add(nx_, j, 1);
    for (int i = nx_; i > 0; --i) add(i, ny_, 2);
    for (int j = ny_; j > 0; --j) add(0, j, 3);
    mesh_.loops.push_back(std::move(loop));
    mesh_.loopVertices.push_back(std::move(vertices));
  }

  Vec2 low_;
  Vec2 high_;
  int nx_;
  int ny_;
  TriangleMesh mesh_;
};

}  // namespace

TriangleMesh structuredRectangle(Vec2 low, Vec2 high, int nx, int ny, QuadPattern pattern) {
  if (!isFinite(low) || !isFinite(high) || !(low.x < high.x) || !(low.y < high.y))
    throw InputError(fmt::format(
        "Rectangle: its corners ({:g}, {:g}) and ({:g}, {:g}) must be finite, the second "
        "above and to the right of the first.",
        low.x, low.y, high.x, high.y));
  if (nx < 1 || ny < 1 || 4. * nx * ny > tolerance::kMostTriangles)
    throw InputError(fmt::format(
        "Rectangle: {} × {} quads; there must be at least one each way and in all fewer than {}.",
        nx, ny, static_cast<long>(tolerance::kMostTriangles / 4)));
  return Grid(low, high, nx, ny).build(pattern);
}

namespace {

void checkThinnest(const TriangleMesh& mesh) {
  if (mesh.minAngle > tolerance::kLeastAngle) return;
  const auto thinnest = std::min_element(
      mesh.triangles.begin(), mesh.triangles.end(), [&](const auto& a, const auto& b) {
        return tanMinAngle(mesh.nodes[a[0]], mesh.nodes[a[1]], mesh.nodes[a[2]]) <
               tanMinAngle(mesh.nodes[b[0]], mesh.nodes[b[1]], mesh.nodes[b[2]]);
      });
  const Vec2 p = mesh.nodes[(*thinnest)[0]];
  throw InputError(
      fmt::format("Polygon: at ({:.9g}, {:.9g}) it is so thin that a triangle would have no area; "
                  "move its vertices and edges farther apart there.",
                  p.x, p.y));
}

/// Coordinates in sizes, from the lower left corner of the boundary on.
struct MeshUnits {
  explicit MeshUnits(const DividedBoundary& boundary, const SizeField& size)
      : unit(size.smallest()), low(boundary.nodes[0]) {
    double shortest = unit;
    for (const Vec2 p : boundary.nodes) low = {std::min(low.x, p.x), std::min(low.y, p.y)};
    boundary.forEachEdge([&](std::uint32_t a, std::uint32_t b) {
      shortest = std::min(shortest, norm(boundary.nodes[b] - boundary.nodes[a]));
    });
    // A power of two; halves of it are told apart from rounding, too.
    place = tolerance::kMeshPlaces *
            std::exp2(std::floor(std::log2(shortest / unit) + tolerance::kHalf));
  }

  [[nodiscard]] Vec2 rounded(Vec2 p) const {
    const auto one = [&](double x) { return std::round(x / unit / place) * place; };
    return {one(p.x - low.x), one(p.y - low.y)};
  }

  double unit;  // m
  Vec2 low;     // m
  double place = 0;
};

}  // namespace

PolygonMesh triangulate(const Polygon& polygon, const SizeField& size, MeshLayout layout,
                        double mostBytes, const JointLines& joints, double jointTolerance) {
  DividedBoundary boundary = divideBoundary(polygon, size, mostBytes, joints, jointTolerance);
  const MeshUnits units(boundary, size);
  for (Vec2& p : boundary.nodes) p = units.rounded(p);
  const SizeField field = size.inUnits(units.unit, units.low);
  LinkedTriangles linked = triangulateNodes(boundary, fillInterior(boundary, field, layout));
  improve(linked, layout.nodes == NodeLayout::kScattered);

  PolygonMesh mesh;
  mesh.nodes = std::move(linked.nodes);
  mesh.triangles = std::move(linked.triangles);
  for (std::size_t i = 0; i < boundary.numLoops(); ++i) {
    const std::uint32_t begin = boundary.first[i], end = boundary.first[i + 1];
    std::vector<std::uint32_t>& loop = mesh.loops.emplace_back(end - begin);
    std::iota(loop.begin(), loop.end(), begin);
    mesh.loopVertices.emplace_back(boundary.vertex.begin() + begin, boundary.vertex.begin() + end);
  }
  mesh.joints = boundary.joints;
  mesh.joined = boundary.joined;
  const std::vector<std::uint32_t> order = numberAlongCurve(mesh);
  for (std::size_t i = 0; i < order.size(); ++i)
    mesh.nodes[i] = order[i] < boundary.given.size() ? boundary.given[order[i]]
                                                     : units.low + units.unit * mesh.nodes[i];
  mesh.minAngle = minAngle(mesh.nodes, mesh.triangles);
  checkThinnest(mesh);
  return mesh;
}

}  // namespace yadefrag
