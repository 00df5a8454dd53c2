#pragma once
// Memory of the geometries and physics of contacts.

#include "memory/block_memory.hpp"

namespace yadefrag {

/// Moves geometry and physics of each contact of YADE's classes ScGeom and FrictPhys together, in
/// the order of the scene's contacts, when they are scattered. Objects that anything else than the
/// contact refers to (a variable in Python) stay where they are.
class ContactMemory {
 public:
  void endStep(yade::Scene& scene);

 private:
  ScatterWatch geometries_;
};

}  // namespace yadefrag
