#include "script/fe_arrays.hpp"

#include "dynamics/element_state.hpp"
#include "fracture/brittle_checks.hpp"
#include "script/arrays.hpp"
#include "script/calls.hpp"
#include "script/fragments.hpp"
#include "script/shown_nodes.hpp"

namespace yadefrag {

namespace py = yade::py;

namespace {

/// A column by node, in the numbering of scripts.
template <class Value>
py::object nodeArray(const FESolver& solver, const std::vector<Value>& column) {
  if (!solver.world().hasRigid()) return toArray(column);
  return toArray(ShownNodes(solver.world()).rows(column));
}

std::vector<NodeId> nodesFrom(const FESolver& solver, const py::object& numbers) {
  return ShownNodes(solver.world()).nodes(fromArray<NodeId>(numbers));
}

}  // namespace

void takeBody(FESolver& solver, int component) {
  change(solver, [&] { solver.removeBody(component); });
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

namespace {

std::uint32_t numberOf(FESolver& solver, const py::object& function) {
  ScriptFunctions& functions = solver.scriptFunctions();
  functions.keep(solver.world());
  return function.is_none() ? 0 : functions.add(function);
}

}  // namespace

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

py::object loadsOf(const FESolver& solver) {
  const Nodes& nodes = solver.world().model.nodes;
  if (!nodes.load.empty()) return nodeArray(solver, nodes.load);
  return toArray(std::vector<Vec2>(ShownNodes(solver.world()).size()));
}

py::object nodesOf(const FESolver& solver) {
  return nodeArray(solver, solver.world().model.nodes.position);
}
py::object velocitiesOf(const FESolver& solver) {
  return nodeArray(solver, solver.world().model.nodes.velocity);
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
py::object massesOf(const FESolver& solver) {
  return nodeArray(solver, solver.world().model.nodes.mass);
}
py::object trianglesOf(const FESolver& solver) {
  const ShownNodes all(solver.world());
  auto triangles = solver.world().model.triangles.nodes;
  if (solver.world().hasRigid())
    for (auto& corners : triangles)
      for (NodeId& node : corners) node = all.number(node);
  return toArray(triangles);
}
py::object stressArrayOf(const FESolver& solver) { return toArray(stresses(solver.world().model)); }
py::object componentsOf(const FESolver& solver) {
  return toArray(solver.world().model.triangles.component);
}

py::object materialNumbersOf(const FESolver& solver) {
  const Triangles& triangles = solver.world().model.triangles;
  if (!triangles.material.empty()) return toArray(triangles.material);
  return toArray(std::vector<std::uint32_t>(triangles.size()));
}

py::object displacementsOf(const FESolver& solver) {
  std::vector<Vec2> moved = solver.world().model.nodes.position;
  for (std::size_t i = 0; i < moved.size(); ++i) moved[i] -= solver.world().reference[i];
  return nodeArray(solver, moved);
}

py::object contactForcesOf(const FESolver& solver) {
  const std::span<const Vec2> known = solver.world().contact.forces().known;
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

py::object referenceOf(const FESolver& solver) {
  return nodeArray(solver, solver.world().reference);
}

namespace {

/// True for a segment of a rigid boundary or of a removed fragment.
bool isHidden(const World& world, SegmentId segment) {
  const ContactSurfaces& surfaces = world.surfaces;
  const EntryId entry = surfaces.segmentEntry[segment.value];
  return surfaces.isGone(segment) ||
         world.model.components[surfaces.component[entry.value].value].rigid;
}

}  // namespace

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

py::dict energyOf(const FESolver& solver) {
  const World& world = solver.world();
  const EnergyLedger& ledger = world.ledger;
  const double kinetic = world.kineticEnergy();
  const double strain = world.strainEnergy();
  py::dict result;
  result["kinetic"] = kinetic;
  result["strain"] = strain;
  result["contact"] = ledger.contact;
  result["friction"] = ledger.friction;
  result["fracture"] = ledger.fracture;
  result["damping"] = ledger.damping;
  if (solver.world().dropped.count > 0 || solver.world().fracture.minFragmentArea > 0)
    result["dropped"] = ledger.dropped;
  result["outside"] = -ledger.external;
  result["total"] = ledger.total(kinetic, strain);
  if (solver.balance().any())
    result["scene"] = ledger.total(kinetic, strain) + solver.balance().created();
  return result;
}

py::tuple energyBalanceOf(const FESolver& solver) {
  const World& world = solver.world();
  const double total = world.ledger.total(world.kineticEnergy(), world.strainEnergy());
  const double excess = world.steps > 0 ? total - world.watch.expected : 0;
  return py::make_tuple(excess, world.watch.most, world.roundingEnergy());
}

py::list warningsOf(const FESolver& solver) {
  py::list result;
  for (const std::string& sentence : solver.world().warnings) result.append(sentence);
  return result;
}

py::dict droppedOf(const FESolver& solver) {
  const World& world = solver.world();
  const Dropped& dropped = world.dropped;
  py::dict result;
  result["mass"] = dropped.mass;
  result["momentum"] = py::make_tuple(dropped.momentum.x, dropped.momentum.y);
  result["energy"] = world.ledger.dropped;
  result["count"] = dropped.count;
  return result;
}

std::size_t segmentsOf(const FESolver& solver) {
  const ContactSurfaces& surfaces = solver.world().surfaces;
  std::size_t count = surfaces.segments();
  if (solver.world().dropped.count == 0 && !solver.world().hasRigid()) return count;
  for (std::size_t s = 0; s < surfaces.segments(); ++s)
    if (isHidden(solver.world(), SegmentId(s))) --count;
  return count;
}

py::list fragmentsOf(const FESolver& solver, bool held) {
  const World& world = solver.world();
  py::list result;
  for (const Fragment& fragment :
       findFragments(world.model, nullptr, held ? &world.fracture : nullptr)) {
    py::dict one;
    one["component"] = fragment.component.value;
    one["triangles"] = fragment.triangles;
    one["mass"] = fragment.mass;
    one["area"] = fragment.area;
    one["centroid"] = py::make_tuple(fragment.centroid.x, fragment.centroid.y);
    one["velocity"] = py::make_tuple(fragment.velocity.x, fragment.velocity.y);
    one["spin"] = fragment.spin;
    result.append(one);
  }
  return result;
}

}  // namespace yadefrag
