// A disc against the pieces of a boundary, by brute force: the nearest of many points.

#include "surface/disc_contact.hpp"

#include <gtest/gtest.h>
#include <algorithm>
#include <cmath>

#include "contact/contact_scenes.hpp"

namespace yadefrag::test {
namespace {

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

std::vector<Vec2> polygon(int corners) {
  std::vector<Vec2> points;
  for (int k = 0; k < corners; ++k) {
    const double angle = 2 * std::numbers::pi * k / corners;
    points.push_back({std::cos(angle), std::sin(angle)});
  }
  return points;
}

class DiscOnAConvexBody : public testing::TestWithParam<int> {};

/// One piece pushes it, by its radius less the distance of its centre, away from the boundary.
TEST_P(DiscOnAConvexBody, IsPushedByOnePieceByItsOverlap) {
  Random random(4);
  SurfaceScene scene;
  scene.addBody(polygon(7), smoothFlags(random, 7, GetParam()));
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

INSTANTIATE_TEST_SUITE_P(Kinds, DiscOnAConvexBody, testing::Values(0, 1, 2), smoothName);

/// The foot on an arc is the one that contact between bodies uses, to rounding.
TEST(DiscContact, FootOnAnArcIsThatOfContact) {
  Random random(5);
  SurfaceScene scene;
  scene.addBody(polygon(9), smoothFlags(random, 9, 1));
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
