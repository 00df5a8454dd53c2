#include "extremes/saved_world.hpp"

#include <boost/archive/binary_iarchive.hpp>
#include <boost/archive/binary_oarchive.hpp>

#include <sstream>
#include <vector>

#include "fe/fe_archive.hpp"
#include "publish/archive_of.hpp"

namespace yadefrag::test {

void drive(World& world) {
  const std::vector<NodeId> driven{NodeId(world.model.nodes.size() - 1)};
  world.prescribeMotion(
      driven, kHeldXY,
      {.centre = {.02, 0}, .speedX = TimeTable({0, 1e-5}, {0, -30}), .turn = TimeTable(3)});
  const std::vector<NodeId>& rim = world.surfaces.segmentNode;
  world.setPressure(std::span(rim).first(3), TimeTable({0, 1}, {10, 20}));
  world.setAbsorbing(std::span(rim).last(3));
}

World eventfulWorld(bool isDriven) {
  World world;
  world.contactSettings.passes = 2;
  for (int k = 0; k < 3; ++k) {
    const Vec2 low{.01 * k, 0};
    const TriangleMesh mesh =
        structuredRectangle(low, low + Vec2{.01, .01}, 3 + k, 3, QuadPattern::kCrossed);
    BodySpec spec = moving(mesh, {1e9, .2, 1000, false}, {30. - 30 * k, 0});
    spec.friction = .3;
    if (k < 2) spec.brittle.tensileStrength = 1e6;
    if (k == 1) spec.brittle.fractureEnergy = 20;
    if (k == 2) smoothAll(spec, mesh);
    world.addBody(mesh, spec);
  }
  if (isDriven) drive(world);
  world.setLoads(std::vector<Vec2>(world.model.nodes.size(), {1, 2}));
  const double dt = .3 * world.criticalTimeStep();
  while (world.steps < 30) world.step(dt);
  return world;
}

std::string saved(World& world, unsigned flags) {
  std::ostringstream text;
  boost::archive::binary_oarchive archive(text, flags | boost::archive::no_codecvt);
  std::vector<int> bodies(world.surfaces.entries());
  ArchiveOf any(archive);
  std::vector<Vec2> forces;
  archiveWorld(any, world, bodies, forces);
  return text.str();
}

void load(const std::string& bytes, World& world, unsigned flags) {
  std::istringstream text(bytes);
  boost::archive::binary_iarchive archive(text, flags | boost::archive::no_codecvt);
  std::vector<int> bodies;
  ArchiveOf any(archive);
  std::vector<Vec2> forces;
  archiveWorld(any, world, bodies, forces);
}

}  // namespace yadefrag::test
