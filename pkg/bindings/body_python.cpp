#include <cassert>
#include <string>

#include "bindings/arrays.hpp"
#include "bindings/calls.hpp"
#include "fracture/brittle_checks.hpp"
#include "solver/fe_solver.hpp"
#include "step/overlap_check.hpp"

namespace yadefrag {

namespace py = yade::py;

namespace {

/// Strengths (Pa) and energies (J/m²) by triangle, empty for none; sides of triangles, as both
/// nodes, with values of their own.
BrittlePlaces brittlePlacesOf(const py::object& strength, const py::object& fractureEnergy,
                              const py::object& edges, const py::object& edgeStrength,
                              const py::object& edgeEnergy) {
  BrittlePlaces places{fromArray<double>(strength), fromArray<double>(fractureEnergy), {}};
  const auto ends = fromArray<std::array<std::uint32_t, 2>>(edges);
  const auto strengths = fromArray<double>(edgeStrength);
  const auto energies = fromArray<double>(edgeEnergy);
  assert(strengths.size() == ends.size() && energies.size() == ends.size());
  for (std::size_t i = 0; i < ends.size(); ++i)
    places.joints.push_back({ends[i], strengths[i], energies[i]});
  return places;
}

/// `FESolver._addMesh` of yadefrag/fe/solver.py, which has checked all input: component and message
/// on a coarse mesh or ''; without any change component -1, message and depth (m) for a body that
/// would overlap another one. Arrays are by node, `stress` and `materialOf` (index in `materials`)
/// by triangle; empty: none.
py::object addMesh(FESolver& solver, const ScriptMesh& mesh, const py::list& materials,
                   const py::object& materialOf, const BrittlePlaces& places,
                   const py::object& velocity, const py::object& displacement,
                   const py::object& stress, const py::object& stressAcross, const py::object& held,
                   const py::object& smooth, double thickness, bool selfContact, bool smoothed,
                   const std::string& name) {
  BodySpec spec;
  spec.materials.ofTriangle = fromArray<std::uint32_t>(materialOf);
  spec.places = places;
  spec.velocity = fromArray<Vec2>(velocity);
  spec.displacement = fromArray<Vec2>(displacement);
  spec.stress = fromArray<std::array<double, 3>>(stress);
  spec.stressAcross = fromArray<double>(stressAcross);
  spec.held = fromArray<std::uint8_t>(held);
  spec.smoothNodes = fromArray<std::uint8_t>(smooth);
  spec.thickness = thickness;
  spec.selfContact = selfContact;
  spec.element = smoothed ? ElementKind::kSmoothed : ElementKind::kLinear;
  spec.name = name;
  std::vector<yade::shared_ptr<FEMat>> own;
  for (py::ssize_t i = 0; i < py::len(materials); ++i)
    own.push_back(py::extract<yade::shared_ptr<FEMat>>(materials[i]));
  return change(solver, [&] {
    try {
      const AddedBody added = solver.addBody(mesh, std::move(spec), own);
      return record("component", added.component, "message", added.message);
    } catch (const OverlapError& overlap) {
      return record("component", -1, "message", overlap.what(), "depth", overlap.depth);
    }
  });
}

void takeBody(FESolver& solver, int component) {
  change(solver, [&] { solver.removeBody(component); });
}

/// loops, moved, inserted, farthest (m); of a loop points (n, 2), vertex (n), isInserted (n).
py::object recordOf(const Snapped& snapped) {
  py::list loops;
  for (const SnappedLoop& loop : snapped.loops)
    loops.append(record("points", toArray(loop.points), "vertex", toArray(loop.vertex),
                        "isInserted", toArray(loop.isInserted)));
  const SnapCount& count = snapped.count;
  return record("loops", loops, "moved", count.moved, "inserted", count.inserted, "farthest",
                count.farthest);
}

py::object snapOf(const FESolver& solver, const py::object& outline, const py::list& holes,
                  double tolerance, double spacing, bool matchesNodes) {
  return change(solver, [&] {
    return recordOf(snapOnBodies(solver.world(), polygonOf(outline, holes),
                                 {tolerance, spacing, matchesNodes}));
  });
}

/// `polygons`: a list of (outline, holes). Returns a list of the objects of `recordOf`.
py::list snapTogetherOf(const py::list& polygons, double tolerance) {
  return asValueError([&] {
    std::vector<Polygon> given(static_cast<std::size_t>(py::len(polygons)));
    for (std::size_t i = 0; i < given.size(); ++i)
      given[i] = polygonOf(polygons[i][0], py::list(polygons[i][1]));
    py::list result;
    for (const Snapped& one : snapTogether(std::move(given), tolerance))
      result.append(recordOf(one));
    return result;
  });
}

struct Bonded {
  py::object found;
  ConformPlan done;
};

/// Runs `work`, which bonds sides and returns an object with their number, between two steps; the
/// object gets: corners moved, farthest move (m), problem: message about the mesh or ''.
template <class Work>
py::object bonded(FESolver& solver, const Work& work) {
  const auto bondAndTell = [&](World& world) {
    Bonded result;
    const EdgeId first(world.fracture.edges.size());
    result.found = work(world, result.done);
    std::string problem;
    if (py::extract<std::size_t>(result.found.attr("sides")) > 0)
      problem = bondZoneWarning(world.model, world.fracture.edges, first);
    result.found.attr("__dict__")
        .attr("update")(dictOf("corners", result.done.corners, "farthest", result.done.farthest,
                               "problem", problem));
    return result;
  };
  return change(solver, [&] { return solver.bond(bondAndTell).found; });
}

py::object bondOf(FESolver& solver, int a, int b, double strength, double energy) {
  return bonded(solver, [&](World& world, ConformPlan& done) {
    return record("sides",
                  world.bond(ComponentId(static_cast<std::size_t>(a)),
                             ComponentId(static_cast<std::size_t>(b)), strength, energy, &done));
  });
}

/// sides; unmatched: number of sides that do not match; two bodies and a place (m) of such ones.
py::object bondAllOf(FESolver& solver, double reach, double strength, double energy) {
  return bonded(solver, [&](World& world, ConformPlan& done) {
    const CommonSides found = world.bondAll(reach, strength, energy, &done);
    return record("sides", found.pairs.size(), "unmatched", found.unmatched, "bodies",
                  py::make_tuple(found.bodies[0].value, found.bodies[1].value), "place",
                  py::make_tuple(found.place.x, found.place.y));
  });
}

}  // namespace

void defineBodyParts() {
  using py::arg;
  [[maybe_unused]] const py::class_<BrittlePlaces> places("BrittlePlaces", py::no_init);
  py::def("brittlePlaces", &brittlePlacesOf,
          (arg("strength"), arg("fractureEnergy"), arg("edges"), arg("edgeStrength"),
           arg("edgeEnergy")));
  py::def("snapTogether", &snapTogetherOf);
}

void defineBodies(SolverClass& solver) {
  using py::arg;
  solver
      .def("_addMesh", &addMesh,
           (arg("mesh"), arg("materials"), arg("materialOf"), arg("places"), arg("velocity"),
            arg("displacement"), arg("stress"), arg("stressAcross"), arg("held"), arg("smooth"),
            arg("thickness"), arg("selfContact"), arg("smoothed"), arg("name")))
      .def("removeBody", &takeBody, yade::py::args("component"),
           "Removes a whole body, and the bodies of its surface, from the scene; the numbers of "
           "the other bodies do not change.")
      .def("_snap", &snapOf)
      .def("_bond", &bondOf)
      .def("_bondAll", &bondAllOf);
}

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
