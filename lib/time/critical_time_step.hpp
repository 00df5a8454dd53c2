#pragma once
// The critical time step of the present mesh, and the effect of a body's mesh on it.

#include <string>

#include "elements/element_kernel.hpp"
#include "mesh/model.hpp"
#include "mesh/triangle_mesh.hpp"

namespace yadefrag {

/// (s) Each node's mass is divided among its elements. For any such division no mode of the
/// assembled mesh is faster than the fastest mode of a single element with its part of the masses,
/// whose frequency ω is known exactly. The leapfrog scheme is stable up to 2/ω, with bulk viscosity
/// up to (2/ω)(√(1+ζ²) − ζ). With a division by stiffness, the bound is some 1.2 to 1.3 times below
/// the exact value. Bodies that can crack get equal thirds, 1.6 to 1.8 times below: nodes split in
/// that way, and a separated element has that frequency. The smallest altitude over the wave speed
/// is not a bound: it is a quarter too long for a single equilateral triangle. The result is
/// infinite without elements, and 0 if a value overflows.
double criticalTimeStep(const Model& model, const BulkViscosity& viscosity = {}, int threads = 1);

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
