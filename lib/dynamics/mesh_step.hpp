#pragma once
// The effect of a body's mesh on the time step.

#include <string>

#include "mesh/model.hpp"
#include "mesh/triangle_mesh.hpp"

namespace yadefrag {

/// The stress-free mesh of one component, with new node numbers, without loops and removed
/// triangles. `reference` are the stress-free positions of the model's nodes.
[[nodiscard]] TriangleMesh stressFreeMesh(const Model& model, ComponentId component);

/// (s) Critical time step of a stress-free mesh with a component's material.
[[nodiscard]] double meshTimeStep(const TriangleMesh& mesh, const Component& component);

/// (s) Critical time step of an even lattice: equilateral triangles with edges of `side` (m).
[[nodiscard]] double latticeTimeStep(const Component& component, double side);

/// (m) Edges of an even lattice with the same area and number of triangles.
[[nodiscard]] double latticeSide(const TriangleMesh& mesh);

/// A message if the critical step of the mesh is less than a third of that of a lattice with edges
/// of `size` (m): it names the place and its effect. Otherwise an empty string.
[[nodiscard]] std::string costlyStepWarning(const TriangleMesh& mesh, const Component& component,
                                            double size);

}  // namespace yadefrag
