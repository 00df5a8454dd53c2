#include "mesh/divided_boundary.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <string>

#include "core/errors.hpp"
#include "core/tolerances.hpp"
#include "mesh/polygon.hpp"

namespace yadefrag {
namespace {

/// (count) Steps of the integral along an edge in each of its parts.
constexpr double kStepsPerPart = 8;

std::string text(double value) {
  std::array<char, 32> buffer;
  (void)std::snprintf(buffer.data(), buffer.size(), "%.4g", value);
  return buffer.data();
}

double twiceArea(const std::vector<Vec2>& loop) {
  double sum = 0;
  for (std::size_t i = 2; i < loop.size(); ++i)
    sum += cross(loop[i - 1] - loop[0], loop[i] - loop[0]);
  return sum;
}

/// Sums over all loops.
struct Extent {
  double twiceArea = 0;
  double parts = 0;     // of all edges
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
  // Equilateral triangles, and at least one for each part of the boundary.
  const double filling = extent.twiceArea / (std::sqrt(.75) * size * size);
  const double triangles =
      field.isEven() ? std::max(filling, extent.parts) : std::min(filling, field.trianglesInGrid());
  if (!(triangles < tolerance::kMostTriangles))
    throw InputError("Size " + text(size) + " m would give about " + text(triangles) +
                     " triangles; a mesh can have " + text(tolerance::kMostTriangles) + ".");
  const double bytes = triangles * tolerance::kTriangleBytes;
  if (bytes > mostBytes)
    throw InputError("Size " + text(size) + " m would give about " + text(triangles) +
                     " triangles, which take about " + text(bytes / 1e9) + " GB, but there are " +
                     text(mostBytes / 1e9) + " GB of memory; " +
                     text(size * std::sqrt(bytes / mostBytes)) + " m would fill it.");
  if (size < tolerance::kLeastSize * extent.farthest)
    throw InputError("Size " + text(size) + " m is lost in the rounding of coordinates of " +
                     text(extent.farthest) +
                     " m; move the polygon to the origin or use a size of " + "at least " +
                     text(tolerance::kLeastSize * extent.farthest) + " m.");
}

/// The same from either end.
Vec2 pointOnEdge(Vec2 a, Vec2 b, std::uint32_t part, std::uint32_t parts) {
  const double n = parts;
  if (2 * part == parts) return (a + b) * .5;
  return 2 * part < parts ? a + (b - a) * (part / n) : b + (a - b) * ((parts - part) / n);
}

/// The points within an edge, from a to b.
std::vector<Vec2> evenPoints(Vec2 a, Vec2 b, double size) {
  const auto parts = static_cast<std::uint32_t>(std::max(1., std::round(norm(b - a) / size)));
  std::vector<Vec2> points;
  for (std::uint32_t k = 1; k < parts; ++k) points.push_back(pointOnEdge(a, b, k, parts));
  return points;
}

/// The points that cut the integral of 1/size along the edge into equal parts, each nearly 1.
std::vector<Vec2> gradedPoints(Vec2 a, Vec2 b, const SizeField& size) {
  const double length = norm(b - a);
  std::vector<double> ends{0}, sums{0};  // of short steps along the edge
  while (ends.back() < length) {
    const double here = size.at(a + (b - a) * (ends.back() / length));
    const double end = std::min(length, ends.back() + here / kStepsPerPart);
    sums.push_back(sums.back() + (end - ends.back()) / size.at(a + (b - a) * (end / length)));
    ends.push_back(end);
  }
  const double parts = std::max(1., std::round(sums.back()));
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

void appendLoop(DividedBoundary& boundary, const std::vector<Vec2>& loop,
                const std::vector<Vec2>& given, const SizeField& size) {
  const auto count = static_cast<std::uint32_t>(loop.size());
  const bool turned = loop[1] != given[1];
  for (std::uint32_t i = 0; i < count; ++i) {
    const Vec2 a = loop[i];
    const Vec2 b = loop[(i + 1) % count];
    boundary.nodes.push_back(a);
    for (const Vec2 p :
         size.isEven() ? evenPoints(a, b, size.smallest()) : gradedPoints(a, b, size))
      boundary.nodes.push_back(p);
    boundary.vertex.resize(boundary.nodes.size(), turned && i > 0 ? count - i : i);
  }
  boundary.first.push_back(static_cast<std::uint32_t>(boundary.nodes.size()));
}

}  // namespace

DividedBoundary divideBoundary(const Polygon& given, const SizeField& size, double mostBytes) {
  if (!(size.smallest() > 0) || !std::isfinite(size.largest()))
    throw InputError("Size " + text(size.smallest()) + " m must be positive and finite.");
  const Polygon polygon = checkPolygon(given);
  checkSize(polygon, size, mostBytes);
  DividedBoundary boundary;
  boundary.first.push_back(0);
  appendLoop(boundary, polygon.outline, given.outline, size);
  for (std::size_t i = 0; i < polygon.holes.size(); ++i)
    appendLoop(boundary, polygon.holes[i], given.holes[i], size);
  return boundary;
}

}  // namespace yadefrag
