#pragma once
// Memory of the states and bounds of bodies.

#include "memory/block_memory.hpp"

namespace yadefrag {

/// Moves states and bounds of all bodies of YADE's classes State and Aabb together, in the order of
/// the bodies, when they are scattered. Objects that anything else than the body refers to stay
/// where they are.
class BodyMemory {
 public:
  void endStep(yade::Scene& scene);

 private:
  ScatterWatch states_;
};

}  // namespace yadefrag
