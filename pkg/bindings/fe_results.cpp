#include "bindings/fragments.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

#include "bindings/arrays.hpp"
#include "bindings/calls.hpp"
#include "core/disjoint_sets.hpp"
#include "fracture/cohesive_law.hpp"
#include "fracture/edge_strength.hpp"
#include "solver/fe_solver.hpp"
#include "step/overlap_check.hpp"

namespace yadefrag {

namespace {

void joinHeld(const Model& model, const Fracture& fracture, DisjointSets& sets) {
  for (const EdgeId edge : fracture.cohesion.edge)
    sets.join(firstNode(model, fracture.edges.side(edge, 0)).value,
              firstNode(model, fracture.edges.side(edge, 1)).value);
}

/// Computes all properties that follow from the nodes, after their fragments are known.
template <class ForNodes>
void sumNodes(const Nodes& nodes, const ForNodes& forNodes, std::vector<Fragment>& fragments) {
  forNodes([&](Fragment& f, std::size_t i) {
    f.mass += nodes.mass[i];
    f.centroid += nodes.mass[i] * nodes.position[i];
    f.velocity += nodes.mass[i] * nodes.velocity[i];
  });
  for (Fragment& f : fragments) f.centroid *= 1 / f.mass, f.velocity *= 1 / f.mass;
  std::vector<double> inertia(fragments.size());
  forNodes([&](Fragment& f, std::size_t i) {
    const Vec2 arm = nodes.position[i] - f.centroid;
    f.spin += nodes.mass[i] * cross(arm, nodes.velocity[i] - f.velocity);
    inertia[static_cast<std::size_t>(&f - fragments.data())] += nodes.mass[i] * dot(arm, arm);
  });
  for (std::size_t i = 0; i < fragments.size(); ++i) fragments[i].spin /= inertia[i];
}

}  // namespace

std::vector<Fragment> findFragments(const Model& model, std::vector<std::uint32_t>* ofTriangle,
                                    const Fracture* holding) {
  const Nodes& nodes = model.nodes;
  DisjointSets sets(nodes.size());
  for (std::size_t t = 0; t < model.triangles.size(); ++t) {
    if (model.triangles.isDropped(t)) continue;
    const auto& [a, b, c] = model.triangles.nodes[t];
    sets.join(a.value, b.value);
    sets.join(a.value, c.value);
  }
  if (holding) joinHeld(model, *holding, sets);
  std::vector<Fragment> fragments;
  constexpr std::uint32_t none = 0xffffffff;
  std::vector<std::uint32_t> number(nodes.size(), none);
  if (ofTriangle) ofTriangle->assign(model.triangles.size(), none);
  for (std::size_t t = 0; t < model.triangles.size(); ++t) {
    if (model.triangles.isDropped(t)) continue;
    const auto& [a, b, c] = model.triangles.nodes[t];
    std::uint32_t& index = number[sets.find(a.value)];
    if (index == none) {
      index = static_cast<std::uint32_t>(fragments.size());
      fragments.emplace_back().component = model.triangles.component[t];
    }
    const Vec2 at = nodes.position[a.value];
    Fragment& fragment = fragments[index];
    ++fragment.triangles;
    fragment.area += .5 * cross(nodes.position[b.value] - at, nodes.position[c.value] - at);
    if (ofTriangle) (*ofTriangle)[t] = index;
  }
  const auto forNodes = [&](const auto& work) {
    for (std::size_t i = 0; i < nodes.size(); ++i) {
      const std::uint32_t index = number[sets.find(static_cast<std::uint32_t>(i))];
      if (index != none) work(fragments[index], i);
    }
  };
  sumNodes(nodes, forNodes, fragments);
  return fragments;
}

namespace py = yade::py;

namespace {

/// (N) A pair: force of contact of body b on body a in the last step.
py::tuple pairForceOf(const FESolver& solver, int a, int b) {
  const World& world = solver.world();
  const ComponentId one(static_cast<std::size_t>(a)), other(static_cast<std::size_t>(b));
  Vec2 sum;
  for (const ContactRow& row : world.contact.rows()) {
    const ComponentId slave = world.surfaces.component[row.slave.value];
    const ComponentId master = world.surfaces.component[row.master.value];
    if (slave == one && master == other) sum += row.force();
    if (slave == other && master == one) sum -= row.force();
  }
  return py::make_tuple(sum.x, sum.y);
}

/// By edge: index among the cohesive cracks, or kLoose.
constexpr std::uint32_t kLoose = std::numeric_limits<std::uint32_t>::max();

std::vector<std::uint32_t> holdsByEdge(const Fracture& fracture) {
  std::vector<std::uint32_t> holds(fracture.edges.size(), kLoose);
  const auto& held = fracture.cohesion.edge;
  for (std::size_t i = 0; i < held.size(); ++i)
    holds[held[i].value] = static_cast<std::uint32_t>(i);
  return holds;
}

/// Dissipated fraction of the fracture energy: the mean of both ends; 1 without cohesion.
double damageOf(const Model& model, const Fracture& fracture, EdgeId edge, std::uint32_t hold) {
  if (hold == kLoose) return 1;
  const TensionLaw law = tensionLaw(model, fracture.edges, edge);
  double sum = 0;
  for (const double largest : fracture.cohesion.largest[hold]) sum += spentEnergy(law, largest);
  return sum / 2 / fracture.edges.fractureEnergy[edge.value];
}

struct CrackColumns {
  std::vector<std::uint32_t> component, other, triangle;
  std::vector<std::array<NodeId, 4>> nodes;  // nodes of both sides, in opposite pairs
  std::vector<double> x, y, nx, ny, opening, slip, damage, start, strength, energy;
  std::vector<std::uint8_t> held;

