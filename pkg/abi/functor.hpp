#pragma once
// Functors that compute the bounds of shapes, and the geometry, the properties and the forces of
// contacts.

#include <stdexcept>

#include "abi/functor_calls.hpp"
#include "abi/interaction.hpp"
#include "abi/timing.hpp"

namespace yade {

class Functor : public Serializable {
 public:
  shared_ptr<TimingDeltas> timingDeltas;
  Scene* scene = nullptr;
  string label;

  ~Functor() override;
  virtual vector<string> getFunctorTypes() const;

 protected:
  Functor() = default;
};

// YADE has a template between these classes. It adds the call table at byte 80 and the names of the
// types that a functor accepts.
class BoundFunctor : public Functor, public BoundCalls {
 public:
  ~BoundFunctor() override;
  string getBaseClassName(unsigned int i = 0) const override;
  int getBaseClassNumber() const override;
  string getClassName() const override;
  void pySetAttr(const string& key, const py::object& value) override;
  py::dict pyDict() const override;
  void callPostLoad() override;
  void pyRegisterClass(py::object scope) override;
  vector<string> getFunctorTypes() const override { return {get1DFunctorType1()}; }
  virtual string get1DFunctorType1() const { throw std::logic_error("takes no shape"); }

 protected:
  BoundFunctor() = default;
};

// Draws a shape in the 3D view.
class GlShapeFunctor : public Functor, public GlShapeCalls {
 public:
  ~GlShapeFunctor() override;
  string getBaseClassName(unsigned int i = 0) const override;
  int getBaseClassNumber() const override;
  string getClassName() const override;
  void pySetAttr(const string& key, const py::object& value) override;
  py::dict pyDict() const override;
  void callPostLoad() override;
  void pyRegisterClass(py::object scope) override;
  vector<string> getFunctorTypes() const override { return {get1DFunctorType1()}; }
  virtual string get1DFunctorType1() const { throw std::logic_error("takes no shape"); }
  virtual string renders() const;
  virtual void initgl();

 protected:
  GlShapeFunctor() = default;
};

class Bo1_Sphere_Aabb : public BoundFunctor {
 public:
  Real aabbEnlargeFactor;
  Bo1_Sphere_Aabb() = delete;
  ~Bo1_Sphere_Aabb() override;
};

class IGeomFunctor : public Functor, public GeomCalls {
 public:
  ~IGeomFunctor() override;
  string getBaseClassName(unsigned int i = 0) const override;
  int getBaseClassNumber() const override;
  string getClassName() const override;
  void pySetAttr(const string& key, const py::object& value) override;
  py::dict pyDict() const override;
  void callPostLoad() override;
  void pyRegisterClass(py::object scope) override;
  vector<string> getFunctorTypes() const override {
    return {get2DFunctorType1(), get2DFunctorType2()};
  }
  virtual string get2DFunctorType1() const { throw std::logic_error("takes no shapes"); }
  virtual string get2DFunctorType2() const { throw std::logic_error("takes no shapes"); }
  virtual void preStep();

 protected:
  IGeomFunctor() = default;
};

class Ig2_Sphere_Sphere_ScGeom : public IGeomFunctor {
 public:
  Real interactionDetectionFactor;
  bool avoidGranularRatcheting;
  Ig2_Sphere_Sphere_ScGeom() = delete;
  ~Ig2_Sphere_Sphere_ScGeom() override;
};

class IPhysFunctor : public Functor, public PhysCalls {
 public:
  IPhysFunctor() = delete;
  ~IPhysFunctor() override;
};

class LawFunctor : public Functor, public LawCalls {
 public:
  LawFunctor() = delete;
  ~LawFunctor() override;
};

class Law2_ScGeom_FrictPhys_CundallStrack : public LawFunctor {
  alignas(8) unsigned char plasticDissipation_[24];

 public:
  bool neverErase;
  bool sphericalBodies;
  bool traceEnergy;
  int plastDissipIx;
  int elastPotentialIx;
  Law2_ScGeom_FrictPhys_CundallStrack() = delete;
  ~Law2_ScGeom_FrictPhys_CundallStrack() override;
};

}  // namespace yade
