#pragma once
// Functors that compute the bounds of shapes, and the geometry, the properties and the forces of
// contacts.

#include <omp.h>

#include <stdexcept>

#include "yade/engine.hpp"
#include "yade/interaction.hpp"

namespace yade {

// Second base class, at byte 80, of the functors: the table through which dispatchers call them. It
// has a slot for every number of arguments from one to seven; only one slot is used.
class CallTable {
 public:
  virtual ~CallTable() = default;
  virtual string checkOrder() const { return {}; }

 protected:
  [[noreturn]] static void unused() { throw std::logic_error("a functor's unused slot is called"); }
};

#define YADEFRAG_UNUSED_SLOTS(Result, first, second, third) \
  virtual Result first() { unused(); }                      \
  virtual Result second() { unused(); }                     \
  virtual Result third() { unused(); }

// For functors with one shape, whose call has four arguments.
template <class... Arguments>
class OneShapeCalls : public CallTable {
  YADEFRAG_UNUSED_SLOTS(void, go1, go2, go3)

 public:
  virtual void go(Arguments...) { unused(); }

 private:
  YADEFRAG_UNUSED_SLOTS(void, go5, go6, go7)
  YADEFRAG_UNUSED_SLOTS(void, goReverse1, goReverse2, goReverse3)
  YADEFRAG_UNUSED_SLOTS(void, goReverse4, goReverse5, goReverse6)
  virtual void goReverse7() { unused(); }
};

struct GLViewInfo;

using BoundCalls =
    OneShapeCalls<const shared_ptr<Shape>&, shared_ptr<Bound>&, const Se3r&, const Body*>;
using GlShapeCalls =
    OneShapeCalls<const shared_ptr<Shape>&, const shared_ptr<State>&, bool, const GLViewInfo&>;

class GeomCalls : public CallTable {
  YADEFRAG_UNUSED_SLOTS(bool, go1, go2, go3)
  YADEFRAG_UNUSED_SLOTS(bool, go4, go5, go6)

 public:
  virtual bool go(const shared_ptr<Shape>&, const shared_ptr<Shape>&, const State&, const State&,
                  const Vector3r&, const bool&, const shared_ptr<Interaction>&) {
    unused();
  }

 private:
  YADEFRAG_UNUSED_SLOTS(bool, goReverse1, goReverse2, goReverse3)
  YADEFRAG_UNUSED_SLOTS(bool, goReverse4, goReverse5, goReverse6)

 public:
  virtual bool goReverse(const shared_ptr<Shape>&, const shared_ptr<Shape>&, const State&,
                         const State&, const Vector3r&, const bool&,
                         const shared_ptr<Interaction>&) {
    unused();
  }
};

// For functors whose call has three arguments.
template <class Result, class... Arguments>
class ThreeArgumentCalls : public CallTable {
  virtual Result go1() { unused(); }
  virtual Result go2() { unused(); }

 public:
  virtual Result go(Arguments...) { unused(); }

 private:
  YADEFRAG_UNUSED_SLOTS(Result, go4, go5, go6)
  YADEFRAG_UNUSED_SLOTS(Result, go7, goReverse1, goReverse2)
  YADEFRAG_UNUSED_SLOTS(Result, goReverse3, goReverse4, goReverse5)
  virtual Result goReverse6() { unused(); }
  virtual Result goReverse7() { unused(); }
};

#undef YADEFRAG_UNUSED_SLOTS

using PhysCalls = ThreeArgumentCalls<void, const shared_ptr<Material>&, const shared_ptr<Material>&,
                                     const shared_ptr<Interaction>&>;
using LawCalls = ThreeArgumentCalls<bool, shared_ptr<IGeom>&, shared_ptr<IPhys>&, Interaction*>;

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
  YADEFRAG_YADE_FUNCTIONS;
  vector<string> getFunctorTypes() const override { return {get1DFunctorType1()}; }
  virtual string get1DFunctorType1() const { throw std::logic_error("takes no shape"); }

 protected:
  BoundFunctor() = default;
};

// Draws a shape in the 3D view.
class GlShapeFunctor : public Functor, public GlShapeCalls {
 public:
  ~GlShapeFunctor() override;
  YADEFRAG_YADE_FUNCTIONS;
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
  YADEFRAG_YADE_FUNCTIONS;
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

class Ig2_Sphere_Sphere_ScGeom6D : public Ig2_Sphere_Sphere_ScGeom {
 public:
  bool updateRotations;
  bool creep;
  Ig2_Sphere_Sphere_ScGeom6D() = delete;
  ~Ig2_Sphere_Sphere_ScGeom6D() override;
};

class Ig2_Facet_Sphere_ScGeom : public IGeomFunctor {
  const Real hertzFac = 1e8;

