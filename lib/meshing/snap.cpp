#include "meshing/polygon.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>
#include <string>

#include "core/errors.hpp"
#include "core/tolerances/mesh.hpp"
#include "search/contact_search.hpp"

namespace yadefrag {
namespace {

using Side = std::array<Vec2, 2>;

Box boxAround(Vec2 a, Vec2 b, double reach) {
  return {{std::min(a.x, b.x) - reach, std::min(a.y, b.y) - reach, 0},
          {std::max(a.x, b.x) + reach, std::max(a.y, b.y) + reach, 0}};
}

/// Position along a side, from 0 to 1, of the foot of p; outside of that for a p beyond an end.
double shareOf(Vec2 p, Vec2 a, Vec2 b) { return dot(p - a, b - a) / dot(b - a, b - a); }

/// (m) Distance to the left of the line from a to b.
double leftOf(Vec2 p, Vec2 a, Vec2 b) { return cross(b - a, p - a) / norm(b - a); }

struct Vertex {
  Vec2 at;
  std::uint32_t number;
  bool isInserted;
};
using Chain = std::vector<Vertex>;

class Neighbours {
 public:
  explicit Neighbours(const SnapSides& sides)
      : sides_(sides), search_(makeSearch(SearchMethod::kLebesgue)) {
    boxes_.reserve(sides.size());
    for (const Side& side : sides) boxes_.push_back(boxAround(side[0], side[1], 0));
    search_->update(boxes_);
  }

  /// The sides that may be within `reach` of a line, in their order.
  [[nodiscard]] std::vector<Side> near(Vec2 a, Vec2 b, double reach) const {
    std::vector<BoxId> found;
    search_->findOverlaps(boxAround(a, b, reach), found);
    std::sort(found.begin(), found.end());
    std::vector<Side> sides;
    sides.reserve(found.size());
    for (const BoxId id : found) sides.push_back(sides_[id.value]);
    return sides;
  }

 private:
  const SnapSides& sides_;
  std::vector<Box> boxes_;
  std::unique_ptr<ContactSearch> search_;
};

class Snapper {
 public:
  Snapper(const SnapSides& neighbours, const SnapRule& rule) : near_(neighbours), rule_(rule) {}

  SnappedLoop snap(const std::vector<Vec2>& loop, bool moves) {
    for (const Vec2 p : loop)
      rounding_ = std::max({rounding_, tolerance::kSnapRounding * std::abs(p.x),
                            tolerance::kSnapRounding * std::abs(p.y)});
    Chain chain;
    for (std::uint32_t i = 0; i < loop.size(); ++i)
      chain.push_back({moves ? movedOnto(loop[i]) : loop[i], i, false});
    if (moves) dropRepeated(chain);
    chain = refined(chain);
    dropRepeated(chain);
    if (!rule_.matchesNodes)
      for (int round = 0; round < kRetreats && retreat(chain); ++round) continue;
    SnappedLoop result;
    for (const Vertex& v : chain) {
      result.points.push_back(v.at);
      result.vertex.push_back(v.number);
      result.isInserted.push_back(v.isInserted ? 1 : 0);
      if (v.isInserted) {
        ++count_.inserted;
        continue;
      }
      const double way = norm(v.at - loop[v.number]);
      if (way > 0) ++count_.moved;
      count_.farthest = std::max(count_.farthest, way);
    }
    return result;
  }

  [[nodiscard]] const SnapCount& count() const { return count_; }

 private:
  static constexpr int kRetreats = 8;

  /// The nearest vertex within the tolerance, or else the nearest point of a side, or else p.
  [[nodiscard]] Vec2 movedOnto(Vec2 p) const {
    double vertexWay = rule_.tolerance, sideWay = rule_.tolerance;
    std::optional<Vec2> vertex, side;
    for (const auto& [a, b] : near_.near(p, p, rule_.tolerance)) {
      for (const Vec2 end : {a, b})
        if (const double way = norm(end - p); way <= vertexWay && (!vertex || way < vertexWay))
          vertex = end, vertexWay = way;
      const Vec2 foot = a + std::clamp(shareOf(p, a, b), 0., 1.) * (b - a);
      if (const double way = norm(foot - p); way <= sideWay && (!side || way < sideWay))
        side = foot, sideWay = way;
    }
    if (vertex) return *vertex;
    return side && sideWay > rounding_ ? *side : p;
  }

  /// Removes points that follow themselves, and tips without area.
  static void dropRepeated(Chain& chain) {
    for (std::size_t i = 0; chain.size() > 2 && i < chain.size();) {
      const std::size_t n = chain.size(), next = (i + 1) % n, after = (i + 2) % n;
      if (chain[i].at == chain[next].at) {
        // Given vertices have priority over inserted ones.
        const std::size_t gone = chain[i].isInserted ? i : next;
        chain.erase(chain.begin() + static_cast<std::ptrdiff_t>(gone));
      } else if (chain[i].at == chain[after].at) {
        chain.erase(chain.begin() + static_cast<std::ptrdiff_t>(next));
      } else {
        ++i;
        continue;
      }
      i = i > 1 ? i - 2 : 0;
    }
  }

