#include "script/mesh_python.hpp"

#include <unistd.h>

#include "dynamics/mesh_step.hpp"
#include "fe/fe_solver.hpp"
#include "meshing/mesh_quality.hpp"
#include "meshing/structured.hpp"
#include "meshing/triangulate.hpp"
#include "outline/narrowest.hpp"
#include "outline/polygon.hpp"
#include "outline/simplify.hpp"
#include "script/fe_arrays.hpp"

namespace yadefrag {

namespace py = yade::py;

namespace {

/// (bytes) Total memory; other data need a part of it, too.
double memoryOfMachine() {
  return static_cast<double>(sysconf(_SC_PHYS_PAGES)) * static_cast<double>(sysconf(_SC_PAGESIZE));
}

py::dict toDict(const TriangleMesh& mesh) {
  py::dict result;
  py::list loops, vertices;
  for (const auto& loop : mesh.loops) loops.append(toArray(loop, "uint32", 0));
  for (const auto& loop : mesh.loopVertices) vertices.append(toArray(loop, "uint32", 0));
  result["nodes"] = toArray(mesh.nodes, "float64", 2);
  result["triangles"] = toArray(mesh.triangles, "uint32", 3);
  result["joints"] = toArray(mesh.joints, "uint32", 3);
  result["loops"] = loops;
  result["loopVertices"] = vertices;
  return result;
}

SizeField sizeField(const py::tuple& size) {
  if (py::len(size) == 1) return py::extract<double>(size[0])();
  const Vec2 low = {py::extract<double>(size[0]), py::extract<double>(size[1])};
  return {low, py::extract<double>(size[2]), py::extract<std::uint32_t>(size[3]),
          fromBytes<double>(size[4])};
}

}  // namespace

Polygon polygonOf(const py::object& outline, const py::list& holes) {
  Polygon polygon;
  polygon.outline = fromBytes<Vec2>(outline);
  for (int i = 0; i < py::len(holes); ++i) polygon.holes.push_back(fromBytes<Vec2>(holes[i]));
  return polygon;
}

py::dict meshOfPolygon(const py::object& outline, const py::list& holes, const py::tuple& size,
                       bool irregular, std::uint64_t seed, const py::object& joints,
                       double jointTolerance) {
  return asValueError([&] {
    const MeshLayout layout{irregular ? NodeLayout::kScattered : NodeLayout::kRows, seed};
    const Polygon polygon = checkPolygon(polygonOf(outline, holes));
    const SizeField field = sizeField(size);
    const auto lines = fromBytes<std::array<Vec2, 2>>(joints);
    const PolygonMesh made =
        triangulate(polygon, field, layout, memoryOfMachine(), lines, jointTolerance);
    py::dict mesh = toDict(made);
    mesh["joined"] = py::make_tuple(made.joined.count, made.joined.farthest);
    return mesh;
  });
}

py::list keptVertices(const py::object& outline, const py::list& holes, double tolerance,
                      const py::object& pinned) {
  return asValueError([&] {
    py::list kept;
    for (const auto& loop :
         verticesToKeep(polygonOf(outline, holes), tolerance, fromBytes<std::uint8_t>(pinned)))
      kept.append(toArray(loop, "uint32", 0));
    return kept;
  });
}

py::tuple narrowestOf(const py::list& loops) {
  std::vector<std::vector<Vec2>> points(static_cast<std::size_t>(py::len(loops)));
  for (std::size_t i = 0; i < points.size(); ++i) points[i] = fromBytes<Vec2>(loops[i]);
  const NarrowPlace place = narrowestPlace(points);
  return py::make_tuple(place.distance, place.corner);
}

py::dict meshOfRectangle(double left, double bottom, double right, double top, int nx, int ny,
                         bool crossed) {
  const QuadPattern pattern = crossed ? QuadPattern::kCrossed : QuadPattern::kUnionJack;
  return toDict(structuredRectangle({left, bottom}, {right, top}, nx, ny, pattern));
}

py::dict meshQualityOf(const FESolver& solver, int component) {
  const World& world = solver.world();
  const Component& body = world.model.components[component];
  const TriangleMesh mesh = stressFreeMesh(world.model, world.reference, ComponentId(component));
  const MeshQuality quality = meshQuality(mesh.nodes, mesh.triangles);
  const auto byDirection = [](const auto& values) {
    return toArray(std::vector<double>(values.begin(), values.end()), "float64", 0);
  };
  py::dict result;
  result["numTriangles"] = quality.numTriangles;
  result["size"] = latticeSide(mesh);
  result["shortestEdge"] = quality.shortestEdge;
  result["minAngle"] = quality.minAngle;
  result["timeStepRatio"] = meshTimeStep(mesh, body) / latticeTimeStep(body, latticeSide(mesh));
  result["pathRatio"] = quality.meanPath;
  result["pathSpread"] = quality.pathSpread;
  result["edgeDeviation"] = quality.edgeDeviation;
  result["pathRatioByDirection"] = byDirection(quality.paths);
  result["edgesByDirection"] = byDirection(quality.edges);
  return result;
}

std::string costlyStepWarningOf(const FESolver& solver, int component, double size) {
  const World& world = solver.world();
  const ComponentId id(component);
  return costlyStepWarning(stressFreeMesh(world.model, world.reference, id),
                           world.model.components[component], size);
}

double costOfMesh(const FESolver& solver, int component, double size, const py::object& nodes,
                  const py::object& triangles) {
  TriangleMesh mesh;
  mesh.nodes = fromBytes<Vec2>(nodes);
  mesh.triangles = fromBytes<std::array<std::uint32_t, 3>>(triangles);
  const Component& body = solver.world().model.components[component];
  return latticeTimeStep(body, size) / meshTimeStep(mesh, body);
}

double latticeTimeStepOf(double young, double poisson, double density, bool planeStress,
                         double side) {
  Component component;
  component.material = {young, poisson, density, planeStress};
  return latticeTimeStep(component, side);
}

}  // namespace yadefrag