  void add(const World& world, EdgeId edge, std::uint32_t hold) {
    const Model& model = world.model;
    const CrackEdges& edges = world.fracture.edges;
    Vec2 middle[2], along[2];
    NodeId first[2], last[2];
    for (int k = 0; k < 2; ++k) {
      const Side side = edges.side(edge, k);
      first[k] = firstNode(model, side), last[k] = lastNode(model, side);
      const Vec2 begin = model.nodes.position[first[k].value];
      const Vec2 end = model.nodes.position[last[k].value];
      middle[k] = .5 * (begin + end), along[k] = end - begin;
    }
    // The second side runs in the opposite direction.
    const Vec2 face = along[0] - along[1];
    const Vec2 tangent = (1 / norm(face)) * face, normal = rightOf(tangent);
    const Vec2 apart = middle[1] - middle[0], place = .5 * (middle[0] + middle[1]);
    const auto& both = edges.element[edge.value];
    nodes.push_back({first[0], last[0], last[1], first[1]});
    triangle.push_back(both[0].value);
    component.push_back(model.triangles.component[both[0].value].value);
    other.push_back(model.triangles.component[both[1].value].value);
    x.push_back(place.x), y.push_back(place.y), nx.push_back(normal.x), ny.push_back(normal.y);
    opening.push_back(dot(apart, normal)), slip.push_back(dot(apart, tangent));
    damage.push_back(damageOf(model, world.fracture, edge, hold));
    held.push_back(hold == kLoose ? 0 : 1);
    const auto& started = world.fracture.started;
    const bool isKnown = edge.value < started.size() && started[edge.value] >= 0;
    start.push_back(isKnown ? started[edge.value] : NAN);
    energy.push_back(edges.fractureEnergy[edge.value]);
    const bool isOpenJoint = !isKnown && energy.back() == 0;
    strength.push_back(isOpenJoint ? 0 : edges.strength[edge.value]);
  }
};

/// A dict of arrays, one row per crack: component, other (bodies on both sides), x, y, nx, ny,
/// opening, slip (m), damage, held, start (s; nan: cracked from the start), strength (Pa), energy
/// (J/m²).
py::dict cracksOf(const FESolver& solver) {
  const World& world = solver.world();
  const CrackEdges& edges = world.fracture.edges;
  const std::vector<std::uint32_t> holds = holdsByEdge(world.fracture);
  CrackColumns columns;
  for (std::size_t i = 0; i < edges.size(); ++i) {
    const auto isDropped = [&](ElementId e) { return world.model.triangles.isDropped(e.value); };
    if (edges.cracked[i] == 0 || std::ranges::any_of(edges.element[i], isDropped)) continue;
    columns.add(world, EdgeId(i), holds[i]);
  }
  const ShownNodes shown(world);
  for (auto& ends : columns.nodes)
    for (NodeId& node : ends) node = shown.number(node);
  const CrackColumns& c = columns;
  return dictOf("component", toArray(c.component), "other", toArray(c.other), "triangle",
                toArray(c.triangle), "nodes", toArray(c.nodes), "x", toArray(c.x), "y",
                toArray(c.y), "nx", toArray(c.nx), "ny", toArray(c.ny), "opening",
                toArray(c.opening), "slip", toArray(c.slip), "damage", toArray(c.damage), "held",
                toArray(c.held).attr("view")("bool"), "start", toArray(c.start), "strength",
                toArray(c.strength), "energy", toArray(c.energy));
}

py::dict energyOf(const FESolver& solver) {
  const World& world = solver.world();
  const EnergyLedger& ledger = world.ledger;
  const double kinetic = world.kineticEnergy(), strain = world.strainEnergy();
  const double pending = world.pendingPlastic();
  const double total = ledger.total(kinetic, strain) + pending;
  py::dict result = dictOf("kinetic", kinetic, "strain", strain, "contact", ledger.contact,
                           "friction", ledger.friction, "fracture", ledger.fracture);
  if (world.model.triangles.plastic.isUsed()) result["plastic"] = ledger.plastic + pending;
  result["damping"] = ledger.damping;
  if (world.dropped.count > 0 || world.fracture.minFragmentArea > 0)
    result["dropped"] = ledger.dropped;
  fill(result, "outside", -ledger.external, "total", total);
  if (solver.balance().any()) result["scene"] = total + solver.balance().created();
  return result;
}

/// (J) Energy that the time integration has created, the largest energy that the bodies could have,
/// and the energy of rounding errors.
py::object energyBalanceOf(const FESolver& solver) {
  const World& world = solver.world();
  const double total =
      world.ledger.total(world.kineticEnergy(), world.strainEnergy()) + world.pendingPlastic();
  const double excess = world.steps > 0 ? total - world.watch.expected : 0;
  return record("excess", excess, "most", world.watch.most, "rounding", world.roundingEnergy());
}

py::list warningsOf(const FESolver& solver) {
  py::list result;
  for (const std::string& sentence : solver.world().warnings) result.append(sentence);
  return result;
}

py::dict droppedOf(const FESolver& solver) {
  const Dropped& dropped = solver.world().dropped;
  return dictOf("mass", dropped.mass, "momentum",
                py::make_tuple(dropped.momentum.x, dropped.momentum.y), "energy",
                solver.world().ledger.dropped, "count", dropped.count);
}

py::list fragmentsOf(const FESolver& solver, bool held) {
  const World& world = solver.world();
  py::list result;
  for (const Fragment& fragment :
       findFragments(world.model, nullptr, held ? &world.fracture : nullptr)) {
    const Vec2 centre = fragment.centroid, velocity = fragment.velocity;
    result.append(dictOf("component", fragment.component.value, "triangles", fragment.triangles,
                         "mass", fragment.mass, "area", fragment.area, "centroid",
                         py::make_tuple(centre.x, centre.y), "velocity",
                         py::make_tuple(velocity.x, velocity.y), "spin", fragment.spin));
  }
  return result;
}

double criticalTimeStepOf(FESolver& solver) { return solver.criticalTimeStep(); }
void noteOf(FESolver& solver, std::string sentence) { solver.note(std::move(sentence)); }
double timeOf(const FESolver& solver) { return solver.world().time; }
std::uint64_t searchesOf(const FESolver& solver) { return solver.world().numSearches(); }
std::size_t activesOf(const FESolver& solver) { return solver.world().contact.rows().size(); }
double penetrationOf(const FESolver& solver) { return solver.world().contact.maxPenetration(); }
double deepestOverlapOf(const FESolver& solver) {
  return deepestOverlap(solver.world().model, solver.world().threads);
}
std::uint64_t numCracksOf(const FESolver& solver) { return solver.world().fracture.numCracks(); }

}  // namespace

void defineResults(SolverClass& solver) {
  solver
      .def("criticalTimeStep", &Locked<criticalTimeStepOf>::call,
           "Critical time step (s) of the present mesh; of a body that can crack also when all its "
           "triangles are separated; infinite without bodies. An O.dt that changes all the time "
           "should stay below a third of it. Spheres are not considered: see the manual, Limits.")
      .def("deepestOverlap", &Locked<deepestOverlapOf>::call,
           "Deepest overlap (m) of any two triangles without a common node: the shortest "
           "translation that separates them, at most a triangle's height. Checks all triangles at "
           "each call, independently of contact; maxPenetration considers only points in contact. "
           "0, except for rounding, where bodies touch.")
      .def("fragments", &Locked<fragmentsOf>::call, (yade::py::arg("held") = true),
           "List of dicts, one per part that has come apart: component (of its first triangle), "
           "triangles (their number), mass (kg), area (m²), centroid (m), velocity (m/s), spin "
           "(rad/s). Parts that cohesion or a bond still holds together are one fragment; with "
           "held=False every crack separates, also one that has hardly opened.")
      .def("_pairForce", &Locked<pairForceOf>::call)
      .def("_cracks", &Locked<cracksOf>::call)
      .def("_note", &Locked<noteOf>::call)
      .def(
          "_lock", +[](const FESolver& self) { self.betweenSteps().lock(); })
      .def(
          "_unlock", +[](const FESolver& self) { self.betweenSteps().unlock(); })
      .add_property("time", &Locked<timeOf>::call,
                    "Simulated time of the bodies (s); motions and loads that vary with time are "
                    "functions of it.")
      .add_property("dropped", &Locked<droppedOf>::call,
                    "Removed fragments (smaller than minFragmentArea), a dict: mass (kg), momentum "
                    "(kg m/s, a pair), energy (J) at their removal, count.")
      .add_property("_energies", &Locked<energyOf>::call)
      .add_property("_energyBalance", &Locked<energyBalanceOf>::call);
  solver
      .add_property("warnings", &Locked<warningsOf>::call,
                    "Warnings of numerical errors: energy that contact, cracks or the time "
                    "integration have created, above 1 % of the bodies' energy and above rounding, "
                    "and penetration above a tenth of the shortest segment. One per doubling, each "
                    "also written to stderr when it occurs.")
      .add_property("numSearches", &Locked<searchesOf>::call, "Contact searches so far.")
      .add_property("numActives", &Locked<activesOf>::call, "Points in contact in the last step.")
      .add_property("maxPenetration", &Locked<penetrationOf>::call,
                    "Deepest remaining penetration (m) at points in contact in the last step; "
                    "deepestOverlap() checks all triangles.")
      .add_property("numCracks", &Locked<numCracksOf>::call,
                    "Cracked edges so far, without bonds and joints that are open from the start. "
                    "Some may still hold: see crackCounts.");
}

}  // namespace yadefrag
