#include "mesh/assembly.hpp"

#include <gtest/gtest.h>

#include <numeric>

#include "core/errors.hpp"
#include "meshing/structured.hpp"

namespace yadefrag {
namespace {

Component glass() {
  Component c;
  c.material = {.young = 70e9, .poisson = .2, .density = 2500};
  c.thickness = .01;
  return c;
}

Model threeBodies() {
  Model model;
  for (int i = 0; i < 3; ++i)
    appendBody(model, structuredRectangle({2. * i, 0}, {2. * i + 1, 1}, 2 + i, 3), glass());
  return model;
}

TEST(Assembly, MassIsDensityTimesAreaTimesThickness) {
  const Model model = threeBodies();
  EXPECT_NEAR(std::accumulate(model.nodes.mass.begin(), model.nodes.mass.end(), 0.), 3 * 25, 1e-9);
  Model again = model;
  lumpMasses(again);
  EXPECT_EQ(again.nodes.mass, model.nodes.mass);
}

TEST(Assembly, InverseEdgesUndoTheEdges) {
  const Model model = threeBodies();
  for (std::size_t t = 0; t < model.triangles.size(); ++t) {
    const auto& [a, b, c] = model.triangles.nodes[t];
    const auto& i = model.triangles.inverseEdges[t];
    const Vec2 d1 = model.nodes.position[b.value] - model.nodes.position[a.value];
    const Vec2 d2 = model.nodes.position[c.value] - model.nodes.position[a.value];
    EXPECT_NEAR(d1.x * i[0] + d2.x * i[2], 1, 1e-14);
    EXPECT_NEAR(d1.x * i[1] + d2.x * i[3], 0, 1e-14);
    EXPECT_NEAR(d1.y * i[0] + d2.y * i[2], 0, 1e-14);
    EXPECT_NEAR(d1.y * i[1] + d2.y * i[3], 1, 1e-14);
  }
}

TEST(Assembly, ARemovedBodyLeavesTheOthersAsTheyWere) {
  const Model before = threeBodies();
  Model model = before;
  model.nodes.load.resize(model.nodes.size(), {1, 2});
  const std::vector<NodeId> renumbered = removeBody(model, ComponentId(1));
  ASSERT_EQ(renumbered.size(), before.nodes.size());
  ASSERT_EQ(model.components.size(), 3U);
  EXPECT_EQ(model.components[1].firstTriangle, model.components[1].lastTriangle);
  std::size_t kept = 0;
  for (std::size_t n = 0; n < renumbered.size(); ++n) {
    const bool gone = before.nodes.component[n] == ComponentId(1);
    ASSERT_EQ(renumbered[n] == NodeId::none(), gone);
    if (gone) continue;
    EXPECT_EQ(renumbered[n], NodeId(kept));
    EXPECT_EQ(model.nodes.position[kept], before.nodes.position[n]);
    EXPECT_EQ(model.nodes.mass[kept], before.nodes.mass[n]);
    EXPECT_EQ(model.nodes.component[kept], before.nodes.component[n]);
    ++kept;
  }
  EXPECT_EQ(model.nodes.size(), kept);
  EXPECT_EQ(model.nodes.velocity.size(), kept);
  EXPECT_EQ(model.nodes.held.size(), kept);
  EXPECT_EQ(model.nodes.load.size(), kept);
  for (const std::uint32_t c : {0U, 2U}) {
    const Component& now = model.components[c];
    const Component& was = before.components[c];
    ASSERT_EQ(now.lastTriangle - now.firstTriangle, was.lastTriangle - was.firstTriangle);
    for (std::uint32_t t = 0; t < now.lastTriangle - now.firstTriangle; ++t) {
      EXPECT_EQ(model.triangles.component[now.firstTriangle + t], ComponentId(c));
      for (int i = 0; i < 3; ++i)
        EXPECT_EQ(model.triangles.nodes[now.firstTriangle + t][i],
                  renumbered[before.triangles.nodes[was.firstTriangle + t][i].value]);
    }
  }
  EXPECT_EQ(appendBody(model, structuredRectangle({0, 5}, {1, 6}, 2, 2), glass()), ComponentId(3));
}

TEST(Assembly, ATriangleWithoutAreaIsRefusedBeforeAnythingChanges) {
  TriangleMesh mesh = structuredRectangle({0, 0}, {1, 1}, 2, 2);
  std::swap(mesh.triangles[3][0], mesh.triangles[3][1]);
  Model model;
  EXPECT_THROW(appendBody(model, mesh, glass()), InputError);
  EXPECT_EQ(model.nodes.size(), 0U);
  EXPECT_TRUE(model.components.empty());
}

}  // namespace
}  // namespace yadefrag
