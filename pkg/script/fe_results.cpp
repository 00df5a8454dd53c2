#include "script/fe_results.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

#include "dynamics/element_state.hpp"
#include "fe/fe_solver.hpp"
#include "fracture/cohesive_law.hpp"
#include "fracture/edge_material.hpp"
#include "script/arrays.hpp"
#include "script/shown_nodes.hpp"

namespace yadefrag {

namespace py = yade::py;

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

namespace {

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
  std::vector<double> x, y, nx, ny, opening, slip, damage, start;
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
  }
};

}  // namespace

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
  py::dict table;
  table["component"] = toArray(columns.component);
  table["other"] = toArray(columns.other);
  table["triangle"] = toArray(columns.triangle);
  table["nodes"] = toArray(columns.nodes);
  table["x"] = toArray(columns.x), table["y"] = toArray(columns.y);
  table["nx"] = toArray(columns.nx), table["ny"] = toArray(columns.ny);
  table["opening"] = toArray(columns.opening);
  table["slip"] = toArray(columns.slip);
  table["damage"] = toArray(columns.damage);
  table["held"] = toArray(columns.held).attr("view")("bool");
  table["start"] = toArray(columns.start);
  return table;
}

}  // namespace yadefrag
