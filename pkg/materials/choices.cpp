#include "materials/choices.hpp"

#include <fmt/core.h>

#include <new>
#include <type_traits>

#include "core/errors.hpp"
#include "core/tolerances/contact.hpp"
#include "yade/value_kind.hpp"
#include "yade/yade.hpp"

namespace yadefrag {
namespace {

namespace py = yade::py;

[[noreturn]] void raise(PyObject* kind, const std::string& message) {
  PyErr_SetString(kind, message.c_str());
  throw py::error_already_set();
}

/// Throws TypeError unless it is a sequence of pairs of numbers.
template <class Choice>
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
  const std::string shown = py::extract<std::string>(py::str(given).slice(0, 100));
  raise(PyExc_TypeError, std::string(Choice::kAttribute) + " is " + shown +
                             "; it must be a name, or a list of points (" + Choice::kPoints + ").");
}

/// Throws InputError for an unknown name or invalid points.
template <class Choice>
Choice choiceOf(const py::object& given) {
  const bool isName = PyUnicode_Check(given.ptr()) != 0;
  const std::string name = isName ? std::string(py::extract<std::string>(given)) : std::string();
  Choice choice;
  if constexpr (std::is_base_of_v<LawChoice, Choice>) {
    choice.name = name;
    if (!isName) choice.table = tableOf<Choice>(given);
    (void)(isName ? Choice::named(name) : choice.law());
  } else if (isName) {
    choice = Choice::named(name);
  } else {
    choice.value = py::extract<double>(given);
  }
  return choice;
}

template <class Choice>
struct FromPython {
  static void* accepts(PyObject* object) {
    const bool isAny = std::is_base_of_v<LawChoice, Choice>;
    return isAny || PyUnicode_Check(object) || PyNumber_Check(object) ? object : nullptr;
  }

  static void construct(PyObject* object, py::converter::rvalue_from_python_stage1_data* data) {
    using Storage = py::converter::rvalue_from_python_storage<Choice>;
    void* const place = reinterpret_cast<Storage*>(data)->storage.bytes;  // NOLINT: Boost's way
    try {
      data->convertible =
          new (place) Choice(choiceOf<Choice>(py::object(py::handle<>(py::borrowed(object)))));
    } catch (const InputError& error) {
      raise(PyExc_ValueError, error.what());
    }
  }
};

py::object shownIn(const ToleranceChoice& choice) { return py::object(choice.value); }

py::object shownIn(const LawChoice& choice) {
  if (!choice.name.empty()) return py::object(choice.name);
  py::list points;
  for (std::size_t i = 0; i + 1 < choice.table.size(); i += 2)
    points.append(py::make_tuple(choice.table[i], choice.table[i + 1]));
  return points;
}

template <class Choice>
struct ToPython {
  static PyObject* convert(const Choice& choice) { return py::incref(shownIn(choice).ptr()); }
};

template <class Point>
std::vector<Point> pointsOf(const std::vector<double>& table) {
  std::vector<Point> points;
  for (std::size_t i = 0; i + 1 < table.size(); i += 2) points.push_back({table[i], table[i + 1]});
  return points;
}

/// The law of a choice of which only "none" is a name, or of its points. `words`: of these.
template <class Law>
Law noneOf(const char* attribute, std::string_view name, const char* words) {
  if (name == "none") return {};
  throw InputError(fmt::format("{} is '{}'; it must be 'none', or a list of points ({}).",
                               attribute, name, words));
}

void requirePoints(const char* attribute, const std::vector<double>& table, const char* least) {
  if (table.empty())
    throw InputError(fmt::format("{} has no points; it must have at least {}.", attribute, least));
}

RateEffect rateEffectOf(const char* attribute, const std::vector<double>& table,
                        const RateWords& words) {
  requirePoints(attribute, table, "two");
  return RateEffect(pointsOf<RatePoint>(table), words);
}

}  // namespace

std::string shownText(const std::string& text) {
  return text.size() <= 40 ? fmt::format("'{}'", text)
                           : fmt::format("a text of {} bytes", text.size());
}

SofteningCurve SofteningChoice::law() const {
  return name.empty() ? SofteningCurve(pointsOf<SofteningPoint>(table)) : named(name);
}

RateEffect RateChoice::law() const {
  return name.empty() ? rateEffectOf(kAttribute, table, kStrainRate) : named(name);
}

RateEffect SpeedChoice::named(std::string_view name) {
  return noneOf<RateEffect>(kAttribute, name, "speed of the crack, factor");
}

RateEffect SpeedChoice::law() const {
  return name.empty() ? rateEffectOf(kAttribute, table, kCrackSpeed) : named(name);
}

HardeningChoice::Table HardeningChoice::named(std::string_view name) {
  return noneOf<Table>(kAttribute, name, "plastic strain, yield stress");
}

HardeningChoice::Table HardeningChoice::law() const {
  if (!name.empty()) return named(name);
  requirePoints(kAttribute, table, "one");
  PlasticMaterial material;
  material.table = pointsOf<HardeningPoint>(table);
  if (const std::string wrong = material.wrong(); !wrong.empty()) throw InputError(wrong);
  return material.table;
}

ToleranceChoice ToleranceChoice::named(const std::string& name) {
  if (name == "fine") return {tolerance::kFineStop};
  if (name == "default") return {};
  if (name == "coarse") return {tolerance::kCoarseStop};
  throw InputError(fmt::format(
      "FESolver.contactTolerance is {}, it must be 'fine', 'default', 'coarse' or a number.",
      shownText(name)));
}

template const ValueKind& kindOf<SofteningChoice>();
template const ValueKind& kindOf<RateChoice>();
template const ValueKind& kindOf<SpeedChoice>();
template const ValueKind& kindOf<HardeningChoice>();
template const ValueKind& kindOf<ToleranceChoice>();

namespace {

template <class Choice>
void convert() {
  py::converter::registry::push_back(&FromPython<Choice>::accepts, &FromPython<Choice>::construct,
                                     py::type_id<Choice>());
  py::to_python_converter<Choice, ToPython<Choice>>();
}

}  // namespace

void convertChoices() {
  convert<SofteningChoice>(), convert<RateChoice>(), convert<SpeedChoice>();
  convert<HardeningChoice>(), convert<ToleranceChoice>();
}

}  // namespace yadefrag
