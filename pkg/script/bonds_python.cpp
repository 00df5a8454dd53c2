#include "script/bonds_python.hpp"

#include <string>

#include "fracture/brittle_checks.hpp"
#include "script/calls.hpp"

namespace yadefrag {

namespace py = yade::py;

namespace {

struct Bonded {
  CommonSides found;
  std::size_t sides = 0;
  ConformPlan done;
  std::string problem;

  [[nodiscard]] py::tuple result() const {
    return py::make_tuple(sides, done.corners, done.farthest, problem);
  }
};

/// Runs `work`, which bonds sides and describes them in a Bonded, between two steps.
template <class Work>
Bonded bonded(FESolver& solver, const Work& work) {
  return change(solver, [&] {
    return solver.bond([&](World& world) {
      Bonded result;
      const EdgeId first(world.fracture.edges.size());
      work(world, result);
      if (result.sides > 0)
        result.problem = bondZoneWarning(world.model, world.fracture.edges, first);
      return result;
    });
  });
}

}  // namespace

py::tuple bondOf(FESolver& solver, int a, int b, double strength, double energy) {
  return bonded(solver,
                [&](World& world, Bonded& result) {
                  result.sides = world.bond(ComponentId(static_cast<std::size_t>(a)),
                                            ComponentId(static_cast<std::size_t>(b)), strength,
                                            energy, &result.done);
                })
      .result();
}

py::tuple bondAllOf(FESolver& solver, double reach, double strength, double energy) {
  const Bonded all = bonded(solver, [&](World& world, Bonded& result) {
    result.found = world.bondAll(reach, strength, energy, &result.done);
    result.sides = result.found.pairs.size();
  });
  const CommonSides& found = all.found;
  return py::make_tuple(all.result(), found.unmatched,
                        py::make_tuple(found.bodies[0].value, found.bodies[1].value),
                        py::make_tuple(found.place.x, found.place.y));
}

}  // namespace yadefrag
