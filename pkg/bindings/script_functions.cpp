#include "solver/fe_solver.hpp"

#include <algorithm>
#include <stdexcept>
#include <string>
#include <vector>

#include "bindings/arrays.hpp"
#include "yade/gil.hpp"

namespace yadefrag {
namespace {

namespace py = yade::py;

/// The pending Python exception as "ValueError: what"; clears it.
std::string takeRaised() {
  PyObject *type = nullptr, *value = nullptr, *trace = nullptr;
  PyErr_Fetch(&type, &value, &trace);
  PyErr_NormalizeException(&type, &value, &trace);
  const py::object kind{py::handle<>(py::allow_null(type))};
  const py::object what{py::handle<>(py::allow_null(value))};
  Py_XDECREF(trace);
  try {
    const std::string name = py::extract<std::string>(kind.attr("__name__"));
    const std::string text = py::extract<std::string>(py::str(what));
    return name + ": " + text;
  } catch (const py::error_already_set&) {
    PyErr_Clear();
    return "an exception without a text";
  }
}

/// Calls the function of a motion for the nodes that it moves.
void callOne(const py::object& function, const World& world, std::uint32_t motion, double middle,
             std::vector<Vec2>& velocities) {
  std::vector<std::uint32_t> nodes;
  for (std::size_t n = 0; n < world.model.nodes.size(); ++n)
    if (world.model.nodes.motion[n] == motion + 1) nodes.push_back(static_cast<std::uint32_t>(n));
  std::vector<Vec2> places;
  places.reserve(nodes.size());
  for (const std::uint32_t n : nodes) places.push_back(world.model.nodes.position[n]);
  const auto given = fromArray<Vec2>(function(toArray(places), middle));
  if (given.size() != nodes.size())
    throw std::runtime_error("A function of FESolver.prescribe gave a wrong number of velocities.");
  for (std::size_t i = 0; i < nodes.size(); ++i) velocities[nodes[i]] = given[i];
}

}  // namespace

ScriptFunctions::~ScriptFunctions() {
  if (functions_.empty()) return;
  if (Py_IsInitialized() != 0) {
    const WithGil gil;
    functions_.clear();
    return;
  }
  // Python has been finalised, and its objects with it: they must not be released any more.
  new std::map<std::uint32_t, py::object>(std::move(functions_));  // NOLINT
}

std::uint32_t ScriptFunctions::add(const py::object& function) {
  const std::uint32_t number = functions_.empty() ? 1 : functions_.rbegin()->first + 1;
  functions_[number] = function;
  return number;
}

void ScriptFunctions::keep(const World& world) {
  std::erase_if(functions_, [&](const auto& one) {
    const auto isOf = [&](const auto& user) { return user.function == one.first; };
    return std::ranges::none_of(world.model.motions, isOf) &&
           std::ranges::none_of(world.loads.pressures, isOf);
  });
  // After loading, motions may have numbers of missing functions: no other function gets these.
  for (const Motion& motion : world.model.motions)
    if (motion.isScripted()) functions_.try_emplace(motion.function);
  for (const Pressure& pressure : world.loads.pressures)
    if (pressure.function != 0) functions_.try_emplace(pressure.function);
}

void ScriptFunctions::giveValues(World& world, double dt) const {
  world.givenVelocities.clear();
  world.loads.givenPressures.clear();
  if (std::ranges::none_of(world.model.motions, [](const Motion& m) { return m.isScripted(); }) &&
      std::ranges::none_of(world.loads.pressures,
                           [](const Pressure& p) { return p.function != 0; }))
    return;
  const WithGil gil;
  try {
    giveVelocities(world, dt);
    givePressures(world);
  } catch (const py::error_already_set&) {
    throw std::runtime_error("A function of the script, for a motion or a pressure, raised " +
                             takeRaised());
  }
}

void ScriptFunctions::giveVelocities(World& world, double dt) const {
  const std::vector<Motion>& motions = world.model.motions;
  if (motions.empty()) return;
  std::vector<Vec2> velocities(world.model.nodes.size());
  for (std::uint32_t m = 0; m < motions.size(); ++m) {
    if (!motions[m].isScripted()) continue;
    const auto known = functions_.find(motions[m].function);
    if (known == functions_.end() || known->second.is_none()) return;
    callOne(known->second, world, m, world.time + dt / 2, velocities);
  }
  world.givenVelocities = std::move(velocities);
}

void ScriptFunctions::givePressures(World& world) const {
  for (const Pressure& pressure : world.loads.pressures) {
    const auto known = functions_.find(pressure.function);
    if (known == functions_.end() || known->second.is_none()) continue;
    world.loads.givenPressures.push_back(
        {pressure.function, py::extract<double>(known->second(world.time))});
  }
}

}  // namespace yadefrag
