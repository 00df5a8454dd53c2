#include "bodies/rigid_outlines.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/tolerances/collider.hpp"
#include "meshing/polygon.hpp"
#include "yade/helpers.hpp"

namespace yadefrag {
namespace {

using yade::Vector3r;

Vector3r placed(const yade::Body& body, const Vector3r& local) {
  const auto& place = body.state->se3;
  return place.position + place.orientation * local;
}

double largest(const std::vector<Vector3r>& corners) {
  double most = 0;
  for (const Vector3r& a : corners) most = std::max(most, (a - corners.front()).norm());
  return most;
}

/// Intersections of a straight edge with the plane: an end in the plane, up to rounding, counts.
void cut(const Vector3r& a, const Vector3r& b, double rounding, std::vector<Vec2>& points) {
  const bool aIn = std::abs(a[2]) <= rounding, bIn = std::abs(b[2]) <= rounding;
  if (aIn) points.push_back(inPlane(a));
  if (bIn) points.push_back(inPlane(b));
  if (aIn || bIn || (a[2] > 0) == (b[2] > 0)) return;
  points.push_back(inPlane(a + a[2] / (a[2] - b[2]) * (b - a)));
}

std::vector<Vector3r> cornersOf(const yade::Body& body, const yade::Facet& facet) {
  std::vector<Vector3r> corners;
  for (const Vector3r& vertex : facet.vertices) corners.push_back(placed(body, vertex));
  return corners;
}

std::vector<Vector3r> cornersOf(const yade::Body& body, const yade::Box& box) {
  std::vector<Vector3r> corners;
  for (int i = 0; i < 8; ++i) {
    const Vector3r sign((i & 1) != 0 ? 1 : -1, (i & 2) != 0 ? 1 : -1, (i & 4) != 0 ? 1 : -1);
    corners.push_back(placed(body, sign.cwiseProduct(box.extents)));
  }
  return corners;
}

std::optional<Section> cutBox(const yade::Body& body, const yade::Box& box) {
  const std::vector<Vector3r> corners = cornersOf(body, box);
  const double rounding = tolerance::kInPlane * largest(corners);
  std::vector<Vec2> points;
  for (int a = 0; a < 8; ++a)
    for (const int bit : {1, 2, 4})
      if ((a & bit) == 0)
        cut(corners[static_cast<std::size_t>(a)], corners[static_cast<std::size_t>(a | bit)],
            rounding, points);
  if (points.size() < 3) return std::nullopt;
  Section section{Section::Kind::kOutline, hullOf(std::move(points), rounding)};
  if (section.points.size() < 3) return std::nullopt;
  return section;
}

std::optional<Section> cutFacet(const yade::Body& body, const yade::Facet& facet) {
  const std::vector<Vector3r> corners = cornersOf(body, facet);
  const double rounding = tolerance::kInPlane * largest(corners);
  std::vector<Vec2> points;
  for (std::size_t i = 0; i < 3; ++i) cut(corners[i], corners[(i + 1) % 3], rounding, points);
  if (points.empty() || isFlat(body)) return std::nullopt;
  // The two points farthest from each other; the others coincide with these up to rounding.
  Section section{Section::Kind::kLine, {points.front(), points.front()}};
  for (const Vec2 point : points)
    if (norm(point - section.points[0]) > norm(section.points[1] - section.points[0]))
      section.points[1] = point;
  if (norm(section.points[1] - section.points[0]) <= rounding) return std::nullopt;
  return section;
}

std::optional<Section> cutWall(const yade::Body& body, const yade::Wall& wall) {
  if (wall.axis != 0 && wall.axis != 1) return std::nullopt;
  const Vec2 at = inPlane(body.state->se3.position);
  // The positive side is on the right.
  const Vec2 along = wall.axis == 0 ? Vec2{0, 1} : Vec2{-1, 0};
  return Section{Section::Kind::kWall, {at, at + along}, wall.sense};
}

}  // namespace

bool mayHaveSection(const yade::Body& body) {
  const yade::Shape* shape = body.shape.get();
  return dynamic_cast<const yade::Box*>(shape) || dynamic_cast<const yade::Facet*>(shape) ||
         dynamic_cast<const yade::Wall*>(shape);
}

std::optional<Section> sectionOf(const yade::Body& body) {
  const yade::Shape* shape = body.shape.get();
  if (!body.state->se3.position.allFinite()) return std::nullopt;
  if (const auto* box = dynamic_cast<const yade::Box*>(shape)) return cutBox(body, *box);
  if (const auto* facet = dynamic_cast<const yade::Facet*>(shape)) return cutFacet(body, *facet);
  if (const auto* wall = dynamic_cast<const yade::Wall*>(shape)) return cutWall(body, *wall);
  return std::nullopt;
}

bool isFlat(const yade::Body& body) {
  const auto* facet = dynamic_cast<const yade::Facet*>(body.shape.get());
  if (!facet) return false;
  const std::vector<Vector3r> corners = cornersOf(body, *facet);
  const double rounding = tolerance::kInPlane * largest(corners);
  return std::ranges::all_of(corners,
                             [&](const Vector3r& at) { return std::abs(at[2]) <= rounding; });
}

bool isAroundAxis(const Section& section) {
  const std::vector<Vec2>& points = section.points;
  if (section.kind == Section::Kind::kWall) return points[0].y == points[1].y;
  double size = 0, sum = 0;
  for (const Vec2 at : points) size = std::max(size, std::abs(at.x)), sum += at.x;
  const double rounding = tolerance::kInPlane * size;
  bool isUpright = section.kind == Section::Kind::kOutline && points.size() == 4;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Vec2 along = points[(i + 1) % points.size()] - points[i];
    isUpright = isUpright && std::min(std::abs(along.x), std::abs(along.y)) <= rounding;
  }
  return isUpright && std::abs(sum) <= rounding;
}

std::vector<double> formOf(const yade::Shape& shape) {
  std::vector<double> form;
  const auto add = [&](const Vector3r& v) {
    for (int i = 0; i < 3; ++i) form.push_back(v[i]);
  };
  if (const auto* box = dynamic_cast<const yade::Box*>(&shape)) add(box->extents);
  if (const auto* facet = dynamic_cast<const yade::Facet*>(&shape))
    for (const Vector3r& vertex : facet->vertices) add(vertex);
  if (const auto* wall = dynamic_cast<const yade::Wall*>(&shape))
    add(Vector3r(wall->axis, wall->sense, 0));
  return form;
}

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
