// Whole runs have the same bits for any number of threads, and searching more often than the halo
// requires changes nothing.

#include <gtest/gtest.h>
#include <cmath>

#include <algorithm>
#include <numbers>
#include <random>

#include "core/same_bits.hpp"
#include "step/bodies.hpp"
#include "step/figures.hpp"

namespace yadefrag::test {
namespace {

constexpr double kSide = .01;  // m

TriangleMesh tile(Vec2 centre, double turn, double size, int corners) {
  Polygon polygon;
  for (int k = 0; k < corners; ++k) {
    const double angle = turn + 2 * std::numbers::pi * k / corners;
    polygon.outline.push_back(centre + kSide / 2 * Vec2{std::cos(angle), std::sin(angle)});
  }
  return triangulate(polygon, size);
}

/// Squares and discs at random speeds that close in on each other.
World crowd(int side, int fineness, double speed, double friction, int passes) {
  World world;
  world.contactSettings.passes = passes;
  std::mt19937 random(3);
  std::uniform_real_distribution<double> any(-1, 1);
  for (int i = 0; i < side; ++i)
    for (int j = 0; j < side; ++j) {
      const Vec2 centre{1.06 * kSide * i, 1.06 * kSide * j};
      const bool disc = (i + j) % 2 == 0;
      const TriangleMesh mesh =
          tile(centre, any(random), kSide / (fineness + j), disc ? 4 * fineness : 4);
      const double middle = .53 * kSide * (side - 1);
      const Vec2 inwards = Vec2{middle, middle} - centre;
      BodySpec spec = moving(
          mesh, steel(), speed * (Vec2{any(random), any(random)} + (1 / (kSide * side)) * inwards));
      spec.friction = friction;
      if (disc) smoothAll(spec, mesh);
      world.addBody(mesh, spec);
    }
  return world;
}

/// Everything that moves, and what was active in each step.
struct End {
  std::vector<Vec2> position, velocity;
  std::vector<std::vector<SlaveMaster>> actives;
  double contact = 0, friction = 0;
  std::uint64_t searches = 0;
};

std::vector<SlaveMaster> activesOf(const World& world) {
  std::vector<SlaveMaster> pairs;
  for (const ContactRow& row : world.contact.rows()) pairs.push_back({row.slave, row.master});
  return pairs;
}

double mostActives(const End& end) {
  std::size_t most = 0;
  for (const auto& pairs : end.actives) most = std::max(most, pairs.size());
  return static_cast<double>(most);
}

void expectSame(const End& a, const End& b) {
  EXPECT_TRUE(sameBits(a.position, b.position));
  EXPECT_TRUE(sameBits(a.velocity, b.velocity));
  EXPECT_TRUE(a.actives == b.actives);
  EXPECT_EQ(a.contact, b.contact);
  EXPECT_EQ(a.friction, b.friction);
}

/// In the middle a body leaves and another one comes.
End runWithThreads(int threads, int passes) {
  World world = crowd(5, 14, 60, .3, passes);
  world.threads = threads;
  const double dt = .7 * world.criticalTimeStep();
  End end;
  const auto steps = [&](int count) {
    for (int i = 0; i < count; ++i) {
      world.step(dt);
      end.actives.push_back(activesOf(world));
    }
  };
  steps(400);
  world.removeBody(ComponentId(7));
  steps(200);
  const TriangleMesh late = tile({-1.3 * kSide, 2 * kSide}, .2, kSide / 7, 4);
  world.addBody(late, moving(late, steel(), {120, 0}));
  steps(400);
  end.position = world.model.nodes.position;
  end.velocity = world.model.nodes.velocity;
  end.contact = world.ledger.contact, end.friction = world.ledger.friction;
  return end;
}

class Threads : public ::testing::TestWithParam<int> {};

TEST_P(Threads, DoNotChangeTheResult) {
  const End one = runWithThreads(1, GetParam());
  record("nodes", static_cast<double>(one.position.size()));
  record("most_actives", mostActives(one));
  ASSERT_GT(one.contact, 0);
  const ThreadsForFew few;
  for (const int threads : {2, 3}) {
    SCOPED_TRACE(threads);
    expectSame(one, runWithThreads(threads, GetParam()));
  }
}

INSTANTIATE_TEST_SUITE_P(Passes, Threads, ::testing::Values(2));

/// `forced`: a search in every step.
End runWithSearches(bool forced, double speed, int passes, int count) {
  World world = crowd(4, 6, speed, .3, passes);
  const double dt = .7 * world.criticalTimeStep();
  End end;
  for (int i = 0; i < count; ++i) {
    if (forced) world.search.makeDue();
    world.step(dt);
    end.actives.push_back(activesOf(world));
  }
  end.position = world.model.nodes.position;
  end.velocity = world.model.nodes.velocity;
  end.contact = world.ledger.contact, end.friction = world.ledger.friction;
  end.searches = world.numSearches();
  return end;
}

// The same pairs are active in each step, and the runs have the same bits: nothing but the
// candidates depends on the time of the search.
class Searches : public ::testing::TestWithParam<std::pair<double, int>> {};

TEST_P(Searches, NothingIsMissedBetweenTwo) {
  const auto [speed, passes] = GetParam();
  const int count = speed > 100 ? 600 : 3000;
  const End often = runWithSearches(true, speed, passes, count);
  const End seldom = runWithSearches(false, speed, passes, count);
  record("searches", static_cast<double>(seldom.searches));
  record("searches_forced", static_cast<double>(often.searches));
  record("most_actives", mostActives(often));
  ASSERT_GT(often.contact, 0);
  EXPECT_LT(2 * seldom.searches, often.searches);
  EXPECT_TRUE(often.actives == seldom.actives);
  expectSame(often, seldom);
}

INSTANTIATE_TEST_SUITE_P(SpeedsAndPasses, Searches,
                         ::testing::Values(std::pair{10., 1}, std::pair{60., 1}, std::pair{60., 2},
                                           std::pair{500., 1}, std::pair{500., 2}));

}  // namespace
}  // namespace yadefrag::test
