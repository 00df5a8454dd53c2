#include "meshing/triangulate.hpp"

#include <fmt/core.h>

#include <string>

#include "core/errors.hpp"
#include "core/tolerances/mesh.hpp"
#include "meshing/mesh_stages.hpp"
#include "meshing/triangle_quality.hpp"

namespace yadefrag {
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

}  // namespace yadefrag
