#include "surface/piece_geometry.hpp"

#include <algorithm>

namespace yadefrag {
namespace {

// Gauss–Legendre with five points on [0, 1].
constexpr double kGaussPoint[5] = {.046910077030668, .230765344947158, .5, .769234655052842,
                                   .953089922969332};
constexpr double kGaussWeight[5] = {.118463442528095, .239314335249683, .284444444444444,
                                    .239314335249683, .118463442528095};

}  // namespace

template <bool kSmooth>
Vec2 PieceGeometryOf<kSmooth>::point(EntryId entry, double xi) const {
  return combine(surfaces_.master(entry, xi), positions_);
}

template <bool kSmooth>
Box PieceGeometryOf<kSmooth>::box(EntryId entry) const {
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

template <bool kSmooth>
double PieceGeometryOf<kSmooth>::length(EntryId entry) const {
  const Corners n = corners(entry);
  const PieceRange within = range(entry);
  if (!n.arc) return (within.end - within.begin) * norm(n.b - n.a);
  double sum = 0;
  for (int i = 0; i < 5; ++i)
    sum += kGaussWeight[i] * norm(combine(arcShapeDerivative(kGaussPoint[i]), n.a, n.b, n.c));
  return sum;
}

template <bool kSmooth>
Vec2 PieceGeometryOf<kSmooth>::tangentOfOther(EntryId entry, double xi) const {
  const Corners n = corners(entry);
  return n.arc ? combine(arcShapeDerivative(xi), n.a, n.b, n.c) : n.b - n.a;
}

template <bool kSmooth>
Foot PieceGeometryOf<kSmooth>::footOnOther(EntryId entry, Vec2 point) const {
  const Corners n = corners(entry);
  return n.arc ? nearestOnArc(n.a, n.b, n.c, point) : footOnSegment(n.a, n.b, point, range(entry));
}

template class PieceGeometryOf<true>;
template class PieceGeometryOf<false>;

}  // namespace yadefrag
