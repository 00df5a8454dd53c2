// Pieces of a boundary: arcs, feet, and discs on them.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "contact/contact_scenes.hpp"
#include "core/checks.hpp"
#include "mesh/shapes.hpp"
#include "surface/disc_contact.hpp"
#include "surface/piece_geometry.hpp"
#include "surface_checks.hpp"

namespace yadefrag::test {
namespace {

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

// --- piece geometry

EntryId entry(std::size_t e) { return EntryId(e); }

TEST(PieceGeometry, BoxHoldsThePieceAndEndsAreItsEnds) {
  Random random(1);
  for (int k = 0; k < 300; ++k) {
    const int n = 3 + static_cast<int>(random() % 8);
    const ContactSurfaces s = oneLoop(smoothFlags(random, static_cast<std::size_t>(n), 2));
    const auto x = star(random, {}, 1.5, n, 2. / 3);
    const PieceGeometry g(s, x);
    for (std::size_t e = 0; e < s.entries(); ++e) {
      const Box box = g.box(entry(e));
      const PieceRange range = pieceRange(s.piece[e]);
      EXPECT_NEAR(norm(g.point(entry(e), range.begin) - g.ends(entry(e)).begin), 0, 1e-15);
      EXPECT_NEAR(norm(g.point(entry(e), range.end) - g.ends(entry(e)).end), 0, 1e-15);
      double length = 0;
      Vec2 last = g.ends(entry(e)).begin;
      for (int i = 1; i <= 1000; ++i) {
        const Vec2 p = g.point(entry(e), range.begin + (range.end - range.begin) * i / 1000);
        length += norm(p - last);
        last = p;
        ASSERT_TRUE(p.x >= box.min[0] - 1e-14 && p.x <= box.max[0] + 1e-14);
        ASSERT_TRUE(p.y >= box.min[1] - 1e-14 && p.y <= box.max[1] + 1e-14);
      }
      EXPECT_NEAR(g.length(entry(e)), length, 1e-3 * length);
      EXPECT_EQ(box.min[2], 0);
      EXPECT_EQ(box.max[2], 0);
    }
  }
}

TEST(PieceGeometry, SmoothCircleIsNearlyRoundAndItsNormalsPointOutward) {
  const Loop x = circle({}, 1, 40);
  const ContactSurfaces s = oneLoop(std::vector<std::uint8_t>(40, 1));
  const PieceGeometry g(s, x);
  double perimeter = 0;
  for (std::size_t e = 0; e < s.entries(); ++e) {
    perimeter += g.length(entry(e));
    const Vec2 p = g.slave(entry(e));
    EXPECT_NEAR(norm(normalOf(g, entry(e), 0) - (1 / norm(p)) * p), 0, 1e-12);
    const Foot foot = g.foot(entry(e), {0, 0});
    EXPECT_LT(foot.gap, -.99);
  }
  EXPECT_NEAR(perimeter, 2 * std::numbers::pi, .01 * 2 * std::numbers::pi);
}

TEST(PieceGeometry, NormalsOfASquareWithOneSmoothCorner) {
  const std::vector<Vec2> x = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
  const ContactSurfaces s = oneLoop({0, 0, 1, 0});
  const PieceGeometry g(s, x);  // segment, first half, arc, second half, segment
  const Vec2 expected[] = {{0, -1}, {1, 0}, {1, 0}, {0, 1}, {-1, 0}};
  for (std::size_t e = 0; e < 5; ++e)
    EXPECT_NEAR(norm(normalOf(g, entry(e), g.range(entry(e)).begin) - expected[e]), 0, 1e-15) << e;

  const Foot first = g.foot(entry(1), {1.5, .25});
  EXPECT_DOUBLE_EQ(first.xi, .25);
  EXPECT_DOUBLE_EQ(first.gap, .5);
  EXPECT_TRUE(first.inside);
  EXPECT_FALSE(g.foot(entry(1), {1.5, .75}).inside);
  const Foot second = g.foot(entry(3), {.25, .9});
  EXPECT_DOUBLE_EQ(second.xi, .75);
  EXPECT_NEAR(second.gap, -.1, 1e-15);
  EXPECT_TRUE(second.inside);
  EXPECT_FALSE(g.foot(entry(3), {.75, .9}).inside);
}

// --- A disc against the pieces of a boundary, by brute force: the nearest of many points.

constexpr double kRadius = .4;

/// The pieces of a scene as the discs see them.
std::vector<BoundaryPiece> piecesOf(const SurfaceScene& scene) {
  const PieceGeometry geometry = scene.geometry();
  std::vector<BoundaryPiece> pieces(scene.surfaces.entries());
  for (std::size_t e = 0; e < pieces.size(); ++e) {
    const PieceEnds ends = geometry.ends(EntryId(e));
    pieces[e].start = ends.begin, pieces[e].end = ends.end;
    pieces[e].isArc = geometry.isArc(EntryId(e));
    if (!pieces[e].isArc) continue;
    NodeId around[3];
    scene.surfaces.pieceNodes(EntryId(e), around);
    pieces[e].middle = scene.at[around[1].value];
  }
  for (std::size_t e = 0; e < pieces.size(); ++e) {
    pieces[e].before = pieces[scene.surfaces.prev[e].value].tangentAtEnd();
    pieces[e].after = pieces[scene.surfaces.next[e].value].tangentAtStart();
  }
  return pieces;
}

/// (m) To the nearest of a thousand points a piece.
double distanceTo(const SurfaceScene& scene, Vec2 from) {
  const PieceGeometry geometry = scene.geometry();
  double least = INFINITY;
  for (std::size_t e = 0; e < scene.surfaces.entries(); ++e)
    for (int k = 0; k <= 1000; ++k) {
      const PieceRange range = geometry.range(EntryId(e));
      const double xi = range.begin + (range.end - range.begin) * k / 1000;
      least = std::min(least, norm(geometry.point(EntryId(e), xi) - from));
    }
  return least;
}

/// One piece pushes it, by its radius less the distance of its centre, away from the boundary.
TEST(DiscContact, OnAConvexBodyIsPushedByOnePieceByItsOverlap) {
  for (const int kind : kSmoothKinds) {
    SCOPED_TRACE(kind);
    Random random(4);
    SurfaceScene scene;
    scene.addBody(circle({}, 1, 7), smoothFlags(random, 7, kind));
    const std::vector<BoundaryPiece> pieces = piecesOf(scene);
    for (int k = 0; k < 300; ++k) {
      const double angle = even(random, 0, 2 * std::numbers::pi), far = even(random, 1.01, 1.6);
      const Vec2 centre = far * Vec2{std::cos(angle), std::sin(angle)};
      const double overlap = kRadius - distanceTo(scene, centre);
      std::size_t pushing = 0;
      for (const BoundaryPiece& piece : pieces) {
        const std::optional<DiscContact> touch = discContact(piece, centre, kRadius);
        if (!touch) continue;
        ++pushing;
        // The nearest point is up to 4·10⁻⁴ m beside the foot, which is at least .01 m away.
        EXPECT_NEAR(touch->penetration, overlap, 1e-5);
        EXPECT_NEAR(distanceTo(scene, centre - (kRadius - overlap) * touch->normal), 0, 1e-3);
      }
      if (std::abs(overlap) < 1e-5) continue;
      EXPECT_EQ(pushing, overlap > 0 ? 1U : 0U) << k;
    }
  }
}

/// The foot on an arc is the one that contact between bodies uses, to rounding.
TEST(DiscContact, FootOnAnArcIsThatOfContact) {
  Random random(5);
  SurfaceScene scene;
  scene.addBody(circle({}, 1, 9), smoothFlags(random, 9, 1));
  const std::vector<BoundaryPiece> pieces = piecesOf(scene);
  int found = 0;
  for (int k = 0; k < 2000; ++k) {
    const Vec2 centre{even(random, -1.2, 1.2), even(random, -1.2, 1.2)};
    if (norm(centre) < .8) continue;
    for (std::size_t e = 0; e < pieces.size(); ++e) {
      const std::optional<DiscContact> touch = discContact(pieces[e], centre, kRadius);
      if (!touch) continue;
      const Foot foot = scene.geometry().foot(EntryId(e), centre);
      EXPECT_NEAR(touch->penetration, kRadius - foot.gap, 1e-15);
      EXPECT_LT(norm(touch->normal - foot.normal), 1e-14);
      ++found;
    }
  }
  EXPECT_GT(found, 300);
}

}  // namespace
}  // namespace yadefrag::test
