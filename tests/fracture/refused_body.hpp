#pragma once
// A body that is refused leaves the world empty.

#include <gtest/gtest.h>

#include <string>

#include "core/errors.hpp"
#include "step/bodies.hpp"

namespace yadefrag::test {

inline void expectRefused(const TriangleMesh& mesh, const BodySpec& spec, const char* part) {
  World world;
  try {
    world.addBody(mesh, spec);
    FAIL() << part;
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find(part), std::string::npos) << error.what();
  }
  EXPECT_EQ(world.model.nodes.size(), 0);
  EXPECT_EQ(world.fracture.edges.size(), 0);
}

}  // namespace yadefrag::test
