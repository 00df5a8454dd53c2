#include "fracture/fracture.hpp"

#include <algorithm>
#include <cassert>

#include "core/arrays.hpp"

namespace yadefrag {
namespace {

/// True if a side is a face: it has no twin, or is separated from it at one end at least.
bool isVisible(const Model& model, const CrackEdges& edges, Side side) {
  if (edges.across(side) != ElementId::none()) return false;
  const Side twin = edges.twin(side);
  return twin.element == ElementId::none() || firstNode(model, side) != lastNode(model, twin) ||
         lastNode(model, side) != firstNode(model, twin);
}

/// The fan of a node before its edges crack.
struct Fan {
  NodeId node;
  std::uint32_t begin, end;  // in the list of triangles
  bool ring;
};

class Splitting {
 public:
  Splitting(Model& model, CrackEdges& edges, SplitResult& result)
      : model_(model), edges_(edges), result_(result) {}

  /// The fans around the ends of the cracks, before the separation.
  void collectFans(std::span<const EdgeId> cracks) {
    std::vector<NodeId> ends;
    for (const EdgeId edge : cracks) {
      const Side side = edges_.side(edge, 0);
      ends.push_back(firstNode(model_, side));
      ends.push_back(lastNode(model_, side));
    }
    sortUnique(ends);
    for (const NodeId node : ends) {
      const auto begin = static_cast<std::uint32_t>(triangles_.size());
      const bool ring = edges_.appendFan(model_, node, triangles_);
      fans_.push_back({node, begin, static_cast<std::uint32_t>(triangles_.size()), ring});
    }
  }

  /// The sides around those nodes, with their present segments.
  void collectSides(const ContactSurfaces& surfaces) {
    for (const Fan& fan : fans_)
      for (std::uint32_t i = fan.begin; i < fan.end; ++i) {
        const int corner = cornerOf(model_, triangles_[i], fan.node);
        sides_.push_back({triangles_[i], static_cast<std::uint8_t>(corner)});
        sides_.push_back({triangles_[i], beforeCorner(corner)});
      }
    sortUnique(sides_);
    for (const Side side : sides_)
      segments_.push_back(isVisible(model_, edges_, side)
                              ? surfaces.nodeSegment[firstNode(model_, side).value]
                              : SegmentId::none());
  }

  void split(const Fan& fan) {
    std::span<ElementId> row(triangles_.data() + fan.begin, fan.end - fan.begin);
    if (fan.ring) turnToCrack(fan.node, row);
    // A part ends where the next triangle is no longer across.
    std::vector<std::span<const ElementId>> parts;
    std::size_t begin = 0;
    for (std::size_t i = 0; i < row.size(); ++i)
      if (i + 1 == row.size() || counterClockwise(row[i], fan.node) == ElementId::none()) {
        parts.emplace_back(row.subspan(begin, i + 1 - begin));
        begin = i + 1;
      }
    if (parts.size() < 2) return;
    // The part with the lowest triangle keeps the old node.
    const auto keeper =
        std::min_element(parts.begin(), parts.end(), [](const auto& a, const auto& b) {
          return *std::min_element(a.begin(), a.end()) < *std::min_element(b.begin(), b.end());
        });
    const double whole = model_.nodes.mass[fan.node.value];
    const Vec2 load =
        model_.nodes.load.empty() ? Vec2{} : (1 / whole) * model_.nodes.load[fan.node.value];
    for (auto part = parts.begin(); part != parts.end(); ++part)
      giveNode(part == keeper ? fan.node : duplicate(fan.node), fan.node, *part, load);
  }

  void splitAll() {
    for (const Fan& fan : fans_) split(fan);
    sortUnique(result_.changed);
  }

  void listSides(const ContactSurfaces& surfaces) {
    for (std::size_t i = 0; i < sides_.size(); ++i)
      if (isVisible(model_, edges_, sides_[i]))
        result_.sides.push_back({segments_[i], firstNode(model_, sides_[i]),
                                 lastNode(model_, sides_[i]),
                                 model_.triangles.component[sides_[i].element.value]});
    std::vector<NodeId> shown;
    for (const SurfaceSide& side : result_.sides)
      if (side.segment == SegmentId::none()) shown.insert(shown.end(), {side.first, side.last});
    sortUnique(shown);
    for (const NodeId node : shown)
      if (node.value < firstNew_ && isInside(surfaces, node)) result_.onSurface.push_back(node);
  }

  static bool isInside(const ContactSurfaces& surfaces, NodeId node) {
    return node.value >= surfaces.nodeSegment.size() ||
           surfaces.nodeSegment[node.value] == SegmentId::none();
  }

  void begin() { firstNew_ = static_cast<std::uint32_t>(model_.nodes.size()); }

 private:
  [[nodiscard]] ElementId counterClockwise(ElementId element, NodeId node) const {
    return edges_.across({element, beforeCorner(cornerOf(model_, element, node))});
  }

  /// Rotates the row of a ring so that it begins behind a crack, if there is one.
  void turnToCrack(NodeId node, std::span<ElementId> row) const {
    const auto cut = std::find_if(row.begin(), row.end(), [&](ElementId element) {
      return counterClockwise(element, node) == ElementId::none();
    });
    if (cut != row.end()) std::rotate(row.begin(), cut + 1, row.end());
  }

  NodeId duplicate(NodeId node) {
    result_.originals.push_back(node);
    const NodeId added = model_.nodes.duplicate(node);
    edges_.ofNode.resize(model_.nodes.size(), ElementId::none());
    return added;
  }

  /// `load`: force per mass.
  void giveNode(NodeId node, NodeId former, std::span<const ElementId> part, Vec2 load) {
    double mass = 0;
    for (const ElementId element : part) {
      const Triangles& triangles = model_.triangles;
      const auto corner = static_cast<std::size_t>(cornerOf(model_, element, former));
      mass += model_.materialOf(element).material.density * model_.depthOf(element) *
              triangles.area[element.value] / 3 * model_.massShare(element, corner);
      if (node == former) continue;
      model_.triangles.nodes[element.value][corner] = node;
      result_.changed.push_back(element);
    }
    edges_.ofNode[node.value] = part.front();
    model_.nodes.mass[node.value] = mass;
    if (!model_.nodes.load.empty()) model_.nodes.load[node.value] = mass * load;
  }

  Model& model_;
  CrackEdges& edges_;
  SplitResult& result_;
  std::vector<Fan> fans_;
  std::vector<ElementId> triangles_;  // triangles of the fans
  std::vector<Side> sides_;
  std::vector<SegmentId> segments_;
  std::uint32_t firstNew_ = 0;
};

}  // namespace

void splitNodes(Model& model, CrackEdges& edges, const ContactSurfaces& surfaces,
                std::span<const EdgeId> cracks, SplitResult& result) {
  assert(std::ranges::is_sorted(cracks));
  assert(std::ranges::none_of(cracks, [&](EdgeId e) { return edges.cracked[e.value] != 0; }));
  result = {};
  Splitting splitting(model, edges, result);
  splitting.begin();
  splitting.collectFans(cracks);
  splitting.collectSides(surfaces);
  for (const EdgeId edge : cracks) edges.cracked[edge.value] = 1;
  splitting.splitAll();
  splitting.listSides(surfaces);
  assert(std::ranges::is_sorted(result.changed));
}

}  // namespace yadefrag
