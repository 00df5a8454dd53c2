// Walls of blocks that touch exactly, in our contact and in Box2D's: time per contact and step, and
// the deepest overlap that remains.
//
//   yadefrag_walls ours|Box2D BLOCKS STEPS ITERATIONS
//
// One JSON object to standard output. BLOCKS are those in a row, and the rows. ITERATIONS are
// Box2D's velocity iterations (of its position iterations three eighths, as in its manual), or the
// passes of our contact (1 or 2).
#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <utility>
#include <vector>

#ifdef YADEFRAG_BOX2D
#include <box2d/box2d.h>
#endif

#include "step/blocks.hpp"
#include "step/overlap_depth.hpp"

namespace yadefrag {
namespace {

struct Figures {
  double contacts = 0;  ///< per step
  double step = 0;      ///< s
  double contact = 0;   ///< s, per step, of contact alone
  double depth = 0;     ///< of a block's side
};

double now() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

Figures measureOurs(int blocks, int steps, int passes) {
  World world;
  world.contactSettings.passes = passes;
  test::addBlockWall(world, {blocks});
  const double dt = .8 * world.criticalTimeStep();
  world.timing = true;
  Figures figures;
  const double start = now();
  for (int i = 0; i < steps; ++i) {
    world.step(dt);
    figures.contacts += static_cast<double>(world.contact.rows().size()) / steps;
  }
  figures.step = (now() - start) / steps;
  figures.contact = world.times.contact() / steps;
  figures.depth = deepestOverlap(world.model) / test::kBlockSide;
  return figures;
}

#ifdef YADEFRAG_BOX2D

/// Lengths times ten: Box2D expects things of some metres.
constexpr double kScale = 10;

void addBlocks(b2World& world, int blocks) {
  bool isFloor = true;
  for (const std::vector<Vec2>& outline : test::blockOutlines({blocks})) {
    std::vector<b2Vec2> corners;
    corners.reserve(outline.size());
    for (const Vec2 corner : outline)
      corners.emplace_back(static_cast<float>(kScale * corner.x),
                           static_cast<float>(kScale * corner.y));
    b2PolygonShape shape;
    shape.Set(corners.data(), static_cast<int>(corners.size()));
    shape.m_radius = 0;  // otherwise blocks would be larger by a skin of 1 % of a side
    b2BodyDef body;
    body.type = isFloor ? b2_staticBody : b2_dynamicBody;
    body.allowSleep = false;
    b2FixtureDef fixture;
    fixture.shape = &shape;
    fixture.density = 2500;
    fixture.friction = .5f;
    world.CreateBody(&body)->CreateFixture(&fixture);
    isFloor = false;
  }
}

/// Number of points at which Box2D's bodies touch, and the deepest of them (m).
std::pair<int, double> pointsOf(b2World& world) {
  int count = 0;
  double deepest = 0;
  for (const b2Contact* contact = world.GetContactList(); contact != nullptr;
       contact = contact->GetNext()) {
    if (!contact->IsTouching()) continue;
    b2WorldManifold manifold;
    contact->GetWorldManifold(&manifold);
    const int points = contact->GetManifold()->pointCount;
    count += points;
    for (int k = 0; k < points; ++k)
      deepest = std::max(deepest, -static_cast<double>(manifold.separations[k]));
  }
  return {count, deepest};
}

Figures measureBox2d(int blocks, int steps, int iterations) {
  b2World world({0, -9.81f});
  addBlocks(world, blocks);
  Figures figures;
  double elapsed = 0;
  for (int i = 0; i < steps; ++i) {
    const double start = now();
    world.Step(1 / 60.f, iterations, std::max(1, 3 * iterations / 8));
    elapsed += now() - start;
    const auto [count, deepest] = pointsOf(world);
    figures.contacts += static_cast<double>(count) / steps;
    figures.depth = deepest / (kScale * test::kBlockSide);
  }
  figures.step = figures.contact = elapsed / steps;
  return figures;
}

#endif

}  // namespace
}  // namespace yadefrag

int main(int count, char** words) {
  using namespace yadefrag;
  if (count != 5) {
    std::fprintf(stderr, "yadefrag_walls takes: ours|Box2D BLOCKS STEPS ITERATIONS\n");
    return 2;
  }
  const std::string solver = words[1];
  const int blocks = std::atoi(words[2]), steps = std::atoi(words[3]), most = std::atoi(words[4]);
  Figures figures;
  if (solver == "ours") figures = measureOurs(blocks, steps, most);
#ifdef YADEFRAG_BOX2D
  else if (solver == "Box2D")
    figures = measureBox2d(blocks, steps, most);
#endif
  else {
    std::fprintf(stderr, "yadefrag_walls has no solver '%s' here.\n", words[1]);
    return 3;
  }
  std::printf("{\"contacts\": %.6g, \"step\": %.6g, \"contact\": %.6g, \"depth\": %.6g}\n",
              figures.contacts, figures.step, figures.contact, figures.depth);
  return 0;
}
