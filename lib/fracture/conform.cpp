#include "fracture/conform.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <tuple>

#include "core/tolerances/fracture.hpp"
#include "fracture/bonds.hpp"

namespace yadefrag {
namespace {

double distanceToLine(Vec2 x, Vec2 a, Vec2 b) {
  return std::abs(cross(b - a, x - a)) / norm(b - a);
}

double twiceArea(Vec2 a, Vec2 b, Vec2 c) { return cross(b - a, c - a); }

class Conforming {
 public:
  Conforming(const Model& model, const CrackEdges& edges, std::span<const ComponentId> bodies,
             double reach)
      : model_(model),
        start_(model.nodes.position),
        places_(model.nodes.position),
        free_(model, edges, bodies),
        reach_(reach),
        before_(start_.size(), NodeId::none()),
        after_(start_.size(), NodeId::none()),
        clusterOf_(start_.size(), kAlone),
        fans_(start_.size()) {
    for (const Side side : free_.sides) {
      after_[firstNode(model, side).value] = lastNode(model, side);
      before_[lastNode(model, side).value] = firstNode(model, side);
    }
    for (const ComponentId body : bodies) {
      const Component& own = model.components[body.value];
      for (std::uint32_t e = own.firstTriangle; e < own.lastTriangle; ++e)
        for (const NodeId node : model.triangles.nodes[e])
          if (after_[node.value] != NodeId::none() && !model.triangles.isDropped(e))
            fans_[node.value].emplace_back(e);
    }
  }

  ConformPlan run() {
    while (joinNodes()) {
    }
    ConformPlan plan;
    for (std::size_t n = 0; n < places_.size(); ++n) {
      if (places_[n] == start_[n]) continue;
      const NodeId node(n);
      plan.moves.push_back({node, places_[n]});
      const double shift = norm(places_[n] - start_[n]);
      if (isStraight(node) || shift <= nearOf(node)) continue;
      ++plan.corners;
      plan.farthest = std::max(plan.farthest, shift);
    }
    plan.newNodes = newNodes();
    return plan;
  }

 private:
  static constexpr std::uint32_t kAlone = ~std::uint32_t{0};

  struct Candidate {
    double distance;  // m
    NodeId a, b;
    double length;  // m, of the shorter side
    friend bool operator<(const Candidate& x, const Candidate& y) {
      return std::tie(x.distance, x.a, x.b) < std::tie(y.distance, y.a, y.b);
    }
  };

  struct Division : NewNode {
    double least;  // m, to other new nodes of the side
  };

  /// Calls `use(i, k)` for all pairs of sides of two bodies that run along each other.
  template <class Use>
  void forPairs(const std::vector<Line>& lines, Use use) const {
    for (const BoxPair& pair : nearPairs(lines, reach_)) {
      const std::size_t i = pair.first.value, k = pair.second.value;
      if (free_.owners[i] == free_.owners[k]) continue;
      if (match(lines[i], lines[k]) || runAlong(lines[i], lines[k], reach_)) use(i, k);
    }
  }

  [[nodiscard]] std::array<NodeId, 2> endsOf(std::size_t side) const {
    return {firstNode(model_, free_.sides[side]), lastNode(model_, free_.sides[side])};
  }

  /// Joins nodes of two bodies, nearest ones first. Returns true if any were joined.
  bool joinNodes() {
    const std::vector<Line> lines = linesOf(model_, places_, free_.sides);
    std::vector<Candidate> candidates;
    forPairs(lines, [&](std::size_t i, std::size_t k) {
      const double length = std::min(lines[i].length(), lines[k].length());
      const double most = std::max(reachOf(length, reach_), tolerance::kSlide * length);
      for (const NodeId a : endsOf(i))
        for (const NodeId b : endsOf(k)) {
          const double distance = norm(places_[a.value] - places_[b.value]);
          if (distance <= most) candidates.push_back({distance, a, b, length});
        }
    });
    std::sort(candidates.begin(), candidates.end());
    bool any = false;
    for (const Candidate& one : candidates) any = join(one) || any;
    return any;
  }

  [[nodiscard]] std::vector<NodeId> clusterAt(NodeId node) const {
    const std::uint32_t cluster = clusterOf_[node.value];
    return cluster == kAlone ? std::vector{node} : clusters_[cluster];
  }
  [[nodiscard]] bool hasNodeOf(const std::vector<NodeId>& cluster, ComponentId body) const {
    return std::ranges::any_of(cluster,
                               [&](NodeId n) { return model_.nodes.component[n.value] == body; });
  }

  bool join(const Candidate& pair) {
    std::vector<NodeId> a = clusterAt(pair.a), b = clusterAt(pair.b);
    for (const NodeId node : a)
      if (hasNodeOf(b, model_.nodes.component[node.value])) return false;
    const Vec2 placeA = places_[pair.a.value], placeB = places_[pair.b.value];
    if (norm(placeA - placeB) > samePlace(pair.length, placeA, placeB)) {
      const bool firstMoves = ease(a) > ease(b);
      if (!move(firstMoves ? a : b, firstMoves ? placeB : placeA, pair.length) &&
          !move(firstMoves ? b : a, firstMoves ? placeA : placeB, pair.length))
        return false;
    }
    a.insert(a.end(), b.begin(), b.end());
    for (const NodeId node : a)
      clusterOf_[node.value] = static_cast<std::uint32_t>(clusters_.size());
    clusters_.push_back(std::move(a));
    return true;
  }

  /// (m) The cluster with the greater value moves: the one without corners, with the longer sides.
  [[nodiscard]] double ease(const std::vector<NodeId>& cluster) const {
    double least = INFINITY;
    for (const NodeId node : cluster)
      least = std::min(least, canMove(node) && isStraight(node) ? lengthAt(node) : 0);
    return least;
  }

