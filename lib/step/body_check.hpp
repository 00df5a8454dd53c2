#pragma once
// Checks the mesh and the specification of a body.

#include "mesh/triangle_mesh.hpp"

namespace yadefrag {

struct BodySpec;

/// Throws InputError, which states the invalid value and the valid range, unless every value is
/// valid: finite, with the correct sign, one for each node of the mesh, and no triangle with a mass
/// or stiffness out of range.
void checkBody(const TriangleMesh& mesh, const BodySpec& spec);

}  // namespace yadefrag
