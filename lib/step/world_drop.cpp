// World: removal of detached fragments below a given area.

#include <algorithm>

#include "core/arrays.hpp"

#include "step/world.hpp"

namespace yadefrag {

/// Must be called after the cracks of a step; `split`: nodes have split. Checks only the
/// surroundings of splits, and everything after a body was added or the area changed.
void World::dropFragments(bool split) {
  const double area = fracture.minFragmentArea;
  if (area <= 0 || !fracture.isOn()) {
    droppedBelow_ = 0;
    return;
  }
  const StageTimer timer(timesIfRequested(), &StageTimes::fracture);
  std::vector<ElementId> around;
  if (droppedBelow_ != area) {
    for (std::size_t e = 0; e < fracture.edges.ofElement.size(); ++e)
      if (model.components[model.triangles.component[e].value].brittle.cracks())
        around.emplace_back(e);
  } else {
    for (const EdgeId edge : fracture.cohesion.released)
      for (const ElementId element : fracture.edges.element[edge.value]) around.push_back(element);
    if (split) {
      const std::size_t firstNew = model.nodes.size() - split_.originals.size();
      for (std::size_t i = 0; i < split_.originals.size(); ++i) {
        around.push_back(fracture.edges.ofNode[split_.originals[i].value]);
        around.push_back(fracture.edges.ofNode[firstNew + i]);
      }
    }
  }
  droppedBelow_ = area;
  if (around.empty()) return;
  loose_.find(model, fracture.edges, fracture.cohesion, around, area);
  if (!loose_.triangles.empty()) takeOut(loose_.triangles);
}

/// Triangles, nodes and entries keep their numbers. The triangles get their stress-free shape at
/// rest, so that they never move or crack again.
void World::takeOut(std::span<const ElementId> triangles) {
  std::vector<NodeId> nodes;
  for (const ElementId element : triangles) {
    const auto& corners = model.triangles.nodes[element.value];
    nodes.insert(nodes.end(), corners.begin(), corners.end());
  }
  sortUnique(nodes);

  dropped.count += loose_.count;
  ledger.dropped += yadefrag::strainEnergy(model, lastDt, triangles);
  for (const NodeId node : nodes) {
    double& mass = model.nodes.mass[node.value];
    Vec2& velocity = model.nodes.velocity[node.value];
    dropped.mass += mass;
    dropped.momentum += mass * velocity;
    ledger.dropped += mass / 2 * dot(velocity, velocity);
    mass = 0;
    velocity = {};
    if (node.value < reactions.size()) reactions[node.value] = {};
    model.nodes.position[node.value] = model.nodes.reference[node.value];
    model.nodes.held[node.value] = kHeldXY;
  }
  for (const ElementId element : triangles) {
    model.triangles.area[element.value] = 0;
    PlasticState& flowed = model.triangles.plastic;
    if (flowed.isUsed())
      flowed.begin(element.value, model.triangles.inverseEdges[element.value],
                   flowed.temperature[element.value]);
  }
  dynamics_.drop(model, nodes);
  fracture.cohesion.removeDropped(model.triangles, fracture.edges);
  surfaces.drop(nodes);
  contact.removeGone(surfaces);
  search.removeDropped(model);
  measureFinest();
}

}  // namespace yadefrag
