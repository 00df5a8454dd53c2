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

  /// Calls the functions of motions for the step of `dt` (s) that comes: (numbers of nodes, the
  /// middle of the step in s) → bytes of a velocity (m/s) for each. Leaves `givenVelocities` empty
  /// where there are none, or one is missing. Throws std::runtime_error with what a function
  /// raised.
  void giveVelocities(World& world, double dt) const;

 private:
  std::map<std::uint32_t, yade::py::object> functions_;
};

}  // namespace yadefrag
