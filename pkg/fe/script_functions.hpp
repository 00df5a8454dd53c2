#pragma once
// Functions of a script that the steps call: they are Python objects, and no file keeps them.

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

  /// Its number, which is never 0. To be called with Python's lock, as `keep`.
  std::uint32_t add(const yade::py::object& function);
  /// Forgets those that nothing in the world names.
  void keep(const World& world);

  /// Calls the functions of motions and pressures for the step of `dt` (s) that comes: (places of
  /// the nodes, the middle of the step in s) → bytes of a velocity (m/s) for each; time (s) → Pa.
  /// Gives nothing where there are none, or one is missing. Throws std::runtime_error with what a
  /// function raised.
  void giveValues(World& world, double dt) const;

 private:
  void giveVelocities(World& world, double dt) const;
  void givePressures(World& world) const;

  std::map<std::uint32_t, yade::py::object> functions_;
};

}  // namespace yadefrag
