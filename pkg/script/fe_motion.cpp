#include "script/arrays.hpp"
#include "script/calls.hpp"
#include "script/definitions.hpp"
#include "script/shown_nodes.hpp"

namespace yadefrag {

namespace py = yade::py;

namespace {

std::vector<NodeId> nodesFrom(const FESolver& solver, const py::object& numbers) {
  return ShownNodes(solver.world()).nodes(fromArray<NodeId>(numbers));
}

void setLoads(FESolver& solver, const py::object& loads) {
  change(solver, [&] {
    World& world = solver.changeWorld();
    world.setLoads(ShownNodes(world).column(fromArray<Vec2>(loads)));
  });
}

void prescribe(FESolver& solver, const py::object& nodes, int held, const py::object& velocities) {
  change(solver, [&] {
    solver.changeWorld().prescribeEach(nodesFrom(solver, nodes), static_cast<std::uint8_t>(held),
                                       fromArray<Vec2>(velocities));
  });
}

std::uint32_t numberOf(FESolver& solver, const py::object& function) {
  ScriptFunctions& functions = solver.scriptFunctions();
  functions.keep(solver.world());
  return function.is_none() ? 0 : functions.add(function);
}

/// Times and values of a table, or a function (s) → Pa.
void setPressure(FESolver& solver, const py::object& nodes, const py::object& times,
                 const py::object& values, const py::object& function, bool intoCracks) {
  change(solver, [&] {
    solver.changeWorld().setPressure(nodesFrom(solver, nodes),
                                     {fromArray<double>(times), fromArray<double>(values)},
                                     numberOf(solver, function), intoCracks);
  });
}

void setAbsorbing(FESolver& solver, const py::object& nodes) {
  change(solver, [&] { solver.changeWorld().setAbsorbing(nodesFrom(solver, nodes)); });
}

/// `centre` is a pair (m), `speedX`, `speedY` and `turn` are pairs of times and values, empty for
/// none, and `function` is None for tables only.
void prescribeMotion(FESolver& solver, const py::object& nodes, int held, const py::tuple& centre,
                     const py::tuple& speedX, const py::tuple& speedY, const py::tuple& turn,
                     const py::object& function) {
  const auto table = [](const py::tuple& columns) {
    return TimeTable(fromArray<double>(columns[0]), fromArray<double>(columns[1]));
  };
  Motion motion;
  motion.centre = {py::extract<double>(centre[0]), py::extract<double>(centre[1])};
  motion.speedX = table(speedX), motion.speedY = table(speedY), motion.turn = table(turn);
  change(solver, [&] {
    motion.function = numberOf(solver, function);
    solver.changeWorld().prescribeMotion(nodesFrom(solver, nodes), static_cast<std::uint8_t>(held),
                                         std::move(motion));
  });
}

}  // namespace

void defineMotions(SolverClass& solver) {
  solver.def("_setLoads", &setLoads)
      .def("_prescribe", &prescribe)
      .def("_move", &prescribeMotion)
      .def("_pressure", &setPressure)
      .def("_absorb", &setAbsorbing);
}

}  // namespace yadefrag
