// Candidates, and which points are slaves. Rows on rigid boundaries that obey forces: against the
// equations of a rigid body.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <string>
#include <vector>

#include "contact/candidates.hpp"
#include "contact/contact.hpp"
#include "contact/contact_scenes.hpp"
#include "contact/pass_rule.hpp"
#include "core/checks.hpp"

namespace yadefrag::test {
namespace {

/// A push beside a corner so light that it would be thrown over many segments.
TEST(Contact, ACorrectionOfManySegmentsIsRefused) {
  SurfaceScene scene;
  const EntryId body = scene.addBody({{0, 0}, {9, -1}, {10, 0}});
  const Vec2 tip{9.96, 0};
  const EntryId pressing = scene.addBody({tip, tip + Vec2{.1, 2}, tip + Vec2{-.1, 2}});
  const auto nodeOf = [&](EntryId entry) { return scene.surfaces.slave(entry).node[0].value; };
  Model model;
  model.nodes = plainNodes(scene.at.size());
  model.nodes.position = scene.at;
  model.components.resize(scene.components);
  model.nodes.mass[nodeOf(body)] = 1e-9;
  for (std::size_t k = 0; k < 3; ++k) {
    model.nodes.held[nodeOf(pressing + k)] = kHeldXY;
    model.nodes.position[nodeOf(pressing + k)].y -= .1;
  }
  Contact contact;
  std::vector<SlaveMaster> pairs{{pressing, body + 2}};
  replaceCandidates(contact.candidates, pairs, scene.surfaces.entries());
  constexpr double kOne = 1, kMove = .1, kShortest = 1;  // s, m, m
  const RigidMasses none;
  const std::string text = saidBy<RunError>([&] {
    contact.correct(model, scene.surfaces, {kOne, 0, kMove, kShortest, scene.at, 1, none, {}});
  });
  EXPECT_TRUE(contains(text, "contact moves a surface node"))
      << "it is thrown by 25 m, and a segment is 1 m long";
}

// --- Rows of candidates.

/// Of the rows that no later one has replaced: ascending.
std::vector<SlaveMaster> pairsIn(const Candidates& candidates) {
  std::vector<SlaveMaster> pairs;
  EXPECT_EQ(candidates.offsets.size(), candidates.slaves.size() + 1);
  EXPECT_EQ(candidates.offsets.back(), candidates.masters.size());
  for (std::size_t row = 0; row < candidates.slaves.size(); ++row) {
    EXPECT_LT(candidates.offsets[row], candidates.offsets[row + 1]);
    EXPECT_TRUE(std::ranges::is_sorted(candidates.mastersOfRow(row)));
  }
  for (const std::uint32_t row : candidates.rows())
    for (const EntryId master : candidates.mastersOfRow(row))
      pairs.push_back({candidates.slaves[row], master});
  return pairs;
}

/// Whatever pairs come, go and stay.
TEST(Candidates, RowsContainTheGivenPairs) {
  Random random(5);
  SurfaceScene scene;
  scene.addBody(star(random, {0, 0}, 1, 9, .4));
  scene.addBody(star(random, {1.5, .2}, 1, 7, .4), {1, 1, 0, 1, 0, 0, 1});
  std::vector<SlaveMaster> all;
  for (std::size_t s = 0; s < scene.surfaces.entries(); ++s)
    for (std::size_t m = 0; m < scene.surfaces.entries(); ++m)
      if (s != m && scene.surfaces.prev[s].value != m) all.push_back({EntryId(s), EntryId(m)});
  const auto anyOf = [&](std::size_t one) {
    std::vector<SlaveMaster> pairs;
    for (const SlaveMaster& pair : all)
      if (random() % one != 0) pairs.push_back(pair);
    std::shuffle(pairs.begin(), pairs.end(), random);
    return pairs;
  };
  Candidates candidates;
  std::vector<EntryId> entries;
  for (std::size_t e = 0; e < scene.surfaces.entries(); ++e) entries.emplace_back(e);
  std::vector<SlaveMaster> former;
  for (int round = 0; round < 200; ++round) {
    std::vector<SlaveMaster> pairs = round % 20 == 7 ? anyOf(1) : anyOf(3), more = anyOf(2);
    Candidates replaced = replaceCandidates(candidates, pairs, entries.size());
    if (round > 0) {
      ASSERT_EQ(pairsIn(replaced), former);
    }
    ASSERT_EQ(pairsIn(candidates), pairs) << "sorted by the call";
    addCandidates(candidates, more, entries);
    former.clear();
    std::set_union(pairs.begin(), pairs.end(), more.begin(), more.end(),
                   std::back_inserter(former));
    ASSERT_EQ(pairsIn(candidates), former);
    for (const EntryId master : entries) {
      std::vector<EntryId> found, wanted;
      candidates.appendSlavesOf(master, found);
      for (const SlaveMaster& pair : former)
        if (pair.master == master) wanted.push_back(pair.slave);
      std::sort(found.begin(), found.end());
      ASSERT_EQ(found, wanted);
    }
  }
}

// --- Single and double pass: which sampling points may be slaves of which surface.

/// A square of edge 1 with `parts` segments an edge; every `parts`-th node is a corner.
std::vector<Vec2> squareOf(int parts, Vec2 low = {}) {
  std::vector<Vec2> points;
  const Vec2 corner[] = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
  for (int side = 0; side < 4; ++side)
    for (int k = 0; k < parts; ++k)
      points.push_back(low + corner[side] +
                       double(k) / parts * (corner[(side + 1) % 4] - corner[side]));
  return points;
}

/// The rule in a scene with one component a body, of which `brittle` may crack.
struct Roles {
  explicit Roles(const SurfaceScene& scene, int passes, std::size_t brittle = ~std::size_t{0})
      : surfaces(scene.surfaces) {
    model.components.resize(scene.components);
    if (brittle < scene.components) model.components[brittle].brittle.tensileStrength = 1;
    rule.update(surfaces, scene.at, {.passes = passes});
  }

