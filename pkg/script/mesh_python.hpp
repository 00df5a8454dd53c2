#pragma once
// The mesh of a body that is not added yet, for Python.

#include <cstdint>

#include "abi/yade.hpp"
#include "meshing/triangulate.hpp"

namespace yadefrag {

/// `yadefrag.Mesh`: the mesh of a body that is not added yet.
struct ScriptMesh : PolygonMesh {
  std::size_t numJoints = 0;         ///< lines given, also those outside of the polygon
  std::vector<std::uint8_t> smooth;  ///< by node: on a C¹-smooth part of the boundary; empty: none
};
using SharedMesh = yade::shared_ptr<ScriptMesh>;

/// Outline and holes from arrays of their points.
Polygon polygonOf(const yade::py::object& outline, const yade::py::list& holes);

}  // namespace yadefrag
