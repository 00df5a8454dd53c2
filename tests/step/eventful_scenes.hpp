#pragma once
// Scenes in which everything happens that a world can do, and the bytes of all that it then is.

#include <functional>
#include <map>
#include <string>

#include "step/world.hpp"

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

}  // namespace yadefrag::test