  [[nodiscard]] bool mayBeSlave(EntryId slave, EntryId master) const {
    return rule.mayBeSlave(model, surfaces, slave, master);
  }

  void expectAllSlaves() const {
    for (std::size_t s = 0; s < surfaces.entries(); ++s)
      for (std::size_t m = 0; m < surfaces.entries(); ++m)
        EXPECT_TRUE(mayBeSlave(EntryId(s), EntryId(m)));
  }

  const ContactSurfaces& surfaces;
  Model model;
  PassRule rule;
};

TEST(PassRule, InTwoPassesAndWithABodyThatCracksAllAreSlaves) {
  SurfaceScene scene;
  scene.addBody(squareOf(2));
  scene.addBody(squareOf(5));
  Roles(scene, 2).expectAllSlaves();
  for (const std::size_t brittle : {0U, 1U}) Roles(scene, 1, brittle).expectAllSlaves();
  const SurfaceScene none;
  for (const int passes : {1, 2}) Roles(none, passes).expectAllSlaves();
}

TEST(PassRule, FinerSurfaceAndSharpCornersOfTheCoarser) {
  SurfaceScene scene;
  const EntryId coarse = scene.addBody(squareOf(3));
  const EntryId fine = scene.addBody(squareOf(5));
  const Roles roles(scene, 1);
  for (std::size_t k = 0; k < 20; ++k) EXPECT_TRUE(roles.mayBeSlave(fine + k, coarse));
  for (std::size_t k = 0; k < 12; ++k) {
    EXPECT_EQ(roles.mayBeSlave(coarse + k, fine), k % 3 == 0) << k;
    EXPECT_TRUE(roles.mayBeSlave(coarse + k, coarse))
        << "within one surface every point is a slave";
  }
}

/// Exactly one of two flat points of different surfaces is a slave of the other's.
TEST(PassRule, EachPairHasExactlyOneSlave) {
  Random random(9);
  SurfaceScene scene;
  EntryId flat[8];
  for (EntryId& entry : flat)
    entry = scene.addBody(squareOf(2 + static_cast<int>(random() % 9))) + 1;
  const Roles roles(scene, 1);
  for (std::uint32_t a = 0; a < 8; ++a)
    for (std::uint32_t b = 0; b < a; ++b)
      EXPECT_NE(roles.mayBeSlave(flat[a], flat[b]), roles.mayBeSlave(flat[b], flat[a]));
}

TEST(PassRule, SharpMeansConvexAndMoreThanTwentyDegrees) {
  const auto isSlave = [](double degrees) {
    SurfaceScene scene;
    const double turn = degrees * std::numbers::pi / 180;
    // The corner at the origin turns by `turn`, all other corners of the loop are sharp.
    const Vec2 leave{std::cos(turn), std::sin(turn)};
    scene.addBody({{0, 0}, leave, leave + Vec2{-.5, 3}, {-1, 3}, {-1, 0}});
    const EntryId fine = scene.addBody(squareOf(20));
    return Roles(scene, 1).mayBeSlave(EntryId(std::size_t{0}), fine);
  };
  EXPECT_FALSE(isSlave(0));
  EXPECT_FALSE(isSlave(19));
  EXPECT_TRUE(isSlave(21));
  EXPECT_TRUE(isSlave(60));
  EXPECT_FALSE(isSlave(-60)) << "concave corners cannot hit anything";
}

TEST(PassRule, HalfpointsAreNeverSharp) {
  SurfaceScene scene;
  const EntryId body = scene.addBody({{0, 0}, {4, 0}, {4, 4}, {0, 4}}, {1, 1, 1, 0});
  const EntryId fine = scene.addBody(squareOf(20));
  const Roles roles(scene, 1);
  for (std::size_t e = body.value; scene.surfaces.loop[e] == 0; ++e) {
    const bool isCorner = scene.surfaces.slave(EntryId(e)).count == 1;
    EXPECT_EQ(roles.mayBeSlave(EntryId(e), fine), isCorner);
  }
}

// --- Rows on rigid boundaries that obey forces: against the equations of a rigid body.

/// Free nodes under a bar of two held nodes, whose body has its centre at the origin.
struct Scene {
  Nodes nodes;
  std::vector<RigidMass> bodies;
  std::vector<ContactRow> rows;

