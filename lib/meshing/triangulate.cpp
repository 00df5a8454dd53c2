#include "meshing/triangulate.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "core/errors.hpp"
#include "core/tolerances/mesh.hpp"
#include "meshing/mesh_stages.hpp"
#include "meshing/triangle_quality.hpp"

namespace yadefrag {
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
