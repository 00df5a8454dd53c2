#include "surface/piece_geometry.hpp"

#include <algorithm>

#include "core/tolerances.hpp"

namespace yadefrag {
namespace {

// Gauss–Legendre with five points on [0, 1].
constexpr double kGaussPoint[5] = {.046910077030668, .230765344947158, .5, .769234655052842,
                                   .953089922969332};
constexpr double kGaussWeight[5] = {.118463442528095, .239314335249683, .284444444444444,
                                    .239314335249683, .118463442528095};

Vec2 unitOrZero(Vec2 a) {
  const double length = norm(a);
  return length > 0 ? (1 / length) * a : Vec2{};
}

}  // namespace

Vec2 PieceGeometry::point(EntryId entry, double xi) const {
  return combine(surfaces_.master(entry, xi), positions_);
}

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
  const PieceRange range = pieceRange(surfaces_.piece[entry.value]);
  if (!n.arc) return (range.end - range.begin) * norm(n.b - n.a);
  double sum = 0;
  for (int i = 0; i < 5; ++i)
    sum += kGaussWeight[i] * norm(combine(arcShapeDerivative(kGaussPoint[i]), n.a, n.b, n.c));
  return sum;
}

Vec2 PieceGeometry::tangent(EntryId entry, double xi) const {
  const Corners n = corners(entry);
  return n.arc ? combine(arcShapeDerivative(xi), n.a, n.b, n.c) : n.b - n.a;
}

Vec2 PieceGeometry::normal(EntryId entry, double xi) const {
  return unitOrZero(rightOf(tangent(entry, xi)));
}

Vec2 PieceGeometry::slaveNormal(EntryId entry) const {
  const EntryId before = surfaces_.prev[entry.value];
  const Vec2 arriving = unitOrZero(tangent(before, pieceRange(surfaces_.piece[before.value]).end));
  const Vec2 leaving = unitOrZero(tangent(entry, pieceRange(surfaces_.piece[entry.value]).begin));
  const Vec2 sum = rightOf(arriving + leaving);
  if (dot(sum, sum) < tolerance::kFold) return arriving;
  return unitOrZero(sum);
}

Foot PieceGeometry::foot(EntryId entry, Vec2 point) const {
  const Corners n = corners(entry);
  if (n.arc) return nearestOnArc(n.a, n.b, n.c, point);
  const Vec2 along = n.b - n.a;
  const double square = dot(along, along);
  const PieceRange range = pieceRange(surfaces_.piece[entry.value]);
  Foot foot;
  foot.xi = square > 0 ? dot(point - n.a, along) / square : range.begin;
  foot.normal = unitOrZero(rightOf(along));
  foot.gap = dot(point - n.a, foot.normal);
  foot.inside = foot.xi >= range.begin && foot.xi <= range.end;
  return foot;
}

bool PieceGeometry::mayPenetrate(EntryId entry, Vec2 point) const {
  const Corners n = corners(entry);
  if (n.arc) return mayPenetrateArc(n.a, n.b, n.c, point);
  const Vec2 along = n.b - n.a;
  return cross(along, point - n.a) >= -tolerance::kQuickLine * dot(along, along);
}

}  // namespace yadefrag
