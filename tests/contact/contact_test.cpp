// All of contact in one step: what it keeps from the step before.

#include "contact/contact.hpp"

#include <gtest/gtest.h>

#include <string>

#include "contact/contact_scenes.hpp"
#include "core/errors.hpp"

namespace yadefrag::test {
namespace {

/// Surfaces with masses, and the data of a step.
struct ContactScene {
  SurfaceScene scene;
  Model model;
  Contact contact;
  std::vector<Vec2> before;
  double move = .05;  ///< m

  void build(double friction, std::vector<SlaveMaster> pairs) {
    model.nodes = plainNodes(scene.at.size());
    model.nodes.position = before = scene.at;
    model.components.resize(scene.components);
    for (Component& component : model.components) component.friction = friction;
    replaceCandidates(contact.candidates, pairs);
  }
  void hold(EntryId first, std::size_t count) {
    for (std::size_t k = 0; k < count; ++k) model.nodes.held[nodeOf(first + k)] = kHeldXY;
  }
  [[nodiscard]] std::uint32_t nodeOf(EntryId entry) const {
    return scene.surfaces.slave(entry).node[0].value;
  }
  /// From where the nodes were at the end of the last step, and where they have been put since.
  void correct() {
    constexpr double kDt = 1, kShortest = 1;
    const RigidMasses none;
    contact.correct(model, scene.surfaces,
                    {kDt, 0, move, 2 * move, kShortest, 1, before, 1, none, {}});
    before = model.nodes.position;
  }
  [[nodiscard]] const ContactRow* rowOf(SlaveMaster pair) const {
    for (const ContactRow& row : contact.rows())
      if (row.slave == pair.slave && row.master == pair.master) return &row;
    return nullptr;
  }
};

/// Two roofs whose tips have passed each other: each is under the other's slope, and both rows push
/// upwards. Neither has friction, and what they held by friction in the step before is over.
TEST(Contact, RowsThatOpposeEachOtherHaveNoFriction) {
  ContactScene s;
  const EntryId a = s.scene.addBody({{.1, 0}, {-1, .15}, {-1, -.2}});
  const EntryId b = s.scene.addBody({{-.1, 0}, {1, -.2}, {1, .15}});
  const SlaveMaster first{a, b + 2}, second{b, a};
  s.build(.5, {first, second});
  s.contact.touches = {{first, 1, .4, 0}, {second, 1, .4, 0}};
  s.correct();
  ASSERT_NE(s.rowOf(first), nullptr);
  ASSERT_NE(s.rowOf(second), nullptr);
  for (const SlaveMaster& pair : {first, second}) {
    EXPECT_EQ(s.rowOf(pair)->friction, 0);
    EXPECT_EQ(s.rowOf(pair)->tangentForce, 0);
  }
  for (const Touch& touch : s.contact.touches) EXPECT_EQ(touch.tangentForce, 0);
}

/// A light corner that one row throws far and the next one brings back, and a needle that comes
/// down on the side of it. In the second scan that side is far away; the needle must be detected
/// all the same when it arrives, in the same step as if no row were skipped.
int stepsUntilTouch(bool skips) {
  ContactScene s;
  const EntryId body = s.scene.addBody({{0, 0}, {9, -1}, {10, 0}});
  const EntryId floor = s.scene.addBody({{-5, -5}, {.01, -5}, {.01, -.05}, {-5, -.05}});
  const EntryId pressing = s.scene.addNeedle({0, -1}), coming = s.scene.addNeedle({0, -1});
  s.scene.moveNeedle(pressing, {9.5, 0});
  s.scene.moveNeedle(coming, {.5, .2});
  const SlaveMaster arrival{coming, body + 2};
  s.build(0, {{pressing, body + 2}, {body, floor + 2}, arrival});
  s.hold(floor, 4), s.hold(pressing, 3);
  s.model.nodes.mass[s.nodeOf(body)] = 1e-6;
  s.model.nodes.mass[s.nodeOf(coming)] = 1e-9;
  for (std::size_t k = 0; k < 3; ++k) s.model.nodes.position[s.nodeOf(pressing + k)].y -= .1;
  for (int step = 0; step < 40; ++step) {
    if (!skips) s.contact.candidates.idleDistance.clear();
    s.correct();
    if (s.rowOf(arrival)) return step;
    for (std::size_t k = 0; k < 3; ++k) s.model.nodes.position[s.nodeOf(coming + k)].y -= s.move;
  }
  return -1;
}

TEST(Contact, NoRowIsSkippedTooLongAfterAStepWithTwoScans) {
  const int wanted = stepsUntilTouch(false);
  EXPECT_GT(wanted, 3);
  EXPECT_EQ(stepsUntilTouch(true), wanted);
}

/// A push beside a corner so light that it would be thrown over many segments.
TEST(Contact, ACorrectionOfManySegmentsIsRefused) {
  ContactScene s;
  const EntryId body = s.scene.addBody({{0, 0}, {9, -1}, {10, 0}});
  const EntryId pressing = s.scene.addNeedle({0, -1});
  s.scene.moveNeedle(pressing, {9.96, 0});
  s.build(0, {{pressing, body + 2}});
  s.hold(pressing, 3);
  s.model.nodes.mass[s.nodeOf(body)] = 1e-9;
  s.move = .1;
  for (std::size_t k = 0; k < 3; ++k) s.model.nodes.position[s.nodeOf(pressing + k)].y -= .1;
  try {
    s.correct();
    FAIL() << "it is thrown by 25 m, and a segment is 1 m long";
  } catch (const RunError& error) {
    EXPECT_NE(std::string(error.what()).find("contact moves a surface node"), std::string::npos);
  }
}

}  // namespace
}  // namespace yadefrag::test
