#pragma once
// Adds bodies to the model and removes them; its arrays have no gaps.

#include <array>
#include <span>
#include <vector>

#include "mesh/model.hpp"
#include "mesh/triangle_mesh.hpp"

namespace yadefrag {

/// Throws InputError if a triangle has no positive area.
void checkTriangles(const TriangleMesh& mesh);

/// Adds a mesh as a new component: at rest, free, and without stress in its present shape. The
/// function fills in the ranges of triangles and materials of `component`. Throws as
/// checkTriangles. `stress`: initial stress of each triangle in the present shape, Pa (xx, yy, xy);
/// empty: none; `across`: that across the plane, empty or NaN: not given. The stretch of each
/// stress must exist (mesh/initial_stress.hpp).
ComponentId appendBody(Model& model, const TriangleMesh& mesh, const Component& component,
                       const MaterialPlaces& materials = {},
                       std::span<const std::array<double, 3>> stress = {},
                       std::span<const double> across = {});

/// Removes a component's nodes, triangles and materials. The other nodes keep their order, and
/// components keep their ids. Returns the new number of each old node, none() for removed nodes.
std::vector<NodeId> removeBody(Model& model, ComponentId component);

/// Removes only the nodes of all components with a mark in `gone` (by component).
std::vector<NodeId> removeNodes(Model& model, const std::vector<std::uint8_t>& gone);

/// Sets the mass of every node: a third of ρ·area·thickness of each of its triangles.
void lumpMasses(Model& model);

}  // namespace yadefrag