  /// The chain with vertices of the neighbours in its edges.
  Chain refined(const Chain& chain) {
    Chain result;
    for (std::size_t i = 0; i < chain.size(); ++i) {
      result.push_back(chain[i]);
      refine(result, chain[i].at, chain[(i + 1) % chain.size()].at, chain[i].number);
    }
    return result;
  }

  void refine(Chain& result, Vec2 a, Vec2 b, std::uint32_t number) {
    if (a == b) return;
    std::vector<Vec2> points;
    for (const Side& side : near_.near(a, b, rule_.tolerance))
      for (const Vec2 p : side)
        if (std::abs(leftOf(p, a, b)) <= rule_.tolerance && isWithin(p, a, b)) points.push_back(p);
    std::sort(points.begin(), points.end(), [&](Vec2 p, Vec2 q) {
      return std::pair(shareOf(p, a, b), std::abs(leftOf(p, a, b))) <
             std::pair(shareOf(q, a, b), std::abs(leftOf(q, a, b)));
    });
    points.erase(std::unique(points.begin(), points.end()), points.end());
    insert(result, points, a, b, number);
  }

  static bool isWithin(Vec2 p, Vec2 a, Vec2 b) {
    const double share = shareOf(p, a, b);
    return share > 0 && share < 1;
  }

  /// Inserts points between a and b, the one farthest from the line first; points are in their
  /// order along it.
  void insert(Chain& result, std::span<const Vec2> points, Vec2 a, Vec2 b, std::uint32_t number) {
    const double spacing = std::max(rule_.spacing, rounding_);
    std::size_t chosen = points.size();
    double most = rule_.matchesNodes ? -1 : rounding_;
    const auto middle = [&](std::size_t i) {
      return std::abs(static_cast<double>(2 * i + 1) - static_cast<double>(points.size()));
    };
    for (std::size_t i = 0; i < points.size(); ++i) {
      const Vec2 p = points[i];
      if (norm(p - a) < spacing || norm(p - b) < spacing || !isWithin(p, a, b)) continue;
      const double off = leftOf(p, a, b), by = rule_.matchesNodes ? std::abs(off) : off;
      // Among points that are equally far, up to rounding, the middle one: fewer levels.
      if (by <= most - rounding_ ||
          (chosen < points.size() && by < most + rounding_ && middle(i) >= middle(chosen)))
        continue;
      if (by > most || chosen < points.size()) most = std::max(most, by), chosen = i;
    }
    if (chosen == points.size()) return;
    const Vec2 p = points[chosen];
    count_.farthest = std::max(count_.farthest, std::abs(leftOf(p, a, b)));
    insert(result, points.first(chosen), a, p, number);
    result.push_back({p, number, true});
    insert(result, points.subspan(chosen + 1), p, b, number);
  }

  /// Moves ends of edges inwards until no vertex of a neighbour near the edge is inside. False if
  /// there was none.
  bool retreat(Chain& chain) {
    bool any = false;
    for (std::size_t i = 0; i < chain.size(); ++i) {
      const std::size_t next = (i + 1) % chain.size();
      for (const Side& side : near_.near(chain[i].at, chain[next].at, rule_.tolerance))
        for (const Vec2 p : side) {
          Vec2 &a = chain[i].at, &b = chain[next].at;
          const double in = leftOf(p, a, b), share = shareOf(p, a, b);
          if (in <= rounding_ || in > rule_.tolerance || !(share > 0 && share < 1)) continue;
          const std::size_t beyond =
              share < .5 ? (i + chain.size() - 1) % chain.size() : (next + 1) % chain.size();
          Vec2& end = share < .5 ? a : b;
          const Vec2 other = chain[beyond].at - end;
          const bool isAcute = dot((share < .5 ? b : a) - end, other) > 0;
          end += inwards(b - a, other, isAcute, (in + rounding_) / std::max(share, 1 - share));
          any = true;
        }
    }
    return any;
  }

  /// A displacement by `by` (m) to the left of an edge. In an acute corner it runs along the other
  /// edge there, which would otherwise be moved outwards.
  static Vec2 inwards(Vec2 edge, Vec2 other, bool isAcute, double by) {
    const Vec2 left = (-1 / norm(edge)) * rightOf(edge);
    const Vec2 along = (1 / norm(other)) * other;
    const double sine = dot(left, along);
    return isAcute && sine > 0 ? (by / sine) * along : by * left;
  }

