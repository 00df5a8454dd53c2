#include "contact/crossing.hpp"

#include <algorithm>
#include <cmath>

namespace yadefrag {

namespace {

Crossing at(double time, Vec2 from, Vec2 along) {
  const double square = dot(along, along);
  return {time, square > 0 ? dot(from, along) / square : 0};
}

}  // namespace

std::optional<Crossing> crossing(const PointAndPiece& before, const PointAndPiece& now,
                                 double depth) {
  const Vec2 from0 = before.point - before.piece.begin, from1 = now.point - now.piece.begin;
  const Vec2 along0 = before.piece.end - before.piece.begin,
             along1 = now.piece.end - now.piece.begin;
  const Vec2 from = from1 - from0, along = along1 - along0;
  if (!(cross(from1, along1) < 0)) return std::nullopt;
  const double behind = depth * std::sqrt(std::max(dot(along0, along0), dot(along1, along1)));
  // Gap × length + depth × length = a t² + b t + c.
  const double c = cross(from0, along0) + behind;
  const double b = cross(from0, along) + cross(from, along0);
  const double a = cross(from, along);
  if (a + b + c >= 0) {
    if (c < 0) return std::nullopt;  // It was behind from the start.
    return at(1, from1, along1);
  }
  // The only root at which the gap decreases.
  const double square = b * b - 4 * a * c;
  if (square < 0) return std::nullopt;
  const double root = std::sqrt(square);
  const double time = b < 0 ? 2 * c / (root - b) : (a != 0 ? (-b - root) / (2 * a) : -1.);
  if (!(time >= 0 && time <= 1)) return std::nullopt;
  return at(time, from0 + time * from, along0 + time * along);
}

}  // namespace yadefrag
