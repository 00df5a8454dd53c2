#include "script/snap_python.hpp"

#include <mutex>

#include "fe/fe_solver.hpp"
#include "fe/running.hpp"
#include "script/fe_arrays.hpp"
#include "script/mesh_python.hpp"
#include "step/coverage.hpp"
#include "step/overlap_check.hpp"

namespace yadefrag {

namespace py = yade::py;

namespace {

py::tuple toTuple(const Snapped& snapped) {
  py::list loops;
  for (const SnappedLoop& loop : snapped.loops)
    loops.append(py::make_tuple(toArray(loop.points, "float64", 2),
                                toArray(loop.vertex, "uint32", 0),
                                toArray(loop.isInserted, "uint8", 0)));
  const SnapCount& count = snapped.count;
  return py::make_tuple(loops, count.moved, count.inserted, count.farthest);
}

}  // namespace

py::tuple snapOf(const FESolver& solver, const py::object& outline, const py::list& holes,
                 const py::tuple& rule) {
  requirePaused();
  const std::lock_guard guard(solver.betweenSteps());
  return asValueError([&] {
    return toTuple(snapOnBodies(
        solver.world(), polygonOf(outline, holes),
        {py::extract<double>(rule[0]), py::extract<double>(rule[1]), py::extract<bool>(rule[2])}));
  });
}

py::tuple addMeshIfApart(FESolver& solver, const py::dict& input) {
  try {
    return py::make_tuple(addMesh(solver, input), "", 0.);
  } catch (const OverlapFound& overlap) {
    return py::make_tuple(-1, overlap.what(), overlap.depth);
  }
}

py::list snapTogetherOf(const py::list& polygons, double tolerance) {
  return asValueError([&] {
    std::vector<Polygon> given(static_cast<std::size_t>(py::len(polygons)));
    for (std::size_t i = 0; i < given.size(); ++i)
      given[i] = polygonOf(polygons[i][0], py::list(polygons[i][1]));
    py::list result;
    for (const Snapped& one : snapTogether(std::move(given), tolerance))
      result.append(toTuple(one));
    return result;
  });
}

}  // namespace yadefrag
