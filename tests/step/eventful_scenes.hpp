#pragma once
// Scenes in which everything happens that a world can do, the bytes of all that it then is, and
// worlds that are saved as FESolver saves them, and loaded again.

#include <functional>
#include <map>
#include <string>

#include "step/bodies.hpp"

namespace yadefrag::test {

using State = std::map<std::string, std::string>;
using Scene = std::function<World()>;

/// By name. A step of .3 of the critical one is accepted.
std::map<std::string, Scene> scenes();

/// The bytes of everything that a world keeps and shows; rows by their members, for they have
/// padding.
State stateOf(World& world);

/// Names of what is not the same; "" if nothing.
std::string whatDiffers(const State& a, const State& b);

/// A world that is saved and loaded, with the settings that belong to no state.
World copyOf(World& world);

/// A node that moves (m/s) and turns, a pressure (Pa) that grows, a side that lets waves out.
void drive(World& world, double speed = -30, double pressure = 10);

/// Cracked, cohesive, smooth and loaded bodies in contact.
World eventfulWorld(bool isDriven = false);

/// `flags`: Boost's; no_header leaves out its own signature.
std::string saved(World& world, unsigned flags = 0);
void load(const std::string& bytes, World& world, unsigned flags = 0);

}  // namespace yadefrag::test
