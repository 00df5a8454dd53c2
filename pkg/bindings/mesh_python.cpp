#include "bindings/calls.hpp"

#include <fmt/core.h>
#include <unistd.h>

#include <algorithm>
#include <limits>

#include "bindings/arrays.hpp"
#include "bodies/rigid_outlines.hpp"
#include "meshing/polygon.hpp"
#include "meshing/triangle_quality.hpp"
#include "meshing/triangulate.hpp"
#include "solver/fe_solver.hpp"
#include "time/critical_time_step.hpp"

namespace yadefrag {

namespace py = yade::py;

Polygon polygonOf(const py::object& outline, const py::list& holes) {
  return {fromArray<Vec2>(outline), fromArrays<Vec2>(holes)};
}

namespace {

/// (bytes) Total memory; other data need a part of it, too.
double memoryOfMachine() {
  return static_cast<double>(sysconf(_SC_PHYS_PAGES)) * static_cast<double>(sysconf(_SC_PAGESIZE));
}

SizeField sizeField(const py::tuple& size) {
  if (py::len(size) == 1) return py::extract<double>(size[0])();
  const Vec2 low = {py::extract<double>(size[0]), py::extract<double>(size[1])};
  return {low, py::extract<double>(size[2]), py::extract<std::uint32_t>(size[3]),
          fromArray<double>(size[4])};
}

/// From arrays that yadefrag/fe/mesh.py has checked.
SharedMesh meshOf(const py::object& nodes, const py::object& triangles, const py::list& loops,
                  const py::list& loopVertices, const py::object& joints, const py::tuple& joined,
                  std::size_t numJoints, const py::object& smooth) {
  SharedMesh mesh(new ScriptMesh);
  mesh->nodes = fromArray<Vec2>(nodes);
  mesh->triangles = fromArray<std::array<std::uint32_t, 3>>(triangles);
  mesh->loops = fromArrays<std::uint32_t>(loops);
  mesh->loopVertices = fromArrays<std::uint32_t>(loopVertices);
  mesh->joints = fromArray<std::array<std::uint32_t, 3>>(joints);
  mesh->joined = {py::extract<std::size_t>(joined[0]), py::extract<double>(joined[1])};
  mesh->numJoints = numJoints;
  mesh->smooth = fromArray<std::uint8_t>(smooth);
  return mesh;
}

/// An array over the mesh's own memory, which it keeps alive.
py::object nodesInPlace(const py::object& self) {
  std::vector<Vec2>& nodes = py::extract<ScriptMesh&>(self)().nodes;
  const py::dict interface =
      dictOf("version", 3, "typestr", "<f8", "shape", py::make_tuple(nodes.size(), 2), "data",
             py::make_tuple(reinterpret_cast<std::uintptr_t>(nodes.data()), false));
  return py::import("numpy").attr("asarray")(
      record("mesh", self, "__array_interface__", interface));
}

/// Keeps the memory, of which there may be arrays.
void moveNodes(ScriptMesh& mesh, const py::object& nodes) {
  const auto places = fromArray<Vec2>(nodes);
  if (places.size() != mesh.nodes.size())
    throw std::invalid_argument(fmt::format("nodes has {} points, it must have {}, as before.",
                                            places.size(), mesh.nodes.size()));
  std::ranges::copy(places, mesh.nodes.begin());
}

/// The mesh of a polygon. `joints` are four numbers each, joined within the tolerance (m). `size`
/// is a tuple: one number (m), or left, bottom and cell (m) of a grid, its columns, and its values.
SharedMesh meshOfPolygon(const py::object& outline, const py::list& holes, const py::tuple& size,
                         bool irregular, std::uint64_t seed, const py::object& joints,
                         double jointTolerance) {
  return asValueError([&] {
    const MeshLayout layout{irregular ? NodeLayout::kScattered : NodeLayout::kRows, seed};
    const Polygon polygon = checkPolygon(polygonOf(outline, holes));
    const SizeField field = sizeField(size);
    const auto lines = fromArray<std::array<Vec2, 2>>(joints);
    return SharedMesh(new ScriptMesh{
        triangulate(polygon, field, layout, memoryOfMachine(), lines, jointTolerance),
        lines.size(),
        {}});
  });
}

/// A regular mesh of a rectangle.
SharedMesh meshOfRectangle(double left, double bottom, double right, double top, int nx, int ny,
                           bool crossed) {
  const QuadPattern pattern = crossed ? QuadPattern::kCrossed : QuadPattern::kUnionJack;
  return SharedMesh(new ScriptMesh{
      {structuredRectangle({left, bottom}, {right, top}, nx, ny, pattern), {}}, 0, {}});
}

/// (m)
double shortestEdge(const TriangleMesh& mesh) {
  double least = std::numeric_limits<double>::infinity();
  for (const auto& t : mesh.triangles)
    for (std::size_t k = 0; k < 3; ++k)
      least = std::min(least, norm(mesh.nodes[t[(k + 1) % 3]] - mesh.nodes[t[k]]));
  return least;
}

/// yadefrag/fe/fields.py has checked the component.
py::dict meshQualityOf(const FESolver& solver, int component) {
  const World& world = solver.world();
  const Component& body = world.model.components[component];
  const TriangleMesh mesh = stressFreeMesh(world.model, ComponentId(component));
  const double side = latticeSide(mesh);
  return dictOf("numTriangles", mesh.triangles.size(), "size", side, "shortestEdge",
                shortestEdge(mesh), "minAngle", minAngle(mesh.nodes, mesh.triangles),
                "timeStepRatio", meshTimeStep(mesh, body) / latticeTimeStep(body, side));
}

/// A message if the component's mesh needs far shorter steps than triangles of `size` (m).
std::string costlyStepWarningOf(const FESolver& solver, int component, double size) {
  const World& world = solver.world();
  const ComponentId id(component);
  return costlyStepWarning(stressFreeMesh(world.model, id), world.model.components[component],
                           size);
}

/// The ratio of these steps for another mesh of the same material.
double costOfMesh(const FESolver& solver, int component, double size, const ScriptMesh& mesh) {
  const Component& body = solver.world().model.components[component];
  return latticeTimeStep(body, size) / meshTimeStep(mesh, body);
}

/// (s) Critical step of equilateral triangles of edges `side` (m), with a material's constants.
double latticeTimeStepOf(double young, double poisson, double density, bool planeStress,
                         double side) {
  Component component;
  component.material = {young, poisson, density, planeStress};
  return latticeTimeStep(component, side);
}

// Outlines

py::list pairsOf(const std::vector<Vec2>& points) {
  py::list pairs;
  for (const Vec2 point : points) pairs.append(py::make_tuple(point.x, point.y));
  return pairs;
}

/// The outline and the holes of meshing/polygon.hpp's checkPolygon, as arrays.
py::list checkedPolygon(const py::object& outline, const py::list& holes) {
  return asValueError([&] {
    Polygon polygon = checkPolygon(polygonOf(outline, holes));
    polygon.holes.insert(polygon.holes.begin(), std::move(polygon.outline));
    return toArrays(polygon.holes);
  });
}

const char* nameOf(Section::Kind kind) {
  if (kind == Section::Kind::kOutline) return "outline";
  return kind == Section::Kind::kLine ? "line" : "wall";
}

/// Sections of all bodies of the present scene that intersect the plane z = 0: records of id, kind,
/// points, with kind 'outline', 'line' or 'wall' and points as in Section, pairs (m).
py::list sectionsOfScene() {
  py::list found;
  for (const auto& body : yade::Omega::instance().getScene()->bodies->body) {
    if (!body || !body->shape || !body->state || !mayHaveSection(*body)) continue;
    const std::optional<Section> section = sectionOf(*body);
    if (!section) continue;
    found.append(record("body", body->id, "kind", nameOf(section->kind), "points",
                        pairsOf(section->points)));
  }
  return found;
}

}  // namespace

void defineMeshes() {
  py::class_<ScriptMesh, SharedMesh, boost::noncopyable>("Mesh", py::no_init)
      .def("__init__", py::make_constructor(
                           &meshOf, py::default_call_policies(),
                           (py::arg("nodes"), py::arg("triangles"), py::arg("loops"),
                            py::arg("loopVertices") = py::list(), py::arg("joints") = py::list(),
                            py::arg("joined") = py::make_tuple(0, 0.), py::arg("numJoints") = 0,
                            py::arg("smooth") = py::list())))
      .add_property(
          "nodes", &nodesInPlace, &moveNodes,
          "Positions (m), array (n, 2), of the mesh itself: a change in it moves the nodes.")
      .add_property(
          "triangles", +[](const ScriptMesh& mesh) { return toArray(mesh.triangles); },
          "Node numbers, counter-clockwise, array (m, 3); a copy, as all but the nodes.")
      .add_property(
          "loops", +[](const ScriptMesh& mesh) { return toArrays(mesh.loops); },
          "List of closed loops of boundary nodes, material on the left: the outline, then the "
          "holes.")
      .add_property(
          "joints", +[](const ScriptMesh& mesh) { return toArray(mesh.joints); },
          "Sides of triangles on joints: both nodes and the number of the joint, array (k, 3).")
      .add_property(
          "joined",
          +[](const ScriptMesh& mesh) {
            return py::make_tuple(mesh.joined.count, mesh.joined.farthest);
          },
          "Number of ends, crossings and bends of joints that were joined with another line, and "
          "their largest displacement (m).")
      .add_property(
          "smooth", +[](const ScriptMesh& mesh) { return toArray(mesh.smooth); },
          +[](ScriptMesh& mesh, const py::object& flags) {
            mesh.smooth = fromArray<std::uint8_t>(flags);
          },
          "1 for nodes on smooth parts of the boundary, array (n); empty: all is straight.")
      .add_property(
          "_loopVertices", +[](const ScriptMesh& mesh) { return toArrays(mesh.loopVertices); })
      .def_readonly("_numJoints", &ScriptMesh::numJoints);
  py::def("meshOfPolygon", &meshOfPolygon);
  py::def("latticeTimeStep", &latticeTimeStepOf);
  py::def("meshOfRectangle", &meshOfRectangle);
  py::def("sectionsOfScene", &sectionsOfScene);
  py::def("checkedPolygon", &checkedPolygon);
}

void defineQuality(SolverClass& solver) {
  solver.def("_costOfMesh", &Locked<costOfMesh>::call)
      .def("_meshQuality", &Locked<meshQualityOf>::call)
      .def("_costlyStepWarning", &Locked<costlyStepWarningOf>::call);
}

}  // namespace yadefrag
