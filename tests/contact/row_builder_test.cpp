// Rows of the contact system: partition of unity, forces without a moment at xⁿ.

#include "contact/row_builder.hpp"

#include <gtest/gtest.h>
#include <algorithm>
#include <cmath>

#include "contact/contact_scenes.hpp"
#include "core/tolerances/contact.hpp"

namespace yadefrag::test {
namespace {

/// A body and a point near it, which goes from `from` to `to`.
struct Approach {
  SurfaceScene scene;
  EntryId body, tip;
  std::vector<Vec2> before;

  Approach(const std::vector<Vec2>& points, const std::vector<std::uint8_t>& smooth, Vec2 from,
           Vec2 to) {
    body = scene.addBody(points, smooth);
    tip = scene.addNeedle({0, -1});
    scene.moveNeedle(tip, from);
    before = scene.at;
    scene.moveNeedle(tip, to);
  }

  [[nodiscard]] ContactRow row(EntryId master) const {
    const PieceGeometry now = scene.geometry();
    return makeRow(scene.surfaces, {scene.surfaces, before},
                   {{tip, master}, now.foot(master, now.slave(tip))},
                   tolerance::Contact().faceAngle);
  }

  [[nodiscard]] Vec2 masterPoint(const ContactRow& row) const {
    Vec2 sum;
    for (int k = 1; k < row.count; ++k) sum -= row.weight[k] * before[row.node[k].value];
    return sum;
  }
};

const std::vector<Vec2> kSquare{{0, 0}, {1, 0}, {1, 1}, {0, 1}};

TEST(RowBuilder, WeightsSumToZeroOnAnyPiece) {
  Random random(21);
  for (int scene = 0; scene < 2000; ++scene) {
    const int corners = 5 + static_cast<int>(random() % 8);
    const auto points = star(random, {}, 1, corners, .5);
    const Vec2 from{even(random, -1.2, 1.2), even(random, -1.2, 1.2)};
    const Vec2 to = from + Vec2{even(random, -.1, .1), even(random, -.1, .1)};
    const Approach a(points, smoothFlags(random, corners, scene % 3), from, to);
    for (EntryId master = a.body; master < a.tip; master = master + 1) {
      const ContactRow row = a.row(master);
      double sum = 0, largest = 0;
      for (int k = 0; k < row.count; ++k) {
        sum += row.weight[k];
        largest = std::max(largest, std::abs(row.weight[k]));
        EXPECT_NE(row.weight[k], 0);
      }
      EXPECT_NEAR(sum, 0, 1e-15 * 8);
      EXPECT_LE(largest, 1.25 + 1e-9) << "shape functions go on by a quarter of a piece at most";
      EXPECT_NEAR(norm(row.normal), 1, 1e-14);
      EXPECT_EQ(row.toleratedGap, 0);
      EXPECT_EQ(row.gap, gapOf(row, a.scene.geometry()));
    }
  }
}

/// The force on the slave and its counterparts on the master's nodes: no resultant, and no moment,
/// since the slave was straight over the foot.
TEST(RowBuilder, ForcesGiveNoMomentWhereThePointWasOverTheFoot) {
  Random random(22);
  int rows = 0;
  for (int scene = 0; scene < 3000; ++scene) {
    const int corners = 6 + static_cast<int>(random() % 6);
    const auto points = star(random, {}, 1, corners, .4);
    const Vec2 from{even(random, -1.2, 1.2), even(random, -1.2, 1.2)};
    const Vec2 to = from + Vec2{even(random, -.02, .02), even(random, -.02, .02)};
    const Approach a(points, smoothFlags(random, corners, scene % 3), from, to);
    const PieceGeometry then(a.scene.surfaces, a.before), now = a.scene.geometry();
    for (EntryId master = a.body; master < a.tip; master = master + 1) {
      // Over the piece now and before.
      if (!then.foot(master, from).inside || !now.foot(master, to).inside) continue;
      const ContactRow row = a.row(master);
      double moment = 0;
      Vec2 force;
      for (int k = 0; k < row.count; ++k) {
        moment += row.weight[k] * cross(a.before[row.node[k].value], row.normal);
        force += row.weight[k] * row.normal;
      }
      EXPECT_NEAR(norm(force), 0, 1e-14);
      EXPECT_NEAR(moment, 0, 1e-13);
      ++rows;
    }
  }
  EXPECT_GT(rows, 3000);
}

TEST(RowBuilder, NormalAndFootAreThoseBefore) {
  const Approach a(kSquare, {}, {.3, 1.01}, {.4, .98});
  const ContactRow row = a.row(a.body + 2);
  EXPECT_EQ(row.normal, (Vec2{0, 1}));
  EXPECT_NEAR(row.gap, -.02, 1e-15);
  ASSERT_EQ(row.count, 3);
  EXPECT_EQ(row.weight[0], 1);
  EXPECT_NEAR(row.weight[1], -.3, 1e-15);  // of (1, 1)
  EXPECT_NEAR(row.weight[2], -.7, 1e-15);  // of (0, 1)
}

/// Over a joint without a turn the foot before was on the neighbour; there the force acts.
TEST(RowBuilder, FootBeforeOnTheNeighbourAcrossAFlatJoint) {
  const Approach a({{0, 0}, {2, 0}, {2, 1}, {1, 1.02}, {0, 1}}, {}, {1.05, 1.1}, {.95, .9});
  const ContactRow row = a.row(a.body + 3);  // from (1, 1.02) to (0, 1)
  EXPECT_EQ(row.master, a.body + 3) << "it stays active on the piece that it is on now";
  EXPECT_EQ(row.node[1], NodeId(std::size_t{2}));
  EXPECT_EQ(row.node[2], NodeId(std::size_t{3}));
  EXPECT_NEAR(cross(a.masterPoint(row) - Vec2{1.05, 1.1}, row.normal), 0, 1e-14);
}

/// Into a notch, however blunt: with the neighbour's normal contact would push the point on the way
/// that it came.
TEST(RowBuilder, NormalIsThePiecesOwnInANotch) {
  const Approach a({{0, 0}, {2, 0}, {2, 1.1}, {1, 1}, {0, 1.1}}, {}, {1.05, 1.1}, {.95, .9});
  const ContactRow row = a.row(a.body + 3);  // from (1, 1) to (0, 1.1)
  EXPECT_EQ(row.node[1], NodeId(std::size_t{3}));
  EXPECT_NEAR(cross(row.normal, {.1, 1}), 0, 1e-15);
  EXPECT_NEAR(cross(a.masterPoint(row) - Vec2{1.05, 1.1}, row.normal), 0, 1e-14);
}

/// At a sharp corner the neighbour's normal is another: the piece's own end takes the force, a
/// little beyond it where that keeps the moment small.
TEST(RowBuilder, FootBeforePastASharpCorner) {
  const Approach near(kSquare, {}, {-.1, 1.01}, {.1, .99});
  const ContactRow row = near.row(near.body + 2);
  EXPECT_EQ(row.normal, (Vec2{0, 1}));
  EXPECT_NEAR(near.masterPoint(row).x, -.1, 1e-15);
  const Approach far(kSquare, {}, {-.6, 1.01}, {.1, .99});
  const ContactRow clamped = far.row(far.body + 2);
  EXPECT_EQ(clamped.count, 2) << "the corner's node alone";
  EXPECT_NEAR(far.masterPoint(clamped).x, 0, 1e-15);
}

/// In a concave corner without an orthogonal foot the corner's node takes each row's force, unless
/// the slave was over the piece at the begin of the step, near the corner.
TEST(RowBuilder, ConcaveCornerIsCorrectedToItsNode) {
  const std::vector<Vec2> notch{{-1, -1}, {1, -1}, {1, 1}, {0, 0}, {-1, 1}};
  const Approach near(notch, {}, {0, .002}, {.001, -.02});
  const Approach a(notch, {}, {0, .1}, {.001, -.02});
  for (const EntryId master : {near.body + 2, near.body + 3}) {
    const ContactRow row = near.row(master);
    ASSERT_EQ(row.count, 3);
    EXPECT_NEAR(std::min(row.weight[1], row.weight[2]), -.999, 1e-12);
  }
  for (const EntryId master : {a.body + 2, a.body + 3}) {
    const ContactRow row = a.row(master);
    ASSERT_EQ(row.count, 2);
    EXPECT_EQ(row.node[1], NodeId(std::size_t{3}));
    EXPECT_EQ(row.weight[1], -1);
  }
}

TEST(RowBuilder, HalfpointsAreSlavesOfTwoNodes) {
  SurfaceScene scene;
  scene.addBody(kSquare);
  const EntryId smooth = scene.addBody({{0, 3}, {.5, 1.9}, {1, 3}}, {1, 1, 1});
  // The halfpoint between the first two nodes: (.25, 2.45); the square's top is at 1.
  const PieceGeometry geometry = scene.geometry();
  const EntryId top(std::size_t{2});
  const ContactRow row =
      makeRow(scene.surfaces, geometry, {{smooth, top}, geometry.foot(top, geometry.slave(smooth))},
              tolerance::Contact().faceAngle);
  ASSERT_EQ(row.count, 4);
  EXPECT_EQ(row.weight[0], .5);
  EXPECT_EQ(row.weight[1], .5);
  EXPECT_NEAR(row.gap, 1.45, 1e-15);
}

}  // namespace
}  // namespace yadefrag::test
