#pragma once
// Meshes of polygons and rectangles for Python, and the quality of a body's mesh.

#include <cstdint>
#include <string>

#include "abi/yade.hpp"
#include "mesh/triangle_mesh.hpp"

namespace yadefrag {

class FESolver;

/// Outline and holes from the bytes of their points.
Polygon polygonOf(const yade::py::object& outline, const yade::py::list& holes);

/// The mesh of a polygon, as a dict of arrays: nodes, triangles, loops, loopVertices, joints (both
/// nodes and the number of the joint, of each side), and joined (how many places of joints, by how
/// many m at most). `joints` are four numbers each, joined within the tolerance (m). `size` is a
/// tuple: one number (m), or left, bottom and cell (m) of a grid, its columns, and its values.
yade::py::dict meshOfPolygon(const yade::py::object& outline, const yade::py::list& holes,
                             const yade::py::tuple& size, bool irregular, std::uint64_t seed,
                             const yade::py::object& joints, double jointTolerance);
/// Numbers of the vertices to keep, of the outline and of each hole: a list of arrays
/// (outline/simplify.hpp). `pinned` has a byte for each point of the outline, or is empty.
yade::py::list keptVertices(const yade::py::object& outline, const yade::py::list& holes,
                            double tolerance, const yade::py::object& pinned);
/// (m, corner counted over all loops) of outline/narrowest.hpp; each loop is the bytes of its
/// points.
yade::py::tuple narrowestOf(const yade::py::list& loops);
/// A regular mesh of a rectangle, as meshOfPolygon.
yade::py::dict meshOfRectangle(double left, double bottom, double right, double top, int nx, int ny,
                               bool crossed);

/// `FESolver._meshQuality` of yadefrag/fe/meshing.py, which has checked the component.
yade::py::dict meshQualityOf(const FESolver& solver, int component);
/// A message if the component's mesh needs far shorter steps than triangles of `size` (m).
std::string costlyStepWarningOf(const FESolver& solver, int component, double size);
/// The ratio of these steps for another mesh of the same material, given as bytes.
double costOfMesh(const FESolver& solver, int component, double size, const yade::py::object& nodes,
                  const yade::py::object& triangles);
/// (s) Critical step of equilateral triangles of edges `side` (m), with a material's constants.
double latticeTimeStepOf(double young, double poisson, double density, bool planeStress,
                         double side);

}  // namespace yadefrag
