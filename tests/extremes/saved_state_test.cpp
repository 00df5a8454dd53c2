// A damaged save is refused with a sentence: cut off anywhere, or with any bit turned.

#include <gtest/gtest.h>

#include <boost/archive/binary_oarchive.hpp>

#include "extremes/limits.hpp"
#include "step/eventful_scenes.hpp"

namespace yadefrag::test {
namespace {

/// Boost writes its own signature before all that is ours.
std::size_t headerSize() {
  std::ostringstream text;
  const boost::archive::binary_oarchive archive(text, boost::archive::no_codecvt);
  return text.str().size();
}

class ExtremeSave : public ::testing::Test {
 protected:
  ExtremeSave() : world_(eventfulWorld(true)), bytes_(saved(world_)) {}
  /// Loading these gives a sentence that names the part with the error.
  static bool isRefused(const std::string& bytes) {
    World world;
    const std::string sentence = sentenceOf([&] { load(bytes, world); });
    return sentence.starts_with("The saved state of FESolver is damaged");
  }
  World world_;
  std::string bytes_;
};

/// The critical step is computed when bodies are added or the step grows, not after loading.
TEST(ExtremeSaveOf, ARunGoesOnWithTheStepItHas) {
  World world;
  const TriangleMesh mesh = structuredRectangle({}, {1, 1}, 2, 2);
  world.addBody(mesh, moving(mesh, {1e9, .2, 1000, false}, {1, 0}));
  const double dt = .999 * world.criticalTimeStep();
  world.step(dt);
  // A stiffer material, for which the step is too long.
  world.model.components[0].material.young *= 1.1;
  ASSERT_LT(world.criticalTimeStep(), dt);
  World loaded;
  load(saved(world), loaded);
  EXPECT_EQ(sentenceOf([&] { loaded.step(dt); }), "");
  EXPECT_EQ(loaded.steps, 2U);
  EXPECT_NE(sentenceOf([&] { loaded.step(1.001 * dt); }), "");
}

/// The nodes of an elastic body take the numbers of those of a brittle one.
TEST(ExtremeSaveOf, AWorldThatABrittleBodyHasLeft) {
  World world = eventfulWorld(true);
  const TriangleMesh mesh = structuredRectangle({.04, 0}, {.05, .01}, 2, 2);
  world.addBody(mesh, moving(mesh, {1e9, .2, 1000, false}, {}));
  world.removeBody(ComponentId(1));
  for (std::size_t n = 0; n < world.fracture.edges.ofNode.size(); ++n)
    if (!world.model.components[world.model.nodes.component[n].value].brittle.cracks()) {
      EXPECT_EQ(world.fracture.edges.ofNode[n], ElementId::none()) << n;
    }
  World loaded;
  EXPECT_EQ(sentenceOf([&] { load(saved(world), loaded); }), "");
}

TEST_F(ExtremeSave, CutOffAnywhereIsRefused) {
  const std::size_t step = longRun() ? 1 : 97;
  for (std::size_t size = headerSize(); size < bytes_.size(); size += step)
    ASSERT_TRUE(isRefused(bytes_.substr(0, size))) << size << " of " << bytes_.size() << " bytes";
}

/// One bit of every byte that is looked at, so that each place in a word has its turn.
TEST_F(ExtremeSave, AnyBitTurnedIsRefused) {
  const std::size_t step = longRun() ? 1 : 53;
  for (std::size_t at = headerSize(); at < bytes_.size(); at += step)
    for (int bit = longRun() ? 0 : static_cast<int>(at % 8); bit < 8; bit += longRun() ? 1 : 8) {
      std::string damaged = bytes_;
      damaged[at] = static_cast<char>(damaged[at] ^ (1 << bit));
      ASSERT_TRUE(isRefused(damaged)) << "bit " << bit << " of byte " << at;
    }
}

// --- A release build and one for debugging give the same: both are held to the same figures.

/// (relative) Both give the same bits with Debian's compiler; another one's √ and sums may round
/// otherwise, and 300 steps of contact make some hundred times that of it.
constexpr double kAgreement = 1e-12;

// Cracks, cohesion, friction, smooth surfaces, two passes.
TEST(ExtremeBuilds, DebugAndReleaseAgree) {
  World world = eventfulWorld();
  for (int i = 0; i < 300; ++i) world.step(world.lastDt);
  const Nodes& nodes = world.model.nodes;
  ASSERT_EQ(nodes.size(), 291U);
  EXPECT_EQ(world.fracture.numCracks(), 113U);
  Vec2 places;
  double speeds = 0;
  for (std::size_t n = 0; n < nodes.size(); ++n)
    places += nodes.position[n], speeds += norm(nodes.velocity[n]);
  const auto expectNear = [](double value, double wanted) {
    EXPECT_NEAR(value, wanted, kAgreement * wanted);
  };
  expectNear(places.x, 3.6430002001557953);
  expectNear(places.y, 1.4470867826392377);
  expectNear(speeds, 4588.9575169372056);
  expectNear(totalEnergy(world), 89.999577295195351);
  expectNear(world.ledger.contact, 5.4998862107108364);
}

}  // namespace
}  // namespace yadefrag::test
