#pragma once
// Arrays between C++ and Python: results are NumPy arrays (copies), input is the bytes of such
// arrays.

#include <cstring>
#include <stdexcept>
#include <vector>

#include "abi/yade.hpp"
#include "core/errors.hpp"

namespace yadefrag {

class FESolver;

/// A new NumPy array of `dtype`, of `rows` rows and, unless it is 0, `columns` columns.
yade::py::object toArray(const void* data, std::size_t bytes, const char* dtype, std::size_t rows,
                         int columns);

template <class Element>
yade::py::object toArray(const std::vector<Element>& column, const char* dtype, int columns) {
  return toArray(column.data(), column.size() * sizeof(Element), dtype, column.size(), columns);
}

/// The contents of a Python `bytes`, as elements.
template <class Element>
std::vector<Element> fromBytes(const yade::py::object& bytes) {
  char* data = nullptr;
  Py_ssize_t size = 0;
  if (PyBytes_AsStringAndSize(bytes.ptr(), &data, &size) != 0) yade::py::throw_error_already_set();
  std::vector<Element> column(static_cast<std::size_t>(size) / sizeof(Element));
  if (!column.empty())
    std::memcpy(static_cast<void*>(column.data()), data, column.size() * sizeof(Element));
  return column;
}

/// `FESolver._addMesh` of yadefrag/fe/solver.py, which has checked all input.
int addMesh(FESolver& solver, const yade::py::dict& input);

void takeBody(FESolver& solver, int component);

/// `FESolver._setLoads` and `_prescribe`, likewise; one velocity for each node.
void setLoads(FESolver& solver, const yade::py::object& loads);
void prescribe(FESolver& solver, const yade::py::object& nodes, int held,
               const yade::py::object& velocities);
/// `FESolver._move`: `motion` is a dict of centre (a pair, m), speedX, speedY, turn (pairs of bytes
/// of times and values, empty for none) and function (None for tables only).
void prescribeMotion(FESolver& solver, const yade::py::object& nodes, int held,
                     const yade::py::dict& motion);

/// `FESolver._pressure`: times and values of a table as bytes, or a function (s) → Pa.
void setPressure(FESolver& solver, const yade::py::object& nodes, const yade::py::object& times,
                 const yade::py::object& values, const yade::py::object& function, bool intoCracks);
void setAbsorbing(FESolver& solver, const yade::py::object& nodes);

yade::py::object reactionsOf(const FESolver& solver);
yade::py::object loadsOf(const FESolver& solver);
yade::py::object nodesOf(const FESolver& solver);
/// `component` must exist.
yade::py::object nodesOfBody(const FESolver& solver, int component);
bool isGone(const FESolver& solver, int component);
/// Names by component, '' for those without a name.
yade::py::list namesOf(const FESolver& solver);
yade::py::object velocitiesOf(const FESolver& solver);
yade::py::object displacementsOf(const FESolver& solver);
yade::py::object massesOf(const FESolver& solver);
yade::py::object trianglesOf(const FESolver& solver);
yade::py::object stressArrayOf(const FESolver& solver);
yade::py::object componentsOf(const FESolver& solver);
yade::py::object materialNumbersOf(const FESolver& solver);
yade::py::object fragmentOf(const FESolver& solver);
yade::py::object referenceOf(const FESolver& solver);
yade::py::object contactForcesOf(const FESolver& solver);
yade::py::list surfacesOf(const FESolver& solver);
/// Number of segments, without removed ones.
std::size_t segmentsOf(const FESolver& solver);
yade::py::dict droppedOf(const FESolver& solver);
yade::py::dict energyOf(const FESolver& solver);
/// (J) Energy that the time integration has created, the largest energy that the bodies could have,
/// and the energy of rounding errors.
yade::py::tuple energyBalanceOf(const FESolver& solver);
yade::py::list warningsOf(const FESolver& solver);
yade::py::list fragmentsOf(const FESolver& solver, bool held);

/// Runs `work`, and converts an InputError to Python's ValueError.
template <class Work>
auto asValueError(Work&& work) {
  try {
    return work();
  } catch (const InputError& error) {
    throw std::invalid_argument(error.what());
  }
}

}  // namespace yadefrag
