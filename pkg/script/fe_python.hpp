#pragma once
// Python values and methods of FESolver; addPolygon and others are written in Python
// (python/yadefrag/fe/solver.py).

#include "fracture/brittle_checks.hpp"
#include "script/body_python.hpp"
#include "script/bonds_python.hpp"
#include "script/calls.hpp"
#include "script/fe_arrays.hpp"
#include "script/fe_results.hpp"
#include "script/mesh_python.hpp"
#include "script/snap_python.hpp"
#include "step/overlap_depth.hpp"

namespace yadefrag {

inline double criticalTimeStepOf(FESolver& solver) { return solver.criticalTimeStep(); }
inline std::string zoneWarningOf(const FESolver& solver, int component) {
  const World& world = solver.world();
  return cohesiveZoneWarning(world.model, world.fracture.edges, ComponentId(component));
}
inline void noteOf(FESolver& solver, std::string sentence) { solver.note(std::move(sentence)); }
inline double timeOf(const FESolver& solver) { return solver.world().time; }
inline std::uint64_t searchesOf(const FESolver& solver) { return solver.world().numSearches; }
inline std::size_t activesOf(const FESolver& solver) {
  return solver.world().contact.rows().size();
}
inline double penetrationOf(const FESolver& solver) {
  return solver.world().contact.maxPenetration();
}
inline double deepestOverlapOf(const FESolver& solver) {
  return deepestOverlap(solver.world().model, solver.world().threads);
}
inline std::uint64_t numCracksOf(const FESolver& solver) {
  return solver.world().fracture.numCracks();
}

template <class PyClass>
void FESolver::pyExtra(PyClass& pyClass) {
  using yade::py::arg;
  pyClass
      .def("_addMesh", &addMesh,
           (arg("mesh"), arg("materials"), arg("materialOf"), arg("places"), arg("velocity"),
            arg("displacement"), arg("stress"), arg("held"), arg("smooth"), arg("thickness"),
            arg("selfContact"), arg("smoothed"), arg("name")))
      .def(
          "removeBody", &takeBody, yade::py::args("component"),
          "Removes a whole body, and the bodies of its surface, from the scene; the numbers of the "
          "other bodies do not change.")
      .def("criticalTimeStep", &Locked<criticalTimeStepOf>::call,
           "Critical time step (s) of the present mesh; of a body that can crack also when all "
           "its triangles are separated; infinite without bodies. An O.dt that changes all the "
           "time should stay below a third of it. Spheres are not considered: see the manual, "
           "Limits.")
      .def("deepestOverlap", &Locked<deepestOverlapOf>::call,
           "Deepest overlap (m) of any two triangles without a common node: the shortest "
           "translation "
           "that separates them, at most a triangle's height. Checks all triangles at each call, "
           "independently of contact; maxPenetration considers only points in contact. 0, except "
           "for "
           "rounding, where bodies touch.")
      .def("fragments", &Locked<fragmentsOf>::call, (yade::py::arg("held") = true),
           "List of dicts, one per part that has come apart: component (of its first triangle), "
           "triangles (their number), mass (kg), area (m²), centroid (m), velocity (m/s), spin "
           "(rad/s). Parts that cohesion or a bond still holds together are one fragment; with "
           "held=False every crack separates, also one that has hardly opened.")
      .def("_zoneWarning", &Locked<zoneWarningOf>::call)
      .def(
          "_lock", +[](const FESolver& self) { self.betweenSteps().lock(); })
      .def(
          "_unlock", +[](const FESolver& self) { self.betweenSteps().unlock(); })
      .def("_note", &Locked<noteOf>::call)
      .def("_snap", &snapOf)
      .def("_costOfMesh", &Locked<costOfMesh>::call)
      .def("_meshQuality", &Locked<meshQualityOf>::call)
      .def("_costlyStepWarning", &Locked<costlyStepWarningOf>::call)
      .def("_bond", &bondOf)
      .def("_bondAll", &bondAllOf)
      .def("_nodesOf", &Locked<nodesOfBody>::call)
      .def("_isGone", &Locked<isGone>::call)
      .def("_setLoads", &setLoads)
      .def("_prescribe", &prescribe)
      .def("_move", &prescribeMotion)
      .def("_pressure", &setPressure)
      .def("_absorb", &setAbsorbing)
      .def("_pairForce", &Locked<pairForceOf>::call)
      .def("_cracks", &Locked<cracksOf>::call);
  valuesOf(pyClass);
  countersOf(pyClass);
}

template <class PyClass>
void FESolver::valuesOf(PyClass& pyClass) {
  pyClass.add_property("_loads", &Locked<loadsOf>::call)
      .add_property("_names", &Locked<namesOf>::call)
      .add_property("nodes", &Locked<nodesOf>::call,
                    "Positions (m), array (n, 2); a copy, as all arrays.")
      .add_property("velocities", &Locked<velocitiesOf>::call, "Of the nodes (m/s), array (n, 2).")
      .add_property("displacements", &Locked<displacementsOf>::call,
                    "Of the nodes, from the stress-free shape (m), array (n, 2).")
      .add_property("masses", &Locked<massesOf>::call, "Of the nodes (kg), array (n).")
      .add_property("triangles", &Locked<trianglesOf>::call,
                    "Node numbers, counter-clockwise, array (m, 3).")
      .add_property("stress", &Locked<stressArrayOf>::call,
                    "Cauchy stress xx, yy, xy (Pa) of the triangles, array (m, 3).")
      .add_property(
          "strain", &Locked<strainArrayOf>::call,
          "Green and Lagrange's strain xx, yy, xy (half the shear angle) of the triangles, "
          "array (m, 3): (FᵀF - 1)/2, of each triangle alone where `element` is 'smoothed', "
          "too.")
      .add_property("components", &Locked<componentsOf>::call,
                    "Number of each triangle's body, array (m).")
      .add_property("materialNumbers", &Locked<materialNumbersOf>::call,
                    "Number of each triangle's material among those of its body, in the order of "
                    "their first triangles, array (m); 0 in bodies of one.")
      .add_property("fragmentOf", &Locked<fragmentOf>::call,
                    "Number of each triangle's fragment, its place in fragments(), array (m); -1: "
                    "removed.")
      .add_property("_reference", &Locked<referenceOf>::call)
      .add_property(
          "contactForces", &Locked<contactForcesOf>::call,
          "Contact forces between bodies of this engine, on the nodes, in the last step (N), "
          "array (n, 2).")
      .add_property("reactions", &Locked<reactionsOf>::call,
                    "Reactions at held nodes in the last step (N), array (n, 2): the support's "
                    "force, besides "
                    "the node's own weight, its loads and all forces of bodies; 0 in free "
                    "directions, and before the first step and after O.load.")
      .add_property("time", &Locked<timeOf>::call,
                    "Simulated time of the bodies (s); motions and loads that vary "
                    "with time are functions of it.")
      .add_property("surfaces", &Locked<surfacesOf>::call,
                    "List of closed loops, each an array of node numbers, material on the left.")
      .add_property("numSegments", &Locked<segmentsOf>::call,
                    "Segments of all surfaces: each crack that opens adds two; those of removed "
                    "fragments do not count.")
      .add_property("dropped", &Locked<droppedOf>::call,
                    "Removed fragments (smaller than minFragmentArea), a dict: mass "
                    "(kg), momentum (kg m/s, a pair), energy (J) at their removal, count.")
      .add_property("_energies", &Locked<energyOf>::call);
}

template <class PyClass>
void FESolver::countersOf(PyClass& pyClass) {
  pyClass.add_property("_energyBalance", &Locked<energyBalanceOf>::call)
      .add_property("warnings", &Locked<warningsOf>::call,
                    "Warnings of numerical errors: energy that contact, cracks or the "
                    "time integration have created, above 1 % of the bodies' energy and above "
                    "rounding, and penetration above a tenth of the shortest segment. One per "
                    "doubling, each also written to stderr when it occurs.")
      .add_property("numSearches", &Locked<searchesOf>::call, "Contact searches so far.")
      .add_property("numActives", &Locked<activesOf>::call, "Points in contact in the last step.")
      .add_property("maxPenetration", &Locked<penetrationOf>::call,
                    "Deepest remaining penetration (m) at points in contact in the last step; "
                    "deepestOverlap() checks all triangles.")
      .add_property(
          "numCracks", &Locked<numCracksOf>::call,
          "Cracked edges so far, without bonds and joints that are open from the start. Some "
          "may still hold: see crackCounts.");
}

}  // namespace yadefrag
