// Rows on rigid boundaries that obey forces: against the equations of a rigid body.

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>
#include <vector>

#include "contact/contact_scenes.hpp"
#include "core/checks.hpp"

namespace yadefrag::test {
namespace {

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

/// 1/F = Δt² [1/m + 1/M + a²/I] for one row whose line of action is at a distance a of the centre.
TEST(RigidRows, OneNodeAtABody) {
  for (const double mass : {1e-6, 1., 1e6}) {
    Scene scene({.4}, {-1e-5}, {{}, {}, {1 / mass, 1 / mass}, 1 / (.2 * mass)});
    RowSweeps sweeps;
    solveRows(sweeps, scene.rows, scene.inertia(), {1e-18, 1000});
    const double mobile = 1 / scene.nodes.mass[0] + 1 / mass + .4 * .4 / (.2 * mass);
    EXPECT_NEAR(scene.rows[0].normalForce * kDt * kDt * mobile / 1e-5, 1, 1e-12);
    scene.expectSolved(1e-17);
  }
}

TEST(RigidRows, BlockedDirectionsDoNotMove) {
  Scene scene({.4}, {-1e-5}, {{}, {}, {1, 0}, 0});
  RowSweeps sweeps;
  solveRows(sweeps, scene.rows, scene.inertia(), {1e-18, 1000});
  EXPECT_NEAR(scene.rows[0].normalForce * kDt * kDt / 1e-5, scene.nodes.mass[0], 1e-12);
}

/// Nodes press from both sides on a bar that is lighter by up to 10⁸: they stop each other in a few
/// sweeps, as many as with a heavy bar.
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

/// Three rows are as many as the body has degrees of freedom; five are redundant for it.
TEST(RigidRows, AgreeWithTheBodysEquations) {
  const std::vector<double> at{-.9, -.3, .1, .5, 1.}, gaps{-1e-5, 2e-6, -3e-5, -1e-6, -2e-5};
  for (const double mass : {1e-2, 1., 1e4})
    for (const double friction : {0., .4}) {
      const RigidMass body{{}, {}, {1 / mass, 1 / mass}, 3 / mass};
      Scene scene(at, gaps, body, friction);
      RowSweeps sweeps;
      solveRows(sweeps, scene.rows, scene.inertia(), {1e-16, 10000});
      scene.expectSolved(1e-11);
      record("sweeps_mass_" + std::to_string(mass), sweeps.sweeps());
    }
}

}  // namespace
}  // namespace yadefrag::test
