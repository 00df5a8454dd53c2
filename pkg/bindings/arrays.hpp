#pragma once
// Arrays between C++ and Python: the one place where a column becomes a NumPy array, and the
// reverse. Several results are an object with an attribute for each.

#include <array>
#include <cstdint>
#include <cstring>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <vector>

#include "core/ids.hpp"
#include "core/vec2.hpp"
#include "yade/yade.hpp"

namespace yadefrag {

/// NumPy's type of an element, and its numbers in a row; 0: the array has one dimension.
template <class Element>
struct ArrayKind {
  static_assert(std::is_same_v<Element, double> || std::is_same_v<Element, std::uint32_t> ||
                std::is_same_v<Element, std::uint8_t>);
  static constexpr const char* kType = std::is_same_v<Element, double> ? "float64"
                                       : sizeof(Element) == 1          ? "uint8"
                                                                       : "uint32";
  static constexpr int kColumns = 0;
};
template <class Tag>
struct ArrayKind<Id<Tag>> : ArrayKind<std::uint32_t> {};
template <>
struct ArrayKind<Vec2> {
  static constexpr const char* kType = "float64";
  static constexpr int kColumns = 2;
};
template <class Part, std::size_t n>
struct ArrayKind<std::array<Part, n>> {
  static constexpr const char* kType = ArrayKind<Part>::kType;
  static constexpr int kColumns =
      static_cast<int>(n) * (ArrayKind<Part>::kColumns > 0 ? ArrayKind<Part>::kColumns : 1);
};

/// A new, writable NumPy array of `rows` rows and, unless it is 0, `columns` columns.
inline yade::py::object newArray(const void* data, std::size_t bytes, const char* type,
                                 std::size_t rows, int columns) {
  const yade::py::object shape =
      columns > 0 ? yade::py::object(yade::py::make_tuple(rows, columns)) : yade::py::object(rows);
  yade::py::object array = yade::py::import("numpy").attr("empty")(shape, type);
  Py_buffer view;
  if (PyObject_GetBuffer(array.ptr(), &view, PyBUF_CONTIG) != 0)
    yade::py::throw_error_already_set();
  if (bytes > 0) std::memcpy(view.buf, data, bytes);
  PyBuffer_Release(&view);
  return array;
}

template <class Element>
yade::py::object toArray(const std::vector<Element>& column) {
  using Kind = ArrayKind<Element>;
  return newArray(column.data(), column.size() * sizeof(Element), Kind::kType, column.size(),
                  Kind::kColumns);
}

template <class Element>
yade::py::list toArrays(const std::vector<std::vector<Element>>& columns) {
  yade::py::list arrays;
  for (const auto& column : columns) arrays.append(toArray(column));
  return arrays;
}

/// The memory of an array, converted to `type`, for as long as this object exists.
class ArrayMemory {
 public:
  /// Throws std::invalid_argument unless it is empty or has rows of `columns` numbers.
  ArrayMemory(const yade::py::object& array, const char* type, int columns) {
    // The view keeps the converted array alive.
    const yade::py::object same = yade::py::import("numpy").attr("ascontiguousarray")(array, type);
    if (PyObject_GetBuffer(same.ptr(), &view_, PyBUF_ND) != 0) yade::py::throw_error_already_set();
    const bool isRight =
        columns > 0 ? view_.ndim == 2 && view_.shape[1] == columns : view_.ndim == 1;
    if (isRight || view_.len == 0) return;
    PyBuffer_Release(&view_);
    throw std::invalid_argument("An array has " + std::to_string(view_.ndim) +
                                " dimensions or rows of a wrong length; rows must have " +
                                std::to_string(columns > 0 ? columns : 1) + " numbers.");
  }
  ~ArrayMemory() { PyBuffer_Release(&view_); }
  ArrayMemory(const ArrayMemory&) = delete;
  ArrayMemory& operator=(const ArrayMemory&) = delete;

  [[nodiscard]] const void* data() const { return view_.buf; }
  [[nodiscard]] std::size_t bytes() const { return static_cast<std::size_t>(view_.len); }

 private:
  Py_buffer view_ = {};
};

/// The elements of an array, or of anything that NumPy converts to one.
template <class Element>
std::vector<Element> fromArray(const yade::py::object& array) {
  using Kind = ArrayKind<Element>;
  const ArrayMemory memory(array, Kind::kType, Kind::kColumns);
  std::vector<Element> column(memory.bytes() / sizeof(Element));
  if (!column.empty())
    std::memcpy(static_cast<void*>(column.data()), memory.data(), memory.bytes());
  return column;
}

template <class Element>
std::vector<std::vector<Element>> fromArrays(const yade::py::list& arrays) {
  std::vector<std::vector<Element>> columns;
  for (yade::py::ssize_t i = 0; i < yade::py::len(arrays); ++i)
    columns.push_back(fromArray<Element>(arrays[i]));
  return columns;
}

inline void fill(yade::py::dict& /*dict*/) {}
template <class Value, class... Rest>
void fill(yade::py::dict& dict, const char* name, const Value& value, const Rest&... rest) {
  dict[name] = value;
  fill(dict, rest...);
}

/// `dictOf("name", value, ...)`
template <class... Rest>
yade::py::dict dictOf(const Rest&... namesAndValues) {
  yade::py::dict dict;
  fill(dict, namesAndValues...);
  return dict;
}

/// An object for Python with these attributes: `record("name", value, ...)`.
template <class... Rest>
yade::py::object record(const Rest&... namesAndValues) {
  yade::py::object object = yade::py::import("types").attr("SimpleNamespace")();
  object.attr("__dict__").attr("update")(dictOf(namesAndValues...));
  return object;
}

}  // namespace yadefrag