  /// Rows of nodes at `at` (m, along the bar at the height `height`) with their gaps (m).
  Scene(std::vector<double> at, std::vector<double> gaps, RigidMass body, double friction = 0,
        double height = .3) {
    const std::size_t count = at.size();
    nodes = plainNodes(count + 2);
    nodes.held.resize(count + 2);
    nodes.held[count] = nodes.held[count + 1] = kHeldXY;
    for (std::size_t i = 0; i < count; ++i) {
      nodes.mass[i] = 1 + .5 * static_cast<double>(i);
      const double xi = (at[i] + 1) / 2;
      ContactRow row;
      row.normal = {0, -1};
      row.gap = gaps[i];
      row.friction = friction;
      row.slip = friction > 0 ? 1e-4 : 0;
      row.add({{NodeId(i), {}, {}}, {1, 0, 0}, 1}, 1);
      row.add({{NodeId(count), NodeId(count + 1), {}}, {1 - xi, xi, 0}, 2}, -1);
      row.rigid = {0, -1, -1 * Vec2{at[i], height}};
      rows.push_back(row);
    }
    bodies = {body};
  }
  [[nodiscard]] Inertia inertia() const { return {nodes, kDt, 0, bodies}; }

  /// (m) Gap and slip of a row after the motion that all forces cause.
  [[nodiscard]] Vec2 left(const ContactRow& row) const {
    Vec2 force;
    double moment = 0;
    for (const ContactRow& other : rows) {
      force += other.rigid.weight * other.force();
      moment += cross(other.rigid.lever, other.force());
    }
    const RigidMass& body = bodies[0];
    const Vec2 shift = kDt * kDt * Vec2{body.mobility.x * force.x, body.mobility.y * force.y};
    const double angle = kDt * kDt * body.turning * moment;
    const Vec2 lever = row.rigid.lever;
    Vec2 moved = row.rigid.weight * shift + angle * Vec2{-lever.y, lever.x};
    moved += kDt * kDt / nodes.mass[row.node[0].value] * row.force();
    return {row.gap + dot(moved, row.normal), row.slip + dot(moved, row.tangent())};
  }
  void expectSolved(double tolerance) const {
    for (const ContactRow& row : rows) {
      const Vec2 gapAndSlip = left(row);
      EXPECT_GE(row.normalForce, 0);
      EXPECT_GE(gapAndSlip.x, -tolerance);
      if (row.normalForce > 0) {
        EXPECT_LE(gapAndSlip.x, tolerance);
      }
      const double most = row.friction * row.normalForce;
      // Bounds follow the normal forces of the solution before (kFrictionChange).
      EXPECT_LE(std::abs(row.tangentForce), most * (1 + 1e-5));
      if (std::abs(row.tangentForce) < .99 * most) {
        EXPECT_NEAR(gapAndSlip.y, 0, tolerance);
      }
    }
  }
};

/// 1/F = Δt² [1/m + 1/M + a²/I] for one row whose line of action is at a distance a of the centre;
/// without the mobilities of directions that are blocked.
TEST(RigidRows, OneNodeAtABody) {
  for (const RigidMass& body : {RigidMass{{}, {}, {1e6, 1e6}, 5e6},
                                {{}, {}, {1, 1}, 5},
                                {{}, {}, {1e-6, 1e-6}, 5e-6},
                                {{}, {}, {1, 0}, 0}}) {
    Scene scene({.4}, {-1e-5}, body);
    RowSweeps sweeps;
    solveRows(sweeps, scene.rows, scene.inertia(), {1e-18, 1000});
    const double mobile = 1 / scene.nodes.mass[0] + body.mobility.y + .4 * .4 * body.turning;
    EXPECT_NEAR(scene.rows[0].normalForce * kDt * kDt * mobile / 1e-5, 1, 1e-12);
    scene.expectSolved(1e-17);
  }
}

/// Nodes press from both sides on a bar that is lighter by up to 10⁸: they stop each other in a few
/// sweeps, as many as with a heavy bar. Three rows are as many as it has degrees of freedom: the
/// others are redundant.
TEST(RigidRows, ALightBodyBetweenOthers) {
  for (const double mass : {1e-8, 1e-4, 1., 1e4})
    for (const double friction : {0., .6}) {
      Scene scene({-.8, -.2, .5, .9, -.7, 0, .6}, {-1e-5, 2e-6, -3e-5, -1e-6, -2e-5, -1e-5, -1e-6},
                  {{}, {}, {1 / mass, 1 / mass}, 3 / mass}, friction);
      for (std::size_t r = 4; r < scene.rows.size(); ++r) {
        ContactRow& row = scene.rows[r];
        row.normal = {0, 1};
        row.rigid.lever = {row.rigid.lever.x, .3};
      }
      RowSweeps sweeps;
      solveRows(sweeps, scene.rows, scene.inertia(), {1e-13, 1000});
      EXPECT_LE(sweeps.sweeps(), 20) << mass << ", " << friction;
      scene.expectSolved(1e-11);
      // What the bar itself takes is its share.
      double up = 0, down = 0;
      for (const ContactRow& row : scene.rows) (row.normal.y > 0 ? up : down) += row.normalForce;
      EXPECT_GT(up, 0);
      EXPECT_NEAR(up / down, 1, 2 * mass) << mass;
    }
}

/// The same between walls: there is no room, but forces remain finite.
TEST(RigidRows, ALightBodyBetweenHeldNodes) {
  Scene scene({-.5, .5, -.5, .5}, {-1e-6, -1e-6, 1e-6, 1e-6}, {{}, {}, {1e4, 1e4}, 3e4});
  for (std::size_t r = 0; r < 4; ++r) scene.nodes.held[r] = kHeldXY;
  for (std::size_t r = 2; r < 4; ++r)
    scene.rows[r].normal = {0, 1}, scene.rows[r].rigid.lever.y = .3;
  RowSweeps sweeps;
  solveRows(sweeps, scene.rows, scene.inertia(), {1e-13, 1000});
  for (const ContactRow& row : scene.rows) {
    EXPECT_TRUE(std::isfinite(row.normalForce));
    EXPECT_LE(row.normalForce, 1e3 * 1e-6 / (kDt * kDt * 1e4));
  }
}

}  // namespace
}  // namespace yadefrag::test
