#include "rigid/rigid_section.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/tolerances/collider.hpp"
#include "entries/plane.hpp"
#include "outline/convex_hull.hpp"

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

}  // namespace yadefrag
