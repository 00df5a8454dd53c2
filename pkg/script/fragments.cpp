#include "script/fragments.hpp"

#include "core/disjoint_sets.hpp"

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

}  // namespace yadefrag
