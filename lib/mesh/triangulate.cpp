#include "mesh/triangulate.hpp"

#include <numeric>

#include "mesh/delaunay.hpp"
#include "mesh/divided_boundary.hpp"
#include "mesh/interior_front.hpp"
#include "mesh/mesh_improvement.hpp"
#include "mesh/numbering.hpp"
#include "mesh/quality.hpp"

namespace yadefrag {

TriangleMesh triangulate(const Polygon& polygon, double size) {
  const DividedBoundary boundary = divideBoundary(polygon, size);
  LinkedTriangles linked = triangulateNodes(boundary, fillInterior(boundary, size));
  improve(linked);

  TriangleMesh mesh;
  mesh.nodes = std::move(linked.nodes);
  mesh.triangles = std::move(linked.triangles);
  for (std::size_t i = 0; i < boundary.numLoops(); ++i) {
    const std::uint32_t begin = boundary.first[i], end = boundary.first[i + 1];
    std::vector<std::uint32_t>& loop = mesh.loops.emplace_back(end - begin);
    std::iota(loop.begin(), loop.end(), begin);
    mesh.loopVertices.emplace_back(boundary.vertex.begin() + begin, boundary.vertex.begin() + end);
  }
  numberAlongCurve(mesh);
  mesh.minAngle = minAngle(mesh.nodes, mesh.triangles);
  return mesh;
}

}  // namespace yadefrag
