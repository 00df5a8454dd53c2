#include "mesh/triangulate.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <numeric>

#include "core/errors.hpp"
#include "core/tolerances/mesh.hpp"
#include "mesh/delaunay.hpp"
#include "mesh/divided_boundary.hpp"
#include "mesh/interior_front.hpp"
#include "mesh/mesh_improvement.hpp"
#include "mesh/numbering.hpp"
#include "mesh/quality.hpp"

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

}  // namespace

TriangleMesh triangulate(const Polygon& polygon, const SizeField& size, MeshLayout layout,
                         double mostBytes, const JointLines& joints) {
  const DividedBoundary boundary = divideBoundary(polygon, size, mostBytes, joints);
  LinkedTriangles linked = triangulateNodes(boundary, fillInterior(boundary, size, layout));
  improve(linked, layout.nodes == NodeLayout::kScattered);

  TriangleMesh mesh;
  mesh.nodes = std::move(linked.nodes);
  mesh.triangles = std::move(linked.triangles);
  for (std::size_t i = 0; i < boundary.numLoops(); ++i) {
    const std::uint32_t begin = boundary.first[i], end = boundary.first[i + 1];
    std::vector<std::uint32_t>& loop = mesh.loops.emplace_back(end - begin);
    std::iota(loop.begin(), loop.end(), begin);
    mesh.loopVertices.emplace_back(boundary.vertex.begin() + begin, boundary.vertex.begin() + end);
  }
  mesh.joints = boundary.joints;
  numberAlongCurve(mesh);
  mesh.minAngle = minAngle(mesh.nodes, mesh.triangles);
  checkThinnest(mesh);
  return mesh;
}

}  // namespace yadefrag
