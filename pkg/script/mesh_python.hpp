#pragma once
// Meshes of polygons and rectangles for Python, and the quality of a body's mesh.

#include <cstdint>
#include <string>

#include "abi/yade.hpp"
#include "meshing/triangulate.hpp"

namespace yadefrag {

class FESolver;

/// `yadefrag.Mesh`: the mesh of a body that is not added yet.
struct ScriptMesh : PolygonMesh {
  std::size_t numJoints = 0;         ///< lines given, also those outside of the polygon
  std::vector<std::uint8_t> smooth;  ///< by node: on a C¹-smooth part of the boundary; empty: none
};
using SharedMesh = yade::shared_ptr<ScriptMesh>;

/// The class for Python; yadefrag/fe/mesh.py adds its constructor and checks.
void defineMesh();

/// Outline and holes from arrays of their points.
Polygon polygonOf(const yade::py::object& outline, const yade::py::list& holes);

/// The mesh of a polygon. `joints` are four numbers each, joined within the tolerance (m). `size`
/// is a tuple: one number (m), or left, bottom and cell (m) of a grid, its columns, and its values.
SharedMesh meshOfPolygon(const yade::py::object& outline, const yade::py::list& holes,
                         const yade::py::tuple& size, bool irregular, std::uint64_t seed,
                         const yade::py::object& joints, double jointTolerance);
/// Numbers of the vertices to keep, of the outline and of each hole: a list of arrays
/// (outline/simplify.hpp). `pinned` has a flag for each point of the outline, or is empty.
yade::py::list keptVertices(const yade::py::object& outline, const yade::py::list& holes,
                            double tolerance, const yade::py::object& pinned);
/// (m, corner counted over all loops) of outline/narrowest.hpp; each loop is an array of
/// its points.
yade::py::tuple narrowestOf(const yade::py::list& loops);
/// A regular mesh of a rectangle.
SharedMesh meshOfRectangle(double left, double bottom, double right, double top, int nx, int ny,
                           bool crossed);

/// `FESolver._meshQuality` of yadefrag/fe/quality.py, which has checked the component.
yade::py::dict meshQualityOf(const FESolver& solver, int component);
/// A message if the component's mesh needs far shorter steps than triangles of `size` (m).
std::string costlyStepWarningOf(const FESolver& solver, int component, double size);
/// The ratio of these steps for another mesh of the same material.
double costOfMesh(const FESolver& solver, int component, double size, const ScriptMesh& mesh);
/// (s) Critical step of equilateral triangles of edges `side` (m), with a material's constants.
double latticeTimeStepOf(double young, double poisson, double density, bool planeStress,
                         double side);

}  // namespace yadefrag
