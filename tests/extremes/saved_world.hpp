#pragma once
// A world that has everything a state can hold, saved as FESolver saves it, and loaded again.

#include <string>

#include "step/bodies.hpp"

namespace yadefrag::test {

/// A node that moves and turns, a pressure that grows, a side that lets waves out.
void drive(World& world);

/// Cracked, cohesive, smooth and loaded bodies in contact.
World eventfulWorld(bool isDriven = false);

/// `flags`: Boost's; no_header leaves out its own signature.
std::string saved(World& world, unsigned flags = 0);
void load(const std::string& bytes, World& world, unsigned flags = 0);

}  // namespace yadefrag::test
