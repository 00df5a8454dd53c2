#pragma once
// Functions of a script that the steps call. They are Python objects, and are not saved to files.

#include <cstdint>
#include <map>

#include "abi/yade.hpp"
#include "step/world.hpp"

namespace yadefrag {

class ScriptFunctions {
 public:
  ScriptFunctions() = default;
  ~ScriptFunctions();
  ScriptFunctions(const ScriptFunctions&) = delete;
  ScriptFunctions& operator=(const ScriptFunctions&) = delete;

  /// Returns the function's number, which is never 0. Requires Python's lock, as `keep` does.
  std::uint32_t add(const yade::py::object& function);
  /// Removes functions that are not used in the world.
  void keep(const World& world);

  /// Calls the functions of motions and pressures for the next step of `dt` (s): (positions of the
  /// nodes, middle of the step in s) → bytes of a velocity (m/s) for each; time (s) → Pa. Does
  /// nothing if there are none or one is missing. Throws std::runtime_error with the message of a
  /// function's exception.
  void giveValues(World& world, double dt) const;

 private:
  void giveVelocities(World& world, double dt) const;
  void givePressures(World& world) const;

  std::map<std::uint32_t, yade::py::object> functions_;
};

}  // namespace yadefrag
