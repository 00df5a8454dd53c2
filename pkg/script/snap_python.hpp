#pragma once
// Outlines that are moved onto bodies or onto one another (outline/snap.hpp), for Python.

#include "abi/yade.hpp"

namespace yadefrag {

class FESolver;

/// `FESolver._snap`: (loops, moved, inserted, farthest); `rule` is (tolerance, spacing,
/// matchesNodes). A loop is (points (n, 2), vertex (n), isInserted (n)).
yade::py::tuple snapOf(const FESolver& solver, const yade::py::object& outline,
                       const yade::py::list& holes, const yade::py::tuple& rule);

/// The same for a list of (outline, holes): a list of such tuples.
yade::py::list snapTogetherOf(const yade::py::list& polygons, double tolerance);

}  // namespace yadefrag
