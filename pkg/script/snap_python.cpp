#include "script/snap_python.hpp"

#include "script/arrays.hpp"
#include "script/calls.hpp"
#include "script/mesh_python.hpp"
#include "step/coverage.hpp"

namespace yadefrag {

namespace py = yade::py;

namespace {

py::tuple toTuple(const Snapped& snapped) {
  py::list loops;
  for (const SnappedLoop& loop : snapped.loops)
    loops.append(
        py::make_tuple(toArray(loop.points), toArray(loop.vertex), toArray(loop.isInserted)));
  const SnapCount& count = snapped.count;
  return py::make_tuple(loops, count.moved, count.inserted, count.farthest);
}

}  // namespace

py::tuple snapOf(const FESolver& solver, const py::object& outline, const py::list& holes,
                 const py::tuple& rule) {
  return change(solver, [&] {
    return toTuple(snapOnBodies(
        solver.world(), polygonOf(outline, holes),
        {py::extract<double>(rule[0]), py::extract<double>(rule[1]), py::extract<bool>(rule[2])}));
  });
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
