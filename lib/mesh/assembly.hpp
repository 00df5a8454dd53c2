#pragma once
// Bodies join and leave the model; its arrays stay without gaps.

#include <array>
#include <span>
#include <vector>

#include "mesh/model.hpp"
#include "mesh/triangle_mesh.hpp"

namespace yadefrag {

/// Throws InputError if a triangle has no positive area.
void checkTriangles(const TriangleMesh& mesh);

/// Adds a mesh, at rest, free, and without stress where its nodes are, as a new component (the
/// ranges of triangles and materials in `component` are filled in). Throws as checkTriangles.
/// `stress`: Pa (xx, yy, xy), by triangle, that it has where its nodes are; empty: none. Each must
/// have a stretch (mesh/initial_stress.hpp).
ComponentId appendBody(Model& model, const TriangleMesh& mesh, const Component& component,
                       const MaterialPlaces& materials = {},
                       std::span<const std::array<double, 3>> stress = {});

/// Takes away a component's nodes, triangles and materials; the others keep their order and
/// components their ids. Returns the new number of each old node, none() for those that are gone.
std::vector<NodeId> removeBody(Model& model, ComponentId component);

/// The nodes alone, of all components that are `gone` (by component).
std::vector<NodeId> removeNodes(Model& model, const std::vector<std::uint8_t>& gone);

/// Sets the mass of every node: a third of ρ·area·thickness of each of its triangles.
void lumpMasses(Model& model);

}  // namespace yadefrag
