#pragma once
// Memory of the bodies, their states and bounds.

#include "memory/block_memory.hpp"

namespace yadefrag {

/// Moves bodies, and their states and bounds of YADE's classes State and Aabb, together, in the
/// order of the bodies, when they are scattered. Objects that anything else than the scene or the
/// body refers to stay where they are.
class BodyMemory {
 public:
  void endStep(yade::Scene& scene);

 private:
  ScatterWatch states_;
};

}  // namespace yadefrag