  Neighbours near_;
  SnapRule rule_;
  double rounding_ = 0;  // m
  SnapCount count_;
};

void checkTolerance(double tolerance) {
  if (tolerance > 0 && std::isfinite(tolerance)) return;
  throw InputError(fmt::format("snap is {:.4g} m, it must be positive and finite.", tolerance));
}

Snapped snapLoops(const Polygon& polygon, const SnapSides& neighbours, const SnapRule& rule,
                  bool moves) {
  Snapper snapper(neighbours, rule);
  Snapped result;
  const auto add = [&](const std::vector<Vec2>& loop, const std::string& name) {
    result.loops.push_back(snapper.snap(loop, moves));
    if (result.loops.back().points.size() < 3)
      throw InputError(
          fmt::format("snap is {:.4g} m, but {} from ({:.9g}, {:.9g}) on would collapse; it must "
                      "be less than half its width.",
                      rule.tolerance, name, loop[0].x, loop[0].y));
  };
  add(polygon.outline, "the outline");
  for (std::size_t i = 0; i < polygon.holes.size(); ++i)
    add(polygon.holes[i], fmt::format("hole {}", i));
  result.count = snapper.count();
  return result;
}

Box boxOf(const std::vector<Vec2>& loop, double reach) {
  Vec2 low = loop[0], high = loop[0];
  for (const Vec2 p : loop) {
    low = {std::min(low.x, p.x), std::min(low.y, p.y)};
    high = {std::max(high.x, p.x), std::max(high.y, p.y)};
  }
  return boxAround(low, high, reach);
}

void appendSides(SnapSides& sides, const std::vector<Vec2>& loop) {
  for (std::size_t i = 0; i < loop.size(); ++i)
    sides.push_back({loop[i], loop[(i + 1) % loop.size()]});
}

/// The polygon at its new places.
Polygon placed(const Snapped& snapped) {
  Polygon polygon{snapped.loops[0].points, {}};
  for (std::size_t i = 1; i < snapped.loops.size(); ++i)
    polygon.holes.push_back(snapped.loops[i].points);
  return polygon;
}

/// Numbers of `after`, which was made of `before`, in those of the loop that `before` was made of.
SnappedLoop following(const SnappedLoop& before, SnappedLoop after) {
  for (std::size_t i = 0; i < after.vertex.size(); ++i) {
    const std::uint32_t was = after.vertex[i];
    after.vertex[i] = before.vertex[was];
    after.isInserted[i] |= before.isInserted[was];
  }
  return after;
}

}  // namespace

SnapCount& SnapCount::operator+=(const SnapCount& other) {
  moved += other.moved;
  inserted += other.inserted;
  farthest = std::max(farthest, other.farthest);
  return *this;
}

Snapped snapOnto(const Polygon& polygon, const SnapSides& neighbours, const SnapRule& rule) {
  checkTolerance(rule.tolerance);
  return snapLoops(checkPolygon(polygon), neighbours, rule, true);
}

std::vector<Snapped> snapTogether(std::vector<Polygon> polygons, double tolerance) {
  checkTolerance(tolerance);
  const SnapRule rule{tolerance, 0, true};
  std::vector<Box> boxes;
  for (Polygon& polygon : polygons) {
    polygon = checkPolygon(std::move(polygon));
    boxes.push_back(boxOf(polygon.outline, tolerance));
  }
  const std::unique_ptr<ContactSearch> search = makeSearch(SearchMethod::kLebesgue);
  search->update(boxes);
  const auto sidesNear = [&](std::size_t i, bool onlyEarlier) {
    std::vector<BoxId> found;
    search->findOverlaps(boxes[i], found);
    std::sort(found.begin(), found.end());
    SnapSides sides;
    for (const BoxId other : found) {
      if (other.value == i || (onlyEarlier && other.value > i)) continue;
      appendSides(sides, polygons[other.value].outline);
      for (const auto& hole : polygons[other.value].holes) appendSides(sides, hole);
    }
    return sides;
  };
  std::vector<Snapped> result;
  for (std::size_t i = 0; i < polygons.size(); ++i) {
    result.push_back(snapLoops(polygons[i], sidesNear(i, true), rule, true));
    polygons[i] = placed(result.back());
  }
  // Vertices of later polygons on the edges of earlier ones.
  for (std::size_t i = 0; i < polygons.size(); ++i) {
    Snapped again = snapLoops(polygons[i], sidesNear(i, false), rule, false);
    for (std::size_t k = 0; k < again.loops.size(); ++k)
      result[i].loops[k] = following(result[i].loops[k], std::move(again.loops[k]));
    result[i].count += again.count;
    polygons[i] = placed(result[i]);
  }
  return result;
}

}  // namespace yadefrag
