#pragma once
// Functors that make the bounds of shapes.

#include "abi/body.hpp"
#include "abi/timing.hpp"

namespace yade {

class Functor : public Serializable {
 public:
  shared_ptr<TimingDeltas> timingDeltas;
  Scene* scene;
  string label;

  Functor() = delete;
  ~Functor() override;
  virtual vector<string> getFunctorTypes() const;
};

// YADE puts two templates in between; the call table of the second one sits at byte 80.
class BoundFunctor : public Functor {
  void* callTable_;

 public:
  BoundFunctor() = delete;
  ~BoundFunctor() override;
};

class Bo1_Sphere_Aabb : public BoundFunctor {
 public:
  Real aabbEnlargeFactor;
  Bo1_Sphere_Aabb() = delete;
  ~Bo1_Sphere_Aabb() override;
};

}  // namespace yade
