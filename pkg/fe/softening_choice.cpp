#include "fe/softening_choice.hpp"

#include <new>

#include "abi/yade.hpp"
#include "core/errors.hpp"

namespace yadefrag {
namespace {

namespace py = yade::py;

[[noreturn]] void raise(PyObject* kind, const std::string& message) {
  PyErr_SetString(kind, message.c_str());
  throw py::error_already_set();
}

/// Throws TypeError unless it is a sequence of pairs of numbers.
std::vector<double> tableOf(const py::object& given) {
  std::vector<double> table;
  try {
    for (py::stl_input_iterator<py::object> point(given), end; point != end; ++point) {
      const py::object both = *point;
      if (py::len(both) != 2) break;
      for (const int i : {0, 1}) table.push_back(py::extract<double>(py::object(both[i])));
    }
    if (table.size() == 2 * static_cast<std::size_t>(py::len(given))) return table;
  } catch (const py::error_already_set&) {
    PyErr_Clear();
  }
  const std::string shown = py::extract<std::string>(py::str(given));
  raise(PyExc_TypeError, "softening is " + shown +
                             "; it must be a name, or a list of points (opening over critical "
                             "opening, traction over strength).");
}

struct FromPython {
  static void* accepts(PyObject* object) { return object; }

  static void construct(PyObject* object, py::converter::rvalue_from_python_stage1_data* data) {
    SofteningChoice choice;
    const py::object given{py::handle<>(py::borrowed(object))};
    const bool isName = PyUnicode_Check(object) != 0;
    if (isName)
      choice.name = py::extract<std::string>(given);
    else
      choice.name.clear(), choice.table = tableOf(given);
    try {
      (void)(isName ? softeningNamed(choice.name) : choice.curve());
    } catch (const InputError& error) {
      raise(PyExc_ValueError, error.what());
    }
    using Storage = py::converter::rvalue_from_python_storage<SofteningChoice>;
    void* const place = reinterpret_cast<Storage*>(data)->storage.bytes;  // NOLINT: Boost's way
    data->convertible = new (place) SofteningChoice(std::move(choice));
  }
};

struct ToPython {
  static PyObject* convert(const SofteningChoice& choice) {
    if (!choice.name.empty()) return py::incref(py::object(choice.name).ptr());
    py::list points;
    for (std::size_t i = 0; i + 1 < choice.table.size(); i += 2)
      points.append(py::make_tuple(choice.table[i], choice.table[i + 1]));
    return py::incref(points.ptr());
  }
};

}  // namespace

SofteningCurve SofteningChoice::curve() const {
  if (!name.empty()) return softeningNamed(name);
  std::vector<SofteningPoint> points;
  for (std::size_t i = 0; i + 1 < table.size(); i += 2) points.push_back({table[i], table[i + 1]});
  return SofteningCurve(std::move(points));
}

void convertSoftening() {
  py::converter::registry::push_back(&FromPython::accepts, &FromPython::construct,
                                     py::type_id<SofteningChoice>());
  py::to_python_converter<SofteningChoice, ToPython>();
}

}  // namespace yadefrag
