#include "meshing/mesh_stages.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "core/errors.hpp"
#include "core/tolerances/mesh.hpp"
#include "meshing/joint_lines.hpp"
#include "meshing/polygon.hpp"

namespace yadefrag {
namespace {

double twiceArea(const std::vector<Vec2>& loop) {
  double sum = 0;
  for (std::size_t i = 2; i < loop.size(); ++i)
    sum += cross(loop[i - 1] - loop[0], loop[i] - loop[0]);
  return sum;
}

/// Sums over all loops.
struct Extent {
  double twiceArea = 0;
  double parts = 0;     // number of parts of all edges
  double farthest = 0;  // largest coordinate
};

void extend(Extent& extent, const std::vector<Vec2>& loop, double size) {
  extent.twiceArea += twiceArea(loop);
  for (std::size_t i = 0; i < loop.size(); ++i) {
    const Vec2 p = loop[i];
    extent.parts += std::max(1., norm(loop[(i + 1) % loop.size()] - p) / size);
    extent.farthest = std::max({extent.farthest, std::abs(p.x), std::abs(p.y)});
  }
}

Extent extentOf(const Polygon& polygon, double size) {
  Extent extent;
  extend(extent, polygon.outline, size);
  for (const auto& hole : polygon.holes) extend(extent, hole, size);
  return extent;
}

void checkSize(const Polygon& polygon, const SizeField& field, double mostBytes) {
  const double size = field.smallest();
  const Extent extent = extentOf(polygon, size);
  // Equilateral triangles that fill the area, and at least one triangle for each part of the
  // boundary.
  const double filling = extent.twiceArea / (std::sqrt(.75) * size * size);
  const double triangles =
      field.isEven() ? std::max(filling, extent.parts) : std::min(filling, field.trianglesInGrid());
  if (!(triangles < tolerance::kMostTriangles))
    throw InputError(
        fmt::format("Size {:.4g} m would give about {:.4g} triangles; a mesh can have {:.4g}.",
                    size, triangles, tolerance::kMostTriangles));
  const double bytes = triangles * tolerance::kTriangleBytes;
  if (bytes > mostBytes)
    throw InputError(fmt::format(
        "Size {:.4g} m would give about {:.4g} triangles, which take about {:.4g} GB, but there "
        "are "
        "{:.4g} GB of memory; {:.4g} m would fill it.",
        size, triangles, bytes / 1e9, mostBytes / 1e9, size * std::sqrt(bytes / mostBytes)));
  if (size < tolerance::kLeastSize * extent.farthest)
    throw InputError(fmt::format(
        "Size {:.4g} m is lost in the rounding of coordinates of {:.4g} m; move the polygon to the "
        "origin or use a size of at least {:.4g} m.",
        size, extent.farthest, tolerance::kLeastSize * extent.farthest));
}

/// Its bits do not depend on which end is `a`.
Vec2 pointOnEdge(Vec2 a, Vec2 b, std::uint32_t part, std::uint32_t parts) {
  const double n = parts;
  if (2 * part == parts) return (a + b) * .5;
  return 2 * part < parts ? a + (b - a) * (part / n) : b + (a - b) * ((parts - part) / n);
}

/// Halves are rounded up, also those that rounding makes a little less: the number must not depend
/// on the unit of length.
double partsOf(double sizes) { return std::max(1., std::floor(sizes + .5 + tolerance::kHalf)); }

/// The points that divide an edge into equal parts.
std::vector<Vec2> evenPoints(Vec2 a, Vec2 b, double size) {
  const auto parts = static_cast<std::uint32_t>(partsOf(norm(b - a) / size));
  std::vector<Vec2> points;
  for (std::uint32_t k = 1; k < parts; ++k) points.push_back(pointOnEdge(a, b, k, parts));
  return points;
}

/// The points that divide the integral of 1/size along the edge into equal parts, each about 1.
std::vector<Vec2> gradedPoints(Vec2 a, Vec2 b, const SizeField& size) {
  const double length = norm(b - a);
  // Ends of short steps along the edge, and the integral up to them.
  std::vector<double> ends{0}, sums{0};
  while (ends.back() < length) {
    const double here = size.at(a + (b - a) * (ends.back() / length));
    const double end = std::min(length, ends.back() + here / tolerance::kStepsPerPart);
    sums.push_back(sums.back() + (end - ends.back()) / size.at(a + (b - a) * (end / length)));
    ends.push_back(end);
  }
  const double parts = partsOf(sums.back());
  std::vector<Vec2> points;
  std::size_t k = 1;
  for (double part = 1; part < parts; ++part) {
    const double sum = sums.back() * part / parts;
    while (sums[k] < sum) ++k;
    const double share = (sum - sums[k - 1]) / (sums[k] - sums[k - 1]);
    points.push_back(a + (b - a) * ((ends[k - 1] + share * (ends[k] - ends[k - 1])) / length));
  }
  return points;
}

/// The points within an edge, from a to b.
std::vector<Vec2> pointsWithin(Vec2 a, Vec2 b, const SizeField& size) {
  return size.isEven() ? evenPoints(a, b, size.smallest()) : gradedPoints(a, b, size);
}

class Divider {
 public:
  Divider(const CutLines& lines, const SizeField& size)
      : lines_(lines), size_(size), nodeOf_(lines.points.size(), kNone) {
    boundary_.first.push_back(0);
  }

