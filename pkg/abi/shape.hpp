#pragma once
// Geometries of bodies.

#include "abi/indexable.hpp"
#include "abi/serializable.hpp"

namespace yade {

class BoundFunctor;
class InternalForceFunctor;

class Shape : public Serializable, public Indexable {
 public:
  shared_ptr<BoundFunctor> boundFunctor;
  shared_ptr<InternalForceFunctor> internalforcefunctor;
  Vector3r color;
  bool wire;
  bool highlight;

  Shape() = delete;
  ~Shape() override;
  const int& getClassIndex() const override;
  const int& getBaseClassIndex(int depth) const override;
  const int& getMaxCurrentlyUsedClassIndexOfKin() const override;

 protected:
  int& modifyClassIndex() override;
  void incrementMaxCurrentlyUsedClassIndexOfKin() override;
};

class Sphere : public Shape {
 public:
  Real radius;
  Sphere() = delete;
  ~Sphere() override;
};

class Box : public Shape {
 public:
  Vector3r extents;
  Box() = delete;
  ~Box() override;
};

class Wall : public Shape {
 public:
  int sense;
  int axis;
  Wall() = delete;
  ~Wall() override;
};

}  // namespace yade