 public:
  Real shrinkFactor;
  bool hertzian;
  Ig2_Facet_Sphere_ScGeom() = delete;
  ~Ig2_Facet_Sphere_ScGeom() override;
};

class Ig2_Facet_Sphere_ScGeom6D : public Ig2_Facet_Sphere_ScGeom {
 public:
  Ig2_Facet_Sphere_ScGeom6D() = delete;
  ~Ig2_Facet_Sphere_ScGeom6D() override;
};

class Ig2_Wall_Sphere_ScGeom : public IGeomFunctor {
  const Real hertzFac = 1e8;

 public:
  bool noRatch;
  bool hertzian;
  Ig2_Wall_Sphere_ScGeom() = delete;
  ~Ig2_Wall_Sphere_ScGeom() override;
};

class Ig2_Box_Sphere_ScGeom : public IGeomFunctor {
#if YADEFRAG_YADE >= 202502
  const Real hertzFac = 1e8;
#endif

 public:
  Real interactionDetectionFactor;
#if YADEFRAG_YADE >= 202502
  bool hertzian;
#endif
  Ig2_Box_Sphere_ScGeom() = delete;
  ~Ig2_Box_Sphere_ScGeom() override;
};

class Ig2_Box_Sphere_ScGeom6D : public Ig2_Box_Sphere_ScGeom {
 public:
  Ig2_Box_Sphere_ScGeom6D() = delete;
  ~Ig2_Box_Sphere_ScGeom6D() override;
};

class IPhysFunctor : public Functor, public PhysCalls {
 public:
  IPhysFunctor() = delete;
  ~IPhysFunctor() override;
};

class Ip2_CohFrictMat_CohFrictMat_CohFrictPhys : public IPhysFunctor {
 public:
  int cohesionDefinitionIteration;
  bool setCohesionNow;
  bool setCohesionOnNewContacts;
  Ip2_CohFrictMat_CohFrictMat_CohFrictPhys() = delete;
  ~Ip2_CohFrictMat_CohFrictMat_CohFrictPhys() override;

 private:
#if YADEFRAG_YADE >= 202502
  alignas(8) unsigned char choices_[80];
#else
  alignas(8) unsigned char choices_[48];
#endif
};

class LawFunctor : public Functor, public LawCalls {
 public:
  LawFunctor() = delete;
  ~LawFunctor() override;
};

// A sum of each thread, in a cache line of its own.
template <class T>
class OpenMPAccumulator {
  int CLS;
  int nThreads;
  int eSize;
  char* data;

 public:
  void operator+=(const T& value) {
    *reinterpret_cast<T*>(data + omp_get_thread_num() * eSize) += value;
  }
};

class Law2_ScGeom_FrictPhys_CundallStrack : public LawFunctor {
 public:
  OpenMPAccumulator<Real> plasticDissipation;
  bool neverErase;
  bool sphericalBodies;
  bool traceEnergy;
  int plastDissipIx;
  int elastPotentialIx;
  Law2_ScGeom_FrictPhys_CundallStrack() = delete;
  ~Law2_ScGeom_FrictPhys_CundallStrack() override;
};

class Law2_ScGeom_MindlinPhys_Mindlin : public LawFunctor {
 public:
  bool includeAdhesion;
  bool calcEnergy;
  bool includeMoment;
  bool neverErase;
  bool nothing;
  Law2_ScGeom_MindlinPhys_Mindlin() = delete;
  ~Law2_ScGeom_MindlinPhys_Mindlin() override;

 private:
  alignas(8) unsigned char energies_[96];
};

class Law2_ScGeom6D_CohFrictPhys_CohesionMoment : public LawFunctor {
 public:
  OpenMPAccumulator<Real> plasticDissipation;
  bool neverErase;
  bool always_use_moment_law;
  bool shear_creep;
  bool twist_creep;
  bool traceEnergy;
  bool useIncrementalForm;
  int shearDissipIx;
#if YADEFRAG_YADE >= 202502
  int normalDissipIx;
#endif
  int bendingDissipIx;
  int twistDissipIx;
#if YADEFRAG_YADE >= 202502
  bool consistencyCheck;
#endif
  Real creep_viscosity;
#if YADEFRAG_YADE >= 202502
  void checkConsistency(const shared_ptr<CohFrictPhys> phys, int id1, int id2) const;
#endif
  Law2_ScGeom6D_CohFrictPhys_CohesionMoment() = delete;
  ~Law2_ScGeom6D_CohFrictPhys_CohesionMoment() override;
};

class Law2_ScGeom_ViscElPhys_Basic : public LawFunctor {
 public:
  Law2_ScGeom_ViscElPhys_Basic() = delete;
  ~Law2_ScGeom_ViscElPhys_Basic() override;
};

}  // namespace yade
