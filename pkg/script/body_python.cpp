#include <cassert>
#include <string>

#include "fracture/brittle_checks.hpp"
#include "script/arrays.hpp"
#include "script/calls.hpp"
#include "script/definitions.hpp"
#include "script/mesh_python.hpp"
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

/// `FESolver._addMesh` of yadefrag/fe/solver.py, which has checked all input: (component, message
/// on a coarse mesh or '', 0), or, without any change, (-1, message, depth (m)) for a body that
/// would overlap another one. Arrays are by node, `stress` and `materialOf` (index in `materials`)
/// by triangle; empty: none.
py::tuple addMesh(FESolver& solver, const ScriptMesh& mesh, const py::list& materials,
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
      return py::make_tuple(added.component, added.message, 0.);
    } catch (const OverlapError& overlap) {
      return py::make_tuple(-1, overlap.what(), overlap.depth);
    }
  });
}

void takeBody(FESolver& solver, int component) {
  change(solver, [&] { solver.removeBody(component); });
}

py::tuple toTuple(const Snapped& snapped) {
  py::list loops;
  for (const SnappedLoop& loop : snapped.loops)
    loops.append(
        py::make_tuple(toArray(loop.points), toArray(loop.vertex), toArray(loop.isInserted)));
  const SnapCount& count = snapped.count;
  return py::make_tuple(loops, count.moved, count.inserted, count.farthest);
}

/// (loops, moved, inserted, farthest); `rule` is (tolerance, spacing, matchesNodes). A loop is
/// (points (n, 2), vertex (n), isInserted (n)).
py::tuple snapOf(const FESolver& solver, const py::object& outline, const py::list& holes,
                 const py::tuple& rule) {
  return change(solver, [&] {
    return toTuple(snapOnBodies(
        solver.world(), polygonOf(outline, holes),
        {py::extract<double>(rule[0]), py::extract<double>(rule[1]), py::extract<bool>(rule[2])}));
  });
}

/// The same for a list of (outline, holes): a list of such tuples.
py::list snapTogetherOf(const py::list& polygons, double tolerance) {
  return asValueError([&] {
    std::vector<Polygon> given(static_cast<std::size_t>(py::len(polygons)));
    for (std::size_t i = 0; i < given.size(); ++i)
      given[i] = polygonOf(polygons[i][0], py::list(polygons[i][1]));
    py::list result;
    for (const Snapped& one : snapTogether(std::move(given), tolerance))
      result.append(toTuple(one));
    return result;
  });
}

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

/// (sides, corners moved, farthest move (m), message about the mesh or '').
py::tuple bondOf(FESolver& solver, int a, int b, double strength, double energy) {
  return bonded(solver,
                [&](World& world, Bonded& result) {
                  result.sides = world.bond(ComponentId(static_cast<std::size_t>(a)),
                                            ComponentId(static_cast<std::size_t>(b)), strength,
                                            energy, &result.done);
                })
      .result();
}

/// The same, and the number of sides that do not match, two bodies and a place (m) of which this is
/// true.
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

}  // namespace yadefrag
