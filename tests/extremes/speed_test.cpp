// From a nanometre a second to beyond the speed of waves: nothing passes through anything unseen.
// The mechanism of the table of limits itself.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <random>
#include <set>
#include <sstream>

#include "extremes/block_collision.hpp"
#include "extremes/limits.hpp"
#include "meshing/polygon.hpp"

namespace yadefrag::test {
namespace {

TEST(ExtremeSpeed, FromANanometrePerSecondToTheWaveSpeed) {
  const double wave = waveSpeed(rubber());
  const auto at = [&](double speed) {
    return collide({.speed = speed, .gap = std::min(1e-3, .1 * speed / wave), .shorten = true});
  };
  const Outcome usual = at(1e-3 * wave);
  double least = kNone, most = kNone;
  for (const double speed : {1e-9, 1e-6, 1e-3, 1., 10., .5 * wave, wave}) {
    const Outcome outcome = at(speed);
    // In steps of a third of a segment the rotation's second order is a fiftieth of it.
    EXPECT_TRUE(outcome.isSound(5e-3, speed > .3 * wave ? .03 : 1e-2))
        << speed << " m/s: " << outcome.refusal;
    EXPECT_NEAR(outcome.left.x, usual.left.x, .04) << speed;
    if (std::isnan(least)) least = speed;
    most = speed / wave;
  }
  EXPECT_EQ(least, 1e-9);
  for (const double part : {2., 5., 30., 1000.}) {
    const std::string beyond = at(part * wave).refusal;
    EXPECT_TRUE(beyond.find("is inverted") != std::string::npos ||
                beyond.find("is pressed to") != std::string::npos ||
                beyond.find("take a shorter step") != std::string::npos)
        << part << ": " << beyond;
  }
  limit("closing speed of two elastic blocks, of the wave speed", kNone, most,
        "works by shorter steps, or stops: a shorter step is needed");
  limit("closing speed, m/s", least, kNone,
        "body too slow for its coordinates' rounding: refused when added");
}

struct Shot {
  double speed;  // of the wave speed
  int seed, passes;
};

/// A small block on its way through a thin plate, anywhere, any way round.
World shotAtPlate(const Shot& shot) {
  std::mt19937 random(shot.seed);
  const auto from = [&](double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random);
  };
  World world = inPasses(shot.passes);
  const TriangleMesh plate = structuredRectangle({-1, -.1}, {1, 0}, 40, 2);
  BodySpec held = moving(plate, rubber(), {});
  hold(held, plate, kHeldXY, [](Vec2 at) { return std::abs(at.x) > .99; });
  world.addBody(plate, held);
  TriangleMesh block = structuredRectangle({-.1, -.1}, {.1, .1}, 1 + shot.seed % 4, 2);
  const double turn = from(0, 6), way = from(-2.8, -.3), x = from(-.3, .3);
  for (Vec2& node : block.nodes) node = Vec2{x, .2} + turnedBy(node, turn);
  const double speed = shot.speed * waveSpeed(rubber());
  world.addBody(block, moving(block, rubber(), turnedBy({speed, 0}, way)));
  return world;
}

struct Hit {
  std::string refusal;
  double deepest = 0;  ///< of the shortest segment
  bool through = false, touched = false;
};

Hit hit(const Shot& shot, bool shorten) {
  World world = shotAtPlate(shot);
  Hit result;
  double dt = .9 * world.criticalTimeStep();
  const double end = .5 / (shot.speed * waveSpeed(rubber()));
  result.refusal = sentenceOf([&] {
    for (int i = 0; world.time < end; ++i) {
      stepOrShorter(world, dt, shorten);
      result.touched = result.touched || !world.contact.rows().empty();
      if (i % 10 == 0 || shot.speed > 1)
        result.deepest = std::max(result.deepest, deepestNode(world) / .05);
    }
  });
  const Nodes& nodes = world.model.nodes;
  for (std::size_t n = 0; n < nodes.size(); ++n)
    result.through = result.through || (nodes.component[n] == ComponentId(1UL) &&
                                        nodes.position[n].y < -.1 && !result.touched);
  return result;
}

/// With a single pass, points of the coarser surface are not kept out.
double allowed(int passes) { return passes == 1 ? .5 : .1; }

TEST(ExtremeSpeed, NothingPassesThroughAThinPlateUnseen) {
  int asked = 0, whole = 0;
  for (const double speed : {.3, .6, 1., 2., 5., 20., 1e3, 1e6})
    for (int seed = 0; seed < 12; ++seed) {
      const Hit result = hit({speed, seed, 1 + seed % 2}, false);
      EXPECT_LE(result.deepest, allowed(1 + seed % 2)) << speed << " seed " << seed;
      EXPECT_FALSE(result.through) << speed << " seed " << seed;
      EXPECT_TRUE(result.touched || !result.refusal.empty()) << speed << " seed " << seed;
      (result.refusal.empty() ? whole : asked)++;
      if (speed > .9) {
        EXPECT_NE(result.refusal, "") << speed << " seed " << seed;
      }
    }
  EXPECT_GT(asked, 50);
  EXPECT_GE(whole, 12);
  for (int seed = 0; seed < 6; ++seed) {
    const Hit shortened = hit({.5, seed, 2}, true);
    EXPECT_EQ(shortened.refusal, "") << seed << ": shorter steps suffice";
    EXPECT_LE(shortened.deepest, allowed(2)) << seed;
    EXPECT_TRUE(shortened.touched) << seed;
  }
}

/// Flying side by side, or alone, is no reason to refuse a step.
TEST(ExtremeSpeed, OnlyMotionAgainstEachOtherCounts) {
  for (const double along : {.4, 5., 9.}) {
    World world = worldOf({.speed = 0, .gap = .01});
    const double dt = world.criticalTimeStep();
    for (Vec2& velocity : world.model.nodes.velocity) velocity = {along * .25 / dt, 0};
    EXPECT_EQ(sentenceOf([&] {
                for (int i = 0; i < 20; ++i) world.step(.999 * dt);
              }),
              "")
        << along;
  }
}

/// The refused step names one that is not refused.
TEST(ExtremeSpeed, ARefusedStepNamesAShorterOne) {
  for (const double motion : {.52, .9, 3., 9., 11., 1e3, 1e9}) {  // of a segment
    World world = worldOf({.gap = .05});
    const double dt = world.criticalTimeStep();
    for (std::size_t n = 0; n < world.model.nodes.size(); ++n)
      world.model.nodes.velocity[n] =
          world.model.nodes.component[n] == ComponentId(0UL) ? Vec2{motion * .25 / dt, 0} : Vec2{};
    const std::string text = sentenceOf([&] { world.step(dt); });
    const std::string ask = "take a step of at most ";
    ASSERT_TRUE(contains(text, ask)) << motion << ": " << text;
    const double shorter = std::stod(text.substr(text.find(ask) + ask.size()));
    EXPECT_LT(shorter, dt);
    const std::string again = sentenceOf([&] { world.step(.999 * shorter); });
    // Beyond ten segments the first sentence may be followed by that of bodies about to touch.
    EXPECT_TRUE(again.empty() || (motion > 10 && again.find("may not by more than 0.5"))) << again;
  }
}

TEST(ExtremeSpeed, LimitsOfAStep) {
  double most = 0, mostAlone = 0;
  const double length = .25;  // of the right one's segments
  for (const double part : {.1, .2, .3, .4, .5, .6, .7}) {
    World world = worldOf({.gap = .05});
    const double dt = .5 * world.criticalTimeStep();
    for (std::size_t n = 0; n < world.model.nodes.size(); ++n)
      if (world.model.nodes.component[n] == ComponentId(0UL))
        world.model.nodes.velocity[n] = {.9999 * part * length / dt, 0};
    if (sentenceOf([&] { world.step(dt); }).empty()) most = part;
  }
  for (const double part : {1., 2., 5., 10., 20.}) {
    World world = worldOf({.gap = 50});
    const double dt = .5 * world.criticalTimeStep();
    for (Vec2& velocity : world.model.nodes.velocity) velocity = {.9999 * part * length / dt, 0};
    if (sentenceOf([&] { world.step(dt); }).empty()) mostAlone = part;
  }
  limit("motion of bodies about to touch in one step, of a segment", kNone, most,
        "refused: a shorter step is needed");
  limit("motion of any surface node in one step, of the shortest segment", kNone, mostAlone,
        "refused: a shorter step is needed");
}

// --- Segments of very different length on one surface, hit softly and hard.

/// Segments in the middle of a side are shorter than the others by this factor.
TriangleMesh unevenBlock(double ratio) {
  Polygon polygon;
  const double tiny = .5 / ratio;
  polygon.outline = {{0, 0}, {.5, 0}, {.5 + tiny, 0}, {.5 + 2 * tiny, 0}, {1, 0}, {1, .5}, {0, .5}};
  return triangulate(checkPolygon(polygon), .5);
}

/// It comes down on another block, whose segments are as long as its long ones, at a part of the
/// wave speed, a micrometre away.
struct Down {
  double ratio, speed;
  int passes;
  double ofCritical = .8;
};

TimedResult fall(const Down& down) {
  World world = inPasses(down.passes);
  const double speed = down.speed * waveSpeed(rubber());
  addMoving(world, unevenBlock(down.ratio), rubber(), {0, -speed});
  addMoving(world, structuredRectangle({.1, -.5}, {.9, -1e-6}, 3, 2), rubber(), {});
  return watchFor(world, 1e-6 / speed + 3 / waveSpeed(rubber()), down.ofCritical);
}

TEST(ExtremeShape, SegmentsOfVeryDifferentLength) {
  double most = kNone;
  for (const double ratio : {1e2, 1e3, 1e4}) {
    if (ratio > 5e3 && !longRun()) continue;
    for (const int passes : {1, 2}) {
      const TimedResult result = fall({ratio, 1e-5, passes});
      EXPECT_EQ(result.refusal, "") << ratio;
      EXPECT_LE(result.deepest, passes == 1 ? 1e-6 : 1e-3 / ratio) << ratio << " " << passes;
      EXPECT_LE(result.growth, 1e-3) << ratio;
      EXPECT_TRUE(result.touched) << ratio;
    }
    most = ratio;
  }
  if (longRun())
    limit("length over length of segments on one surface", kNone, most,
          "not tried; for blows on the short ones see below");
}

/// The fastest collision (of the wave speed) that it stands; a faster one stops with a sentence,
/// and no body is ever deeper in the other than a part of the shortest segment.
double fastestCollision(double ratio, int passes) {
  double most = kNone;
  for (const double speed : {1e-4, 1e-3, .01, .1, 1.}) {
    const TimedResult result = fall({ratio, speed, passes, .5});
    const std::string what = numberText(ratio) + " " + numberText(speed);
    EXPECT_LE(result.deepest, (passes == 1 ? .5 : 4e-3) * .5 / ratio) << what;
    EXPECT_LE(result.growth, 1e-3) << what;
    EXPECT_TRUE(result.touched) << what;
    if (result.refusal.empty()) {
      most = speed;
      continue;
    }
    EXPECT_TRUE(contains(result.refusal, "is pressed to"));
    break;
  }
  return most;
}

TEST(ExtremeShape, HardBlowsOnShortSegments) {
  EXPECT_EQ(fastestCollision(10, 2),
            .1);  // faster ones need a shorter step than half the critical one
  EXPECT_EQ(fastestCollision(100, 1), .1);
  limit("closing speed onto segments 100 times as short as others, of the wave speed", kNone,
        fastestCollision(100, 2), "refused: an element that collapses needs a shorter step");
  if (!longRun()) return;
  EXPECT_EQ(fastestCollision(1e3, 1), .01);
  EXPECT_EQ(fastestCollision(1e3, 2), .01);
  limit("closing speed onto segments 10⁴ times as short as others, of the wave speed", kNone,
        fastestCollision(1e4, 2), "refused: an element that collapses needs a shorter step");
}

// --- The mechanism of the table of limits itself.

/// The first argument of each call of `limit`, which may stand on the next line.
void addNames(const std::string& text, std::set<std::string>& names) {
  const std::string call = std::string("limit") + '(';  // not to find itself
  for (std::size_t at = text.find(call); at != std::string::npos; at = text.find(call, at)) {
    at = text.find_first_not_of(" \n", at + call.size());
    if (at == std::string::npos || text[at] != '"') continue;
    names.insert(text.substr(at + 1, text.find('"', at + 1) - at - 1));
  }
}

/// A row whose test has gone would never be checked again.
TEST(LimitsTable, EveryRowIsMadeByATest) {
  std::set<std::string> made;
  for (const char* folder : {"extremes", "validation/mechanics"})
    for (const auto& file :
         std::filesystem::directory_iterator(YADEFRAG_ROOT "/tests/" + std::string(folder))) {
      if (file.path().extension() != ".cpp") continue;
      std::ifstream in(file.path());
      const std::string text{std::istreambuf_iterator<char>(in), {}};
      addNames(text, made);
    }
  std::istringstream page(pageOfLimits());
  std::set<std::string> stated;
  bool isTable = false;
  for (std::string line; std::getline(page, line);) {
    if (line.starts_with("| what | smallest |")) isTable = true;
    if (!isTable || !line.starts_with("| ") || line.starts_with("| what ")) continue;
    const std::string name = line.substr(2, line.find(" | ") - 2);
    EXPECT_TRUE(stated.insert(name).second) << name;
  }
  EXPECT_EQ(stated, made);
}

}  // namespace
}  // namespace yadefrag::test
