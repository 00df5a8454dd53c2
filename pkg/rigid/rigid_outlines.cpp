#include "rigid/rigid_outlines.hpp"

#include <algorithm>
#include <limits>

#include "core/tolerances/collider.hpp"

namespace yadefrag {
namespace {

using Number = std::uint32_t;
constexpr Number kNone = std::numeric_limits<Number>::max();

/// An end of a line: 2 × part, + 1 for its second point.
struct Ends {
  const std::vector<RigidPart>& parts;

  [[nodiscard]] Vec2 at(Number end) const { return parts[end / 2].section.points[end % 2]; }
  [[nodiscard]] Vec2 after(Number end) const { return parts[end / 2].after[end % 2]; }
  /// True if the ends coincide at present and after the step.
  [[nodiscard]] bool meet(Number a, Number b) const {
    const double shorter = std::min(norm(at(a) - at(a ^ 1)), norm(at(b) - at(b ^ 1)));
    const double apart = std::max(norm(at(a) - at(b)), norm(after(a) - after(b)));
    return apart <= tolerance::kMeet * shorter;
  }
};

/// By end: the only other end at the same position, of a line with the same friction that is moved
/// by the same body or is independent of forces, too; or none.
std::vector<Number> partnersOf(const std::vector<RigidPart>& parts) {
  const Ends ends{parts};
  std::vector<Number> sorted, partner(2 * parts.size(), kNone);
  double longest = 0;
  for (Number p = 0; p < parts.size(); ++p) {
    if (parts[p].section.kind != Section::Kind::kLine) continue;
    sorted.insert(sorted.end(), {2 * p, 2 * p + 1});
    longest = std::max(longest, norm(ends.at(2 * p) - ends.at(2 * p + 1)));
  }
  std::ranges::sort(sorted, {}, [&](Number end) { return ends.at(end).x; });
  std::vector<int> count(partner.size());
  for (std::size_t i = 0; i < sorted.size(); ++i)
    for (std::size_t k = i + 1; k < sorted.size(); ++k) {
      const Number a = sorted[i], b = sorted[k];
      if (ends.at(b).x - ends.at(a).x > tolerance::kMeet * longest) break;
      if (a / 2 == b / 2 || !ends.meet(a, b)) continue;
      partner[a] = b, partner[b] = a;
      ++count[a], ++count[b];
    }
  for (Number end = 0; end < partner.size(); ++end) {
    if (partner[end] == kNone) continue;
    const RigidPart &one = parts[end / 2], &other = parts[partner[end] / 2];
    const bool same = one.friction == other.friction && one.mover == other.mover;
    if (count[end] > 1 || count[partner[end]] > 1 || !same) partner[end] = kNone;
  }
  // Keep only mutual partners.
  for (Number end = 0; end < partner.size(); ++end)
    if (partner[end] != kNone && partner[partner[end]] != end) partner[end] = kNone;
  return partner;
}

/// Lines in sequence, each given by the end at which it begins.
struct Chain {
  std::vector<Number> first;
  bool isClosed = false;
};

Chain chainFrom(Number part, const std::vector<Number>& partner) {
  // Backwards to the begin of the chain, or once around.
  Number first = 2 * part;
  while (partner[first] != kNone) {
    first = partner[first] ^ 1;
    if (first == 2 * part) break;
  }
  Chain chain;
  chain.isClosed = partner[first] != kNone;
  for (Number end = first;;) {
    chain.first.push_back(end);
    end = partner[end ^ 1];
    if (end == kNone || end == first) break;
  }
  return chain;
}

void addLoop(RigidOutline& outline, const std::vector<Vec2>& points,
             const std::vector<Number>& parts) {
  TriangleMesh& shape = outline.spec.shape;
  std::vector<std::uint32_t> loop;
  for (const Vec2 point : points) {
    loop.push_back(static_cast<std::uint32_t>(shape.nodes.size()));
    shape.nodes.push_back(point);
  }
  shape.loops.push_back(std::move(loop));
  outline.part.insert(outline.part.end(), parts.begin(), parts.end());
}

/// Outline along both sides of a chain, since both sides of a line have contact. The end of the
/// chain is one node, every other point two.
RigidOutline outlineOf(const Chain& chain, const std::vector<RigidPart>& parts) {
  const Ends ends{parts};
  RigidOutline outline;
  std::vector<Vec2> there, back;
  std::vector<Number> thereOf, backOf;
  for (const Number end : chain.first) there.push_back(ends.at(end)), thereOf.push_back(end / 2);
  for (auto end = chain.first.rbegin(); end != chain.first.rend(); ++end)
    back.push_back(ends.at(*end ^ 1)), backOf.push_back(*end / 2);
  if (chain.isClosed) {
    addLoop(outline, there, thereOf);
    addLoop(outline, back, backOf);
    return outline;
  }
  there.insert(there.end(), back.begin(), back.end());
  thereOf.insert(thereOf.end(), backOf.begin(), backOf.end());
  addLoop(outline, there, thereOf);
  return outline;
}

RigidOutline solidOf(const Section& section, Number part) {
  RigidOutline outline;
  const auto count = static_cast<std::uint32_t>(section.points.size());
  addLoop(outline, section.points, std::vector<Number>(count, part));
  for (std::uint32_t k = 1; k + 1 < count; ++k)
    outline.spec.shape.triangles.push_back({0, k, k + 1});
  return outline;
}

RigidOutline wallOf(const Section& wall, Number part, Vec2 middle, double reach) {
  RigidOutline outline;
  const Vec2 along = wall.points[1] - wall.points[0];
  const Vec2 foot = wall.points[0] + dot(middle - wall.points[0], along) * along;
  const double sign = wall.sense < 0 ? -1 : 1;
  std::vector<Vec2> points{foot - sign * reach * along, foot + sign * reach * along};
  // A one-sided wall: its back is the inside of a body, where there is no contact.
  if (wall.sense != 0) points.push_back(foot - sign * reach * rightOf(along));
  addLoop(outline, points, std::vector<Number>(points.size(), part));
  return outline;
}

}  // namespace

std::vector<RigidOutline> outlinesOf(const std::vector<RigidPart>& parts, Vec2 middle,
                                     double reach) {
  const std::vector<Number> partner = partnersOf(parts);
  std::vector<RigidOutline> outlines;
  std::vector<bool> done(parts.size());
  for (Number p = 0; p < parts.size(); ++p) {
    if (done[p]) continue;
    const Section& section = parts[p].section;
    if (section.kind == Section::Kind::kOutline) outlines.push_back(solidOf(section, p));
    if (section.kind == Section::Kind::kWall) outlines.push_back(wallOf(section, p, middle, reach));
    if (section.kind == Section::Kind::kLine) {
      const Chain chain = chainFrom(p, partner);
      for (const Number end : chain.first) done[end / 2] = true;
      outlines.push_back(outlineOf(chain, parts));
    }
    outlines.back().spec.friction = parts[p].friction;
    outlines.back().spec.name = parts[p].name;
  }
  return outlines;
}

}  // namespace yadefrag
