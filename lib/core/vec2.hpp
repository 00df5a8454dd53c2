#pragma once
// Points and vectors in the plane.

#include <cmath>

namespace yadefrag {

struct Vec2 {
  double x = 0;
  double y = 0;

  Vec2& operator+=(Vec2 o) { return x += o.x, y += o.y, *this; }
  Vec2& operator-=(Vec2 o) { return x -= o.x, y -= o.y, *this; }
  Vec2& operator*=(double s) { return x *= s, y *= s, *this; }
  friend Vec2 operator+(Vec2 a, Vec2 b) { return {a.x + b.x, a.y + b.y}; }
  friend Vec2 operator-(Vec2 a, Vec2 b) { return {a.x - b.x, a.y - b.y}; }
  friend Vec2 operator-(Vec2 a) { return {-a.x, -a.y}; }
  friend Vec2 operator*(double s, Vec2 a) { return {s * a.x, s * a.y}; }
  friend Vec2 operator*(Vec2 a, double s) { return s * a; }
  friend bool operator==(Vec2 a, Vec2 b) = default;
};

inline double dot(Vec2 a, Vec2 b) { return a.x * b.x + a.y * b.y; }
/// z of the cross product: positive if b points to the left of a.
inline double cross(Vec2 a, Vec2 b) { return a.x * b.y - a.y * b.x; }
inline double norm(Vec2 a) { return std::sqrt(dot(a, a)); }
/// a rotated clockwise by a right angle: the outward normal of a boundary that runs along a.
inline Vec2 rightOf(Vec2 a) { return {a.y, -a.x}; }
inline bool isFinite(Vec2 a) { return std::isfinite(a.x) && std::isfinite(a.y); }

}  // namespace yadefrag
