#pragma once
// Outlines that are moved onto bodies or onto one another (outline/snap.hpp), for Python.

#include <stdexcept>
#include <string>

#include "abi/yade.hpp"

namespace yadefrag {

class FESolver;

/// A body that addMesh does not add, since it would overlap another one by `depth` (m).
struct OverlapFound : std::invalid_argument {
  OverlapFound(const std::string& message, double deep)
      : std::invalid_argument(message), depth(deep) {}
  double depth;
};

/// `FESolver._addMesh`: (component, '', 0), or, without any change, (-1, message, depth) for a body
/// that would overlap another one.
yade::py::tuple addMeshIfApart(FESolver& solver, const yade::py::dict& input);

/// `FESolver._snap`: (loops, moved, inserted, farthest); `rule` is (tolerance, spacing,
/// matchesNodes). A loop is (points (n, 2), vertex (n), isInserted (n)). Points are given as bytes.
yade::py::tuple snapOf(const FESolver& solver, const yade::py::object& outline,
                       const yade::py::list& holes, const yade::py::tuple& rule);

/// The same for a list of (outline, holes): a list of such tuples.
yade::py::list snapTogetherOf(const yade::py::list& polygons, double tolerance);

}  // namespace yadefrag