  void appendLoop(std::size_t number, const std::vector<Vec2>& loop,
                  const std::vector<Vec2>& given) {
    const auto count = static_cast<std::uint32_t>(loop.size());
    const bool turned = loop[1] != given[1];
    const auto& corners = lines_.loops[number];
    for (std::size_t i = 0; i < corners.size(); ++i) {
      const auto [point, vertex] = corners[i];
      const std::uint32_t next = corners[(i + 1) % corners.size()].point;
      appendPoint(point);
      appendWithin(point, next);
      boundary_.vertex.resize(boundary_.nodes.size(),
                              turned && vertex > 0 ? count - vertex : vertex);
    }
    boundary_.first.push_back(static_cast<std::uint32_t>(boundary_.nodes.size()));
  }

  void appendPiece(const CutLines::Piece& piece) {
    for (const std::uint32_t point : piece.points)
      if (nodeOf_[point] == kNone) appendPoint(point);
    std::uint32_t from = nodeOf_[piece.points[0]];
    auto within = static_cast<std::uint32_t>(boundary_.nodes.size());
    appendWithin(piece.points[0], piece.points[1]);
    for (; within < boundary_.nodes.size(); from = within++)
      boundary_.joints.push_back({from, within, piece.joint});
    boundary_.joints.push_back({from, nodeOf_[piece.points[1]], piece.joint});
  }

  DividedBoundary take() { return std::move(boundary_); }

 private:
  static constexpr std::uint32_t kNone = 0xffffffff;

  void appendPoint(std::uint32_t point) {
    nodeOf_[point] = static_cast<std::uint32_t>(boundary_.nodes.size());
    boundary_.nodes.push_back(lines_.points[point]);
  }

  void appendWithin(std::uint32_t a, std::uint32_t b) {
    for (const Vec2 p : pointsWithin(lines_.points[a], lines_.points[b], size_))
      boundary_.nodes.push_back(p);
  }

  const CutLines& lines_;
  const SizeField& size_;
  std::vector<std::uint32_t> nodeOf_;  // node of each point, or kNone
  DividedBoundary boundary_;
};

}  // namespace

DividedBoundary divideBoundary(const Polygon& given, const SizeField& size, double mostBytes,
                               const JointLines& joints, double jointTolerance) {
  if (!(size.smallest() > 0) || !std::isfinite(size.largest()))
    throw InputError(fmt::format("Size {:.4g} m must be positive and finite.", size.smallest()));
  const Polygon polygon = checkPolygon(given);
  checkSize(polygon, size, mostBytes);
  const CutLines lines = cutAtJoints(polygon, joints, size, jointTolerance);
  Divider divider(lines, size);
  divider.appendLoop(0, polygon.outline, given.outline);
  for (std::size_t i = 0; i < polygon.holes.size(); ++i)
    divider.appendLoop(i + 1, polygon.holes[i], given.holes[i]);
  for (const CutLines::Piece& piece : lines.pieces) divider.appendPiece(piece);
  DividedBoundary boundary = divider.take();
  boundary.given = boundary.nodes;
  boundary.joined = lines.joined;
  return boundary;
}

}  // namespace yadefrag
