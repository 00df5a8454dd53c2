#include "bindings/arrays.hpp"
#include "bindings/calls.hpp"
#include "bindings/fragments.hpp"
#include "elements/element_state.hpp"
#include "fracture/brittle_checks.hpp"
#include "solver/fe_solver.hpp"

namespace yadefrag {

namespace py = yade::py;

namespace {

/// A column by node, in the numbering of scripts.
template <class Value>
py::object nodeArray(const FESolver& solver, const std::vector<Value>& column) {
  if (!solver.world().hasRigid()) return toArray(column);
  return toArray(ShownNodes(solver.world()).rows(column));
}

/// A column of the nodes as it is.
template <auto column>
py::object columnOf(const FESolver& solver) {
  return nodeArray(solver, solver.world().model.nodes.*column);
}

py::object loadsOf(const FESolver& solver) {
  const Nodes& nodes = solver.world().model.nodes;
  if (!nodes.load.empty()) return nodeArray(solver, nodes.load);
  return toArray(std::vector<Vec2>(ShownNodes(solver.world()).size()));
}

py::object nodesOfBody(const FESolver& solver, int component) {
  const Nodes& nodes = solver.world().model.nodes;
  const ShownNodes all(solver.world());
  std::vector<NodeId> own;
  for (std::size_t n = 0; n < nodes.size(); ++n)
    if (nodes.component[n] == ComponentId(static_cast<std::size_t>(component)) && nodes.mass[n] > 0)
      own.push_back(all.number(NodeId(n)));
  return toArray(own);
}

/// By component, '' for those without a name.
py::list namesOf(const FESolver& solver) {
  py::list names;
  for (const Component& body : solver.world().model.components)
    names.append(body.rigid ? "" : body.name);
  return names;
}

bool isGone(const FESolver& solver, int component) {
  const Component& body = solver.world().model.components[static_cast<std::size_t>(component)];
  return body.firstTriangle == body.lastTriangle;
}

py::object trianglesOf(const FESolver& solver) {
  const ShownNodes all(solver.world());
  auto triangles = solver.world().model.triangles.nodes;
  if (solver.world().hasRigid())
    for (auto& corners : triangles)
      for (NodeId& node : corners) node = all.number(node);
  return toArray(triangles);
}

/// What a function of the model and its last step gives for each triangle.
template <auto state>
py::object stateOf(const FESolver& solver) {
  return toArray(state(solver.world().model, solver.world().lastDt));
}

bool anyYields(const FESolver& solver) { return solver.world().model.triangles.plastic.isUsed(); }

bool anyFails(const FESolver& solver) {
  return !solver.world().model.triangles.plastic.damage.empty();
}

/// Of the present state; 0 for triangles that do not yield.
template <double YieldPoint::*which>
py::object yieldingOf(const FESolver& solver) {
  const Model& model = solver.world().model;
  std::vector<double> values(model.triangles.size());
  if (model.triangles.plastic.isUsed()) {
    const std::vector<YieldPoint> points = presentPoints(model, solver.world().lastDt);
    for (std::size_t e = 0; e < values.size(); ++e)
      if (model.bodyOf(ElementId(e)).yields() && !model.triangles.isDropped(e))
        values[e] = points[e].*which;
  }
  return toArray(values);
}

py::object componentsOf(const FESolver& solver) {
  return toArray(solver.world().model.triangles.component);
}

py::object materialNumbersOf(const FESolver& solver) {
  const Triangles& triangles = solver.world().model.triangles;
  if (!triangles.material.empty()) return toArray(triangles.material);
  return toArray(std::vector<std::uint32_t>(triangles.size()));
}

py::object strainArrayOf(const FESolver& solver) {
  const Model& model = solver.world().model;
  std::vector<std::array<double, 3>> strains(model.triangles.size());
  for (std::size_t e = 0; e < strains.size(); ++e) {
    if (model.triangles.isDropped(e)) continue;
    const Matrix2 f = deformationGradient(model, ElementId(e));
    strains[e] = {(f.xx * f.xx + f.yx * f.yx - 1) / 2, (f.xy * f.xy + f.yy * f.yy - 1) / 2,
                  (f.xx * f.xy + f.yx * f.yy) / 2};
  }
  return toArray(strains);
}

py::object displacementsOf(const FESolver& solver) {
  std::vector<Vec2> moved = solver.world().model.nodes.position;
  for (std::size_t i = 0; i < moved.size(); ++i)
    moved[i] -= solver.world().model.nodes.reference[i];
  return nodeArray(solver, moved);
}

py::object contactForcesOf(const FESolver& solver) {
  const std::span<const Vec2> known = solver.contactForces();
  std::vector<Vec2> forces(known.begin(), known.end());
  forces.resize(solver.world().model.nodes.size());  // empty before the first contact
  return nodeArray(solver, forces);
}

py::object reactionsOf(const FESolver& solver) {
  std::vector<Vec2> forces = solver.world().reactions;
  forces.resize(solver.world().model.nodes.size());  // empty before the first step
  return nodeArray(solver, forces);
}

py::object fragmentOf(const FESolver& solver) {
  std::vector<std::uint32_t> numbers;
  findFragments(solver.world().model, &numbers, &solver.world().fracture);
  return toArray(numbers).attr("view")("int32");  // −1: removed
}

/// True for a segment of a rigid boundary or of a removed fragment.
bool isHidden(const World& world, SegmentId segment) {
  const ContactSurfaces& surfaces = world.surfaces;
  const EntryId entry = surfaces.segmentEntry[segment.value];
  return surfaces.isGone(segment) ||
         world.model.components[surfaces.component[entry.value].value].rigid;
}

py::list surfacesOf(const FESolver& solver) {
  const ShownNodes all(solver.world());
  const ContactSurfaces& surfaces = solver.world().surfaces;
  std::vector<bool> seen(surfaces.segments());
  py::list loops;
  for (std::size_t first = 0; first < seen.size(); ++first) {
    if (seen[first] || isHidden(solver.world(), SegmentId(first))) continue;
    std::vector<NodeId> loop;
    for (std::size_t s = first; !seen[s]; s = surfaces.segmentNext[s].value) {
      seen[s] = true;
      loop.push_back(all.number(surfaces.segmentNode[s]));
    }
    loops.append(toArray(loop));
  }
  return loops;
}

std::size_t segmentsOf(const FESolver& solver) {
  const ContactSurfaces& surfaces = solver.world().surfaces;
  std::size_t count = surfaces.segments();
  if (solver.world().dropped.count == 0 && !solver.world().hasRigid()) return count;
  for (std::size_t s = 0; s < surfaces.segments(); ++s)
    if (isHidden(solver.world(), SegmentId(s))) --count;
  return count;
}

}  // namespace

void defineArrays(SolverClass& solver) {
  solver
      .add_property("nodes", &Locked<columnOf<&Nodes::position>>::call,
                    "Positions (m), array (n, 2); a copy, as all arrays.")
      .add_property("velocities", &Locked<columnOf<&Nodes::velocity>>::call,
                    "Of the nodes (m/s), array (n, 2).")
      .add_property("displacements", &Locked<displacementsOf>::call,
                    "Of the nodes, from the stress-free shape (m), array (n, 2).")
      .add_property("masses", &Locked<columnOf<&Nodes::mass>>::call,
                    "Of the nodes (kg), array (n).")
      .add_property("triangles", &Locked<trianglesOf>::call,
                    "Node numbers, counter-clockwise, array (m, 3).")
      .add_property("stress", &Locked<stateOf<stresses>>::call,
                    "Cauchy stress xx, yy, xy (Pa) of the triangles, array (m, 3).")
      .add_property("stressZ", &Locked<stateOf<stressesAcross>>::call,
                    "Cauchy stress zz (Pa) of the triangles, across the plane, array (m); 0 in "
                    "plane stress.")
      .add_property(
          "strain", &Locked<strainArrayOf>::call,
          "Green and Lagrange's strain xx, yy, xy (half the shear angle) of the triangles, array "
          "(m, 3): (FᵀF - 1)/2, of each triangle alone where `element` is 'smoothed', too.")
      .add_property("plasticStrain", &Locked<yieldingOf<&YieldPoint::strain>>::call,
                    "Equivalent plastic strain of the triangles, array (m); 0 where the material "
                    "does not yield.")
      .add_property("temperature", &Locked<yieldingOf<&YieldPoint::temperature>>::call,
                    "Of the triangles (K), array (m), raised by plastic work, without conduction; "
                    "0 where the material does not yield.")
      .add_property("damage", &Locked<stateOf<presentDamage>>::call,
                    "Damage of the triangles, array (m), from 0 to 1, where the material has "
                    "failed; 0 where it cannot.")
      .add_property("components", &Locked<componentsOf>::call,
                    "Number of each triangle's body, array (m).")
      .add_property("materialNumbers", &Locked<materialNumbersOf>::call,
                    "Number of each triangle's material among those of its body, in the order of "
                    "their first triangles, array (m); 0 in bodies of one.")
      .add_property(
          "fragmentOf", &Locked<fragmentOf>::call,
          "Number of each triangle's fragment, its place in fragments(), array (m); -1: removed.")
      .add_property("contactForces", &Locked<contactForcesOf>::call,
                    "Contact forces between bodies of this engine, on the nodes, in the last step "
                    "(N), array (n, 2).")
      .add_property("reactions", &Locked<reactionsOf>::call,
                    "Reactions at held nodes in the last step (N), array (n, 2): the support's "
                    "force, besides the node's own weight, its loads and all forces of bodies; 0 "
                    "in free directions, and before the first step and after O.load.")
      .add_property("surfaces", &Locked<surfacesOf>::call,
                    "List of closed loops, each an array of node numbers, material on the left.")
      .add_property("numSegments", &Locked<segmentsOf>::call,
                    "Segments of all surfaces: each crack that opens adds two; those of removed "
                    "fragments do not count.")
      .add_property("_fails", &Locked<anyFails>::call)
      .add_property("_yields", &Locked<anyYields>::call)
      .add_property("_reference", &Locked<columnOf<&Nodes::reference>>::call)
      .add_property("_loads", &Locked<loadsOf>::call)
      .add_property("_names", &Locked<namesOf>::call)
      .def("_nodesOf", &Locked<nodesOfBody>::call)
      .def("_isGone", &Locked<isGone>::call);
}

}  // namespace yadefrag
