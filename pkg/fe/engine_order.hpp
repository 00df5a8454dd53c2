#pragma once
// Do the engines of a scene stand in an order in which all forces reach the bodies they act on.

#include <typeinfo>
#include <vector>

#include "abi/yade.hpp"

namespace yadefrag {

class EngineOrder {
 public:
  /// Throws std::invalid_argument if `solver` is there twice, or if contact forces are reset before
  /// `solver` or NewtonIntegrator has used them: momentum would be lost. Looks only where engines
  /// have changed since the last call; true if they have.
  bool require(const yade::Scene& scene, const yade::Engine& solver);

  /// Throws std::invalid_argument if the forces that `solver` puts on bodies are reset before
  /// NewtonIntegrator has used them.
  static void requireReturn(const yade::Scene& scene, const yade::Engine& solver);

 private:
  struct Place {
    const std::type_info* type;
    bool isSolver, isDead;
    bool operator==(const Place&) const = default;
  };
  bool isKnown(const yade::Scene& scene, const yade::Engine& solver) const;

  std::vector<Place> known_;
};

}  // namespace yadefrag
