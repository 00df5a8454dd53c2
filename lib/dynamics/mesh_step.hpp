#pragma once
// What a body's mesh costs in time steps.

#include <string>

#include "mesh/model.hpp"
#include "mesh/triangle_mesh.hpp"

namespace yadefrag {

/// The stress-free mesh of one component, nodes renumbered, without loops and dropped triangles.
/// `reference` are the stress-free positions of the model's nodes.
[[nodiscard]] TriangleMesh stressFreeMesh(const Model& model, const std::vector<Vec2>& reference,
                                          ComponentId component);

/// (s) Critical time step of a stress-free mesh of a component's material.
[[nodiscard]] double meshTimeStep(const TriangleMesh& mesh, const Component& component);

/// (s) That of an even lattice, of equilateral triangles of edges `side` (m).
[[nodiscard]] double latticeTimeStep(const Component& component, double side);

/// (m) Edges of an even lattice with as many triangles in as much area.
[[nodiscard]] double latticeSide(const TriangleMesh& mesh);

/// A sentence where the critical step of the mesh is less than a third of that of a lattice with
/// edges of `size` (m), else empty: which place costs how much.
[[nodiscard]] std::string costlyStepWarning(const TriangleMesh& mesh, const Component& component,
                                            double size);

}  // namespace yadefrag