  bool move(const std::vector<NodeId>& cluster, Vec2 to, double length) {
    for (const NodeId node : cluster)
      if (!canMoveTo(node, to, length)) return false;
    for (const NodeId node : cluster) places_[node.value] = to;
    return true;
  }

  /// Not at a bond or a crack's face, and not held by a motion whose arm refers to the place.
  [[nodiscard]] bool canMove(NodeId node) const {
    return before_[node.value] != NodeId::none() && after_[node.value] != NodeId::none() &&
           (model_.nodes.motion.empty() || model_.nodes.motion[node.value] == 0);
  }
  [[nodiscard]] Vec2 startOf(NodeId node) const { return start_[node.value]; }
  /// (m) The shorter one of the two sides at a node.
  [[nodiscard]] double lengthAt(NodeId node) const {
    return std::min(norm(startOf(before_[node.value]) - startOf(node)),
                    norm(startOf(after_[node.value]) - startOf(node)));
  }
  [[nodiscard]] double nearOf(NodeId node) const { return reachOf(lengthAt(node), reach_); }
  [[nodiscard]] bool isStraight(NodeId node) const {
    const Vec2 chord = startOf(after_[node.value]) - startOf(before_[node.value]);
    const Vec2 here = startOf(node) - startOf(before_[node.value]);
    return dot(chord, startOf(after_[node.value]) - startOf(node)) > 0 && dot(chord, here) > 0 &&
           std::abs(cross(chord, here)) <= nearOf(node) * norm(chord);
  }

  /// Along one of its two sides, up to the larger one of the gap and a part of the side; `length`
  /// (m): of the shorter one of the sides that are to match.
  [[nodiscard]] bool canMoveTo(NodeId node, Vec2 to, double length) const {
    if (!canMove(node)) return false;
    const double near = nearOf(node);
    const Vec2 here = startOf(node);
    const double most =
        isStraight(node) ? tolerance::kSlide * lengthAt(node) : tolerance::kJoinedCorners * length;
    if (norm(to - here) > std::max(near, most) ||
        std::min(distanceToLine(to, startOf(before_[node.value]), here),
                 distanceToLine(to, here, startOf(after_[node.value]))) > near)
      return false;
    return std::ranges::all_of(fans_[node.value], [&](ElementId element) {
      std::array<Vec2, 3> now, then;
      for (std::size_t i = 0; i < 3; ++i) {
        const NodeId corner = model_.triangles.nodes[element.value][i];
        then[i] = startOf(corner);
        now[i] = corner == node ? to : places_[corner.value];
      }
      return twiceArea(now[0], now[1], now[2]) >=
             tolerance::kLeastSqueezed * twiceArea(then[0], then[1], then[2]);
    });
  }

  /// The ends of sides that divide a side opposite them.
  [[nodiscard]] std::vector<NewNode> newNodes() const {
    const std::vector<Line> lines = linesOf(model_, places_, free_.sides);
    std::vector<Division> found;
    forPairs(lines, [&](std::size_t i, std::size_t k) {
      if (match(lines[i], lines[k])) return;
      addDivisions(lines, i, k, found);
      addDivisions(lines, k, i, found);
    });
    std::ranges::sort(found, [](const Division& a, const Division& b) {
      return std::tie(a.side, a.part, a.at.x, a.at.y) < std::tie(b.side, b.part, b.at.x, b.at.y);
    });
    // Ends of several sides may lie at one place.
    std::vector<NewNode> kept;
    for (const Division& one : found)
      if (kept.empty() || kept.back().side != one.side ||
          norm(kept.back().at - one.at) >= one.least)
        kept.push_back(one);
    return kept;
  }

  /// Ends of side `i` on side `k`.
  void addDivisions(const std::vector<Line>& lines, std::size_t i, std::size_t k,
                    std::vector<Division>& found) const {
    const Line& line = lines[k];
    const double length = line.length(), shorter = std::min(length, lines[i].length());
    const Vec2 along = (1 / length) * (line.end - line.begin);
    const double least = tolerance::kJoinedCorners * shorter;
    const Side side = free_.sides[k];
    const NodeId apex = model_.triangles.nodes[side.element.value][beforeCorner(side.corner)];
    const Vec2 top = places_[apex.value];
    for (const NodeId node : endsOf(i)) {
      const Vec2 at = places_[node.value];
      const double from = dot(at - line.begin, along);
      if (from < least || length - from < least ||
          std::abs(cross(along, at - line.begin)) > reachOf(shorter, reach_) ||
          hasNodeOf(clusterAt(node), free_.owners[k]))
        continue;
      const double whole =
          tolerance::kLeastSqueezed / length * twiceArea(line.begin, line.end, top);
      if (twiceArea(line.begin, at, top) < from * whole ||
          twiceArea(at, line.end, top) < (length - from) * whole)
        continue;
      found.push_back({{side, from / length, at}, least});
    }
  }

  const Model& model_;
  const std::vector<Vec2>& start_;  // m, by node
  std::vector<Vec2> places_;        // m, by node
  FreeSides free_;
  double reach_;
  std::vector<NodeId> before_, after_;  // by node: its neighbours along free sides
  std::vector<std::uint32_t> clusterOf_;
  std::vector<std::vector<NodeId>> clusters_;  // nodes at one place; former ones have no members
  std::vector<std::vector<ElementId>> fans_;   // by node: of nodes at free sides
};

}  // namespace

ConformPlan planConforming(const Model& model, const CrackEdges& edges,
                           std::span<const ComponentId> bodies, double reach) {
  return Conforming(model, edges, bodies, reach).run();
}

}  // namespace yadefrag
