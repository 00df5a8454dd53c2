#pragma once
// Can a body be what its mesh and its spec say?

#include "mesh/triangle_mesh.hpp"

namespace yadefrag {

struct BodySpec;

/// Throws InputError, which names what is wrong and what would be right, unless every value can be
/// meant: finite, of its sign, one for each node of the mesh, and no triangle too light to be
/// moved.
void checkBody(const TriangleMesh& mesh, const BodySpec& spec);

}  // namespace yadefrag
