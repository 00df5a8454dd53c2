#pragma once
// Checks the order of a scene's engines: all forces must act on their bodies before they are reset.

#include <typeinfo>
#include <vector>

#include "abi/yade.hpp"

namespace yadefrag {

class EngineOrder {
 public:
  /// Throws std::invalid_argument if `solver` is in O.engines twice, or if contact forces are reset
  /// before `solver` or NewtonIntegrator has used them: momentum would be lost. Checks only if
  /// engines have changed since the last call; returns true in that case.
  bool require(const yade::Scene& scene, const yade::Engine& solver);
  /// True if NewtonIntegrator used the forces of InteractionLoop before `solver`, in the engines of
  /// the last `require`.
  [[nodiscard]] bool spheresMoveFirst() const { return spheresMoveFirst_; }

  /// Throws std::invalid_argument if the forces of `solver` on rigid bodies are reset within the
  /// step, or, if any of these is movable, before NewtonIntegrator has used them, or never.
  static void requireReturn(const yade::Scene& scene, const yade::Engine& solver, bool anyMovable);

 private:
  struct Item {
    const std::type_info* type;
    bool isSolver, isDead;
    bool operator==(const Item&) const = default;
  };

  std::vector<Item> checked_;  // the engines of the last `require`
  bool spheresMoveFirst_ = false;
};

}  // namespace yadefrag
