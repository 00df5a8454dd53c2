#include "surface/piece_geometry.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/tolerances/mesh.hpp"

namespace yadefrag {

namespace {

/// Coordinates relative to node b: differences keep their digits where coordinates are large.
struct LocalArc {
  Vec2 toB, fromB;  ///< b − a, c − b
  Vec2 point;       ///< the point − b

  [[nodiscard]] Vec2 at(double xi) const {
    const ArcWeights h = arcShape(xi);
    return h[2] * fromB - h[0] * toB;
  }
  [[nodiscard]] Vec2 tangent(double xi) const {
    return .75 * ((1 - xi * xi) * toB + (2 * xi - xi * xi) * fromB);
  }
  [[nodiscard]] Vec2 bend(double xi) const { return 1.5 * ((1 - xi) * fromB - xi * toB); }
};

/// Bernstein coefficients of (x(ξ) − point)·x′(ξ)·⁴⁄₃ on a part of the arc: half the derivative of
/// the squared distance.
using Slope = std::array<double, 6>;

Slope slopeOfDistance(const LocalArc& arc) {
  const Vec2 x[4] = {-.5 * arc.toB - arc.point, -.25 * arc.toB - arc.point,
                     .25 * arc.fromB - arc.point, .5 * arc.fromB - arc.point};
  const Vec2 t[3] = {arc.toB, arc.toB + arc.fromB, arc.fromB};
  return {dot(x[0], t[0]),
          (2 * dot(x[0], t[1]) + 3 * dot(x[1], t[0])) / 5,
          (dot(x[0], t[2]) + 6 * dot(x[1], t[1]) + 3 * dot(x[2], t[0])) / 10,
          (3 * dot(x[1], t[2]) + 6 * dot(x[2], t[1]) + dot(x[3], t[0])) / 10,
          (3 * dot(x[2], t[2]) + 2 * dot(x[3], t[1])) / 5,
          dot(x[3], t[2])};
}

/// Zero counts as positive, so that a root at the cut between two parts belongs to the left one.
int signChanges(const Slope& f) {
  int changes = 0;
  for (std::size_t i = 1; i < f.size(); ++i) changes += (f[i - 1] < 0) != (f[i] < 0);
  return changes;
}

/// De Casteljau's algorithm: replaces the slope by its left half and returns the right half.
Slope cutInHalf(Slope& f) {
  Slope right;
  for (std::size_t level = f.size() - 1;; --level) {
    right[level] = f.back();
    if (level == 0) return right;
    for (std::size_t i = f.size() - 1; i >= f.size() - level; --i) f[i] = .5 * (f[i - 1] + f[i]);
  }
}

struct Nearest {
  double xi;
  double squaredDistance = std::numeric_limits<double>::infinity();

