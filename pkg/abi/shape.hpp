#pragma once
// Geometries of bodies.

#include "abi/indexable.hpp"
#include "abi/layout.hpp"
#include "abi/serializable.hpp"

namespace yade {

class BoundFunctor;
class InternalForceFunctor;

class Shape : public Serializable, public Indexable {
 public:
  shared_ptr<BoundFunctor> boundFunctor;
  shared_ptr<InternalForceFunctor> internalforcefunctor;
  Vector3r color = Vector3r::Ones();
  bool wire = false;
  bool highlight = false;

  ~Shape() override;
  string getBaseClassName(unsigned int i = 0) const override;
  int getBaseClassNumber() const override;
  string getClassName() const override;
  void pySetAttr(const string& key, const py::object& value) override;
  py::dict pyDict() const override;
  void callPostLoad() override;
  void pyRegisterClass(py::object scope) override;
#if YADEFRAG_YADE >= 202601
  virtual Real getVolume();
#endif

 protected:
  Shape() = default;
  int& modifyClassIndex() override;

 public:
  const int& getClassIndex() const override;
  const int& getBaseClassIndex(int depth) const override;
  const int& getMaxCurrentlyUsedClassIndexOfKin() const override;

 protected:
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

class Facet : public Shape {
 public:
  Vector3r ne[3];
  Real icr;
  Real vl[3];
  Vector3r vu[3];
  vector<Vector3r> vertices;
  Vector3r normal;
  Real area;
  Facet() = delete;
  ~Facet() override;
};

class Wall : public Shape {
 public:
  int sense;
  int axis;
  Wall() = delete;
  ~Wall() override;
};

}  // namespace yade
