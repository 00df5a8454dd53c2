#include "fe/tolerance_choice.hpp"

#include <fmt/core.h>

#include <new>
#include <string>

#include "abi/yade.hpp"
#include "core/errors.hpp"
#include "core/tolerances/solver.hpp"
#include "publish/value_kind.hpp"

namespace yadefrag {
namespace {

namespace py = yade::py;

struct FromPython {
  static void* accepts(PyObject* object) {
    return PyUnicode_Check(object) || PyNumber_Check(object) ? object : nullptr;
  }

  static void construct(PyObject* object, py::converter::rvalue_from_python_stage1_data* data) {
    const py::object given{py::handle<>(py::borrowed(object))};
    ToleranceChoice choice;
    try {
      if (PyUnicode_Check(object))
        choice = ToleranceChoice::named(std::string(py::extract<std::string>(given)));
      else
        choice.value = py::extract<double>(given);
    } catch (const InputError& error) {
      PyErr_SetString(PyExc_ValueError, error.what());
      throw py::error_already_set();
    }
    using Storage = py::converter::rvalue_from_python_storage<ToleranceChoice>;
    void* const place = reinterpret_cast<Storage*>(data)->storage.bytes;  // NOLINT: Boost's way
    data->convertible = new (place) ToleranceChoice(choice);
  }
};

struct ToPython {
  static PyObject* convert(const ToleranceChoice& choice) {
    return py::incref(py::object(choice.value).ptr());
  }
};

}  // namespace

ToleranceChoice ToleranceChoice::named(std::string_view name) {
  if (name == "fine") return {tolerance::kFineStop};
  if (name == "default") return {};
  if (name == "coarse") return {tolerance::kCoarseStop};
  const std::string shown = name.size() <= 40 ? fmt::format("'{}'", name)
                                              : fmt::format("a text of {} bytes", name.size());
  throw InputError(fmt::format(
      "FESolver.contactTolerance is {}, it must be 'fine', 'default', 'coarse' or a number.",
      shown));
}

template const ValueKind& kindOf<ToleranceChoice>();

void convertTolerance() {
  py::converter::registry::push_back(&FromPython::accepts, &FromPython::construct,
                                     py::type_id<ToleranceChoice>());
  py::to_python_converter<ToleranceChoice, ToPython>();
}

}  // namespace yadefrag