  void offer(const LocalArc& arc, double candidate) {
    const Vec2 away = arc.at(candidate) - arc.point;
    if (dot(away, away) < squaredDistance) xi = candidate, squaredDistance = dot(away, away);
  }
};

/// The slope is negative at `low`, not negative at `high`, and has one root between.
double refineFoot(const LocalArc& arc, double low, double high) {
  double xi = .5 * (low + high);
  double lastStep = high - low;
  for (int i = 0; i < tolerance::kMostFootSteps; ++i) {
    const Vec2 away = arc.at(xi) - arc.point;
    const Vec2 tangent = arc.tangent(xi);
    const double slope = dot(away, tangent);
    (slope < 0 ? low : high) = xi;
    const double curvature = dot(tangent, tangent) + dot(away, arc.bend(xi));
    double other = xi - slope / curvature;
    // A Newton step must stay in the bracket and be at most half as long as the previous one.
    if (!(other >= low && other <= high && 2 * std::abs(other - xi) <= lastStep))
      other = .5 * (low + high);
    lastStep = std::abs(other - xi);
    xi = other;
    if (lastStep <= tolerance::kFootStep) break;
  }
  return xi;
}

/// Reports every local minimum of the distance inside [low, high].
void offerFeet(const LocalArc& arc, Slope slope, double low, double high, int depth,
               Nearest& nearest) {
  const int changes = signChanges(slope);
  if (changes == 0) return;
  if (changes == 1) {
    if (slope.front() < 0) nearest.offer(arc, refineFoot(arc, low, high));
    return;
  }
  const double middle = .5 * (low + high);
  if (depth == 0) return nearest.offer(arc, middle);
  const Slope right = cutInHalf(slope);
  offerFeet(arc, slope, low, middle, depth - 1, nearest);
  offerFeet(arc, right, middle, high, depth - 1, nearest);
}

Vec2 unit(Vec2 a) {
  const double length = norm(a);
  return length > 0 ? (1 / length) * a : Vec2{};
}

/// The tangent; where it vanishes (coincident nodes, a fold by 180°), the chord.
Vec2 safeTangent(const LocalArc& arc, double xi) {
  const Vec2 tangent = arc.tangent(xi);
  if (dot(tangent, tangent) > 0) return tangent;
  return .5 * (arc.toB + arc.fromB);
}

}  // namespace

Foot nearestOnArc(Vec2 a, Vec2 b, Vec2 c, Vec2 point) {
  const LocalArc arc{b - a, c - b, point - b};
  const Slope slope = slopeOfDistance(arc);
  Nearest nearest{0};
  const bool beforeStart = slope.front() >= 0;
  const bool pastEnd = slope.back() < 0;
  offerFeet(arc, slope, 0, 1, tolerance::kMostArcCuts, nearest);
  const double innerDistance = nearest.squaredDistance;
  if (beforeStart) nearest.offer(arc, 0);
  if (pastEnd) nearest.offer(arc, 1);

  const Vec2 tangent = safeTangent(arc, nearest.xi);
  Foot foot;
  foot.xi = nearest.xi;
  foot.normal = unit(rightOf(tangent));
  const Vec2 away = arc.point - arc.at(nearest.xi);
  foot.gap = dot(away, foot.normal);
  if (nearest.squaredDistance < innerDistance && dot(tangent, tangent) > 0)
    foot.xi += dot(away, tangent) / dot(tangent, tangent);
  foot.inside = foot.xi >= 0 && foot.xi <= 1;
  return foot;
}

namespace {

// Gauss–Legendre with five points on [0, 1].
constexpr double kGaussPoint[5] = {.046910077030668, .230765344947158, .5, .769234655052842,
                                   .953089922969332};
constexpr double kGaussWeight[5] = {.118463442528095, .239314335249683, .284444444444444,
                                    .239314335249683, .118463442528095};

Foot footOnSegment(Vec2 a, Vec2 b, Vec2 point, PieceRange within) {
  const Vec2 along = b - a;
  const double square = dot(along, along);
  const double length = norm(along);
  Foot foot;
  foot.xi = square > 0 ? dot(point - a, along) / square : within.begin;
  foot.normal = length > 0 ? (1 / length) * rightOf(along) : Vec2{};
  foot.gap = dot(point - a, foot.normal);
  foot.inside = foot.xi >= within.begin && foot.xi <= within.end;
  return foot;
}

}  // namespace

Box PieceGeometry::box(EntryId entry) const {
  const PieceEnds e = ends(entry);
  Box box{{std::min(e.begin.x, e.end.x), std::min(e.begin.y, e.end.y), 0},
          {std::max(e.begin.x, e.end.x), std::max(e.begin.y, e.end.y), 0}};
  const Corners n = corners(entry);
  if (!n.arc) return box;
  for (const Vec2 q : {.25 * n.a + .75 * n.b, .75 * n.b + .25 * n.c}) {
    box.min = {std::min(box.min[0], q.x), std::min(box.min[1], q.y), 0};
    box.max = {std::max(box.max[0], q.x), std::max(box.max[1], q.y), 0};
  }
  return box;
}

double PieceGeometry::length(EntryId entry) const {
  const Corners n = corners(entry);
  const PieceRange within = range(entry);
  if (!n.arc) return (within.end - within.begin) * norm(n.b - n.a);
  double sum = 0;
  for (int i = 0; i < 5; ++i)
    sum += kGaussWeight[i] * norm(combine(arcShapeDerivative(kGaussPoint[i]), n.a, n.b, n.c));
  return sum;
}

Vec2 PieceGeometry::tangent(EntryId entry, double xi) const {
  const Corners n = corners(entry);
  return n.arc ? combine(arcShapeDerivative(xi), n.a, n.b, n.c) : n.b - n.a;
}

Foot PieceGeometry::foot(EntryId entry, Vec2 point) const {
  const Corners n = corners(entry);
  return n.arc ? nearestOnArc(n.a, n.b, n.c, point) : footOnSegment(n.a, n.b, point, range(entry));
}

}  // namespace yadefrag
