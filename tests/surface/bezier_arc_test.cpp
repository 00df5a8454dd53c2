#include "surface/bezier_arc.hpp"

#include <gtest/gtest.h>
#include <algorithm>
#include <cmath>

#include <numbers>

#include "core/random.hpp"

namespace yadefrag {
namespace {

using test::even;
using test::Random;

Vec2 direction(double angle) { return {std::cos(angle), std::sin(angle)}; }

struct Triple {
  Vec2 a, b, c;
  double turn;  ///< rad, to the left
  double scale;

  [[nodiscard]] Vec2 at(double xi) const { return combine(arcShape(xi), a, b, c); }
  [[nodiscard]] Vec2 normal(double xi) const {
    const Vec2 t = rightOf(combine(arcShapeDerivative(xi), a, b, c));
    return (1 / norm(t)) * t;
  }
};

/// Segments of lengths up to 1 : unevenness and turns up to mostTurn, anywhere, of any size.
Triple randomTriple(Random& random, double mostTurn, double unevenness) {
  Triple t;
  t.scale = std::pow(10., even(random, -6, 3));
  t.turn = even(random, -mostTurn, mostTurn);
  if (random() % 4 == 0) t.turn *= std::pow(10., even(random, -15, 0));
  const double start = even(random, -4, 4);
  t.b = t.scale * Vec2{even(random, -5, 5), even(random, -5, 5)};
  t.a = t.b - t.scale * direction(start);
  t.c = t.b + std::pow(unevenness, even(random, -1, 1)) * t.scale * direction(start + t.turn);
  return t;
}

TEST(BezierArc, ShapeFunctionsAreThoseOfTheCubicOnHalfAndQuarterpoints) {
  const Vec2 a{.3, 1};
  const Vec2 b{2, -1};
  const Vec2 c{2.5, 4};
  const Vec2 x[4] = {.5 * (a + b), .25 * (a + 3 * b), .25 * (3 * b + c), .5 * (b + c)};
  for (double xi = 0; xi <= 1; xi += .01) {
    const double o = 1 - xi;
    const Vec2 bezier =
        o * o * o * x[0] + 3 * o * o * xi * x[1] + 3 * o * xi * xi * x[2] + xi * xi * xi * x[3];
    const ArcWeights h = arcShape(xi);
    EXPECT_NEAR(norm(combine(h, a, b, c) - bezier), 0, 1e-14);
    EXPECT_NEAR(h[0] + h[1] + h[2], 1, 1e-15);
    const double d = 1e-4;
    const ArcWeights first = arcShapeDerivative(xi);
    for (int i = 0; i < 3; ++i)
      EXPECT_NEAR(first[i], (arcShape(xi + d)[i] - arcShape(xi - d)[i]) / (2 * d), 1e-8);
  }
}

TEST(BezierArc, FootOfAPointOffsetAlongTheNormalIsFoundAgain) {
  Random random(1);
  double worst = 0;
  for (int k = 0; k < 200000; ++k) {
    const Triple t = randomTriple(random, 2.5, 100);
    const double xi = k % 50 == 0 ? double(k / 50 % 2) : even(random, 0, 1);
    // Stay nearer than the least radius of curvature, where the nearest foot is the only one.
    const Vec2 first = combine(arcShapeDerivative(xi), t.a, t.b, t.c);
    const Vec2 second = 1.5 * (xi * t.a - t.b + (1 - xi) * t.c);
    const double radius = std::pow(norm(first), 3) / std::abs(cross(first, second));
    const double offset = even(random, -.1, .1) * std::min(radius, norm(t.c - t.a));
    const Vec2 point = t.at(xi) + offset * t.normal(xi);
    const Foot foot = nearestOnArc(t.a, t.b, t.c, point);
    const double away = norm(t.at(std::clamp(foot.xi, 0., 1.)) - point);
    ASSERT_LE(away, std::abs(offset) * (1 + 1e-12) + 1e-14 * t.scale * 20) << k;
    if (away < std::abs(offset) * .999) continue;  // another foot is nearer: a tight arc
    const double error =
        std::max(std::abs(foot.gap - offset) / t.scale, std::abs(norm(foot.normal) - 1));
    worst = std::max(worst, error);
    ASSERT_LE(error, 1e-13) << k << " turn " << t.turn;
    // ξ is as exact as rounded coordinates (5 scale) allow at the speed dx/dξ.
    ASSERT_NEAR(foot.xi, xi, 1e-14 * t.scale / norm(first) * 50) << k;
  }
  RecordProperty("worst", std::to_string(worst));
}

TEST(BezierArc, FootIsTheNearestOfADenseSampling) {
  Random random(2);
  for (int k = 0; k < 20000; ++k) {
    const Triple t = randomTriple(random, 3.1, 1000);
    const Vec2 point = t.b + t.scale * Vec2{even(random, -1, 1), even(random, -1, 1)};
    const Foot foot = nearestOnArc(t.a, t.b, t.c, point);
    const double xi = std::clamp(foot.xi, 0., 1.);
    double least = 1e300;
    for (int i = 0; i <= 200; ++i) least = std::min(least, norm(t.at(i / 200.) - point));
    ASSERT_LE(norm(t.at(xi) - point), least * (1 + 1e-12) + 1e-13 * t.scale) << k;
    ASSERT_EQ(foot.inside, foot.xi >= 0 && foot.xi <= 1);
    // Orthogonal, on the arc or on its tangent.
    const Vec2 tangent = combine(arcShapeDerivative(xi), t.a, t.b, t.c);
    if (norm(tangent) < 1e-3 * t.scale) continue;
    const Vec2 onLine = t.at(xi) + (foot.xi - xi) * tangent;
    ASSERT_NEAR(dot(point - onLine, tangent) / norm(tangent) / t.scale, 0, 1e-11) << k;
    ASSERT_NEAR(dot(point - onLine, foot.normal) / t.scale, foot.gap / t.scale, 1e-11) << k;
  }
}

TEST(BezierArc, DegenerateNodesGiveNumbers) {
  const Vec2 o{1, 2};
  const Vec2 e{2, 2};
  const Vec2 cases[][3] = {{o, o, o}, {o, o, e}, {o, e, e}, {o, e, o}, {e, e, e}};
  for (const auto& c : cases)
    for (const Vec2 point : {o, e, Vec2{1.5, 2.5}, Vec2{-3, 0}}) {
      const Foot foot = nearestOnArc(c[0], c[1], c[2], point);
      EXPECT_TRUE(std::isfinite(foot.xi) && std::isfinite(foot.gap) && isFinite(foot.normal));
    }
}

TEST(BezierArc, QuickTestNeverRejectsAPenetration) {
  // Any turn and unevenness, any depth up to the length of the longer segment.
  Random random(4);
  int rejectedOutside = 0;
  int outside = 0;
  for (int k = 0; k < 300000; ++k) {
    const Triple t = randomTriple(random, 3.1, 100);
    const double xi = even(random, 0, 1);
    if (norm(combine(arcShapeDerivative(xi), t.a, t.b, t.c)) < 1e-6 * t.scale) continue;
    const double longer = std::max(norm(t.b - t.a), norm(t.c - t.b));
    const double depth = longer * std::pow(10., even(random, -10, 0));
    ASSERT_TRUE(mayPenetrateArc(t.a, t.b, t.c, t.at(xi) - depth * t.normal(xi)))
        << k << " turn " << t.turn << " depth " << depth / longer;
    if (std::abs(t.turn) > .5) continue;
    ++outside;
    rejectedOutside += !mayPenetrateArc(t.a, t.b, t.c, t.at(xi) + .3 * t.scale * t.normal(xi));
  }
  EXPECT_GT(rejectedOutside, .8 * outside);  // and it does reject
}

}  // namespace
}  // namespace yadefrag
