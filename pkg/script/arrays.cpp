#include "script/arrays.hpp"

#include <stdexcept>
#include <string>

namespace yadefrag {

namespace py = yade::py;

py::object newArray(const void* data, std::size_t bytes, const char* type, std::size_t rows,
                    int columns) {
  const py::object shape =
      columns > 0 ? py::object(py::make_tuple(rows, columns)) : py::object(rows);
  py::object array = py::import("numpy").attr("empty")(shape, type);
  Py_buffer view;
  if (PyObject_GetBuffer(array.ptr(), &view, PyBUF_CONTIG) != 0) py::throw_error_already_set();
  if (bytes > 0) std::memcpy(view.buf, data, bytes);
  PyBuffer_Release(&view);
  return array;
}

ArrayMemory::ArrayMemory(const py::object& array, const char* type, int columns) {
  // The view keeps the converted array alive.
  const py::object same = py::import("numpy").attr("ascontiguousarray")(array, type);
  if (PyObject_GetBuffer(same.ptr(), &view_, PyBUF_ND) != 0) py::throw_error_already_set();
  const bool isRight = columns > 0 ? view_.ndim == 2 && view_.shape[1] == columns : view_.ndim == 1;
  if (isRight || view_.len == 0) return;
  PyBuffer_Release(&view_);
  throw std::invalid_argument("An array has " + std::to_string(view_.ndim) +
                              " dimensions or rows of a wrong length; rows must have " +
                              std::to_string(columns > 0 ? columns : 1) + " numbers.");
}

}  // namespace yadefrag
