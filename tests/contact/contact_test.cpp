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
    contact.correct(model, scene.surfaces, {kDt, 0, move, kShortest, before, 1, none, {}});
    before = model.nodes.position;
  }
  [[nodiscard]] const ContactRow* rowOf(SlaveMaster pair) const {
    for (const ContactRow& row : contact.rows())
      if (row.slave == pair.slave && row.master == pair.master) return &row;
    return nullptr;
  }
};

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
