#pragma once
// Interactions, and what they consist of: the geometry of a contact as YADE's laws for spheres use
// it, and the forces as its laws with a normal and a shear part compute them.

#include "yade/body.hpp"

namespace yade {

class IGeomFunctor;
class IPhysFunctor;
class LawFunctor;
class Scene;

class IGeom : public Serializable, public Indexable {
 public:
  IGeom() = delete;
  ~IGeom() override;
  YADEFRAG_INDEX_FUNCTIONS;
};

class GenericSpheresContact : public IGeom {
 public:
  Vector3r normal;
  Vector3r contactPoint;
  Real refR1;
  Real refR2;

  GenericSpheresContact() = delete;
  ~GenericSpheresContact() override;
};

class ScGeom : public GenericSpheresContact {
  Vector3r twist_axis;
  Vector3r orthonormal_axis;

 public:
  Real& radius1;
  Real& radius2;
  Real penetrationDepth;
  Vector3r shearInc;

  ScGeom();
  ~ScGeom() override;
  void precompute(const State& state1, const State& state2, const Scene* scene,
                  const shared_ptr<Interaction>& contact, const Vector3r& currentNormal, bool isNew,
                  const Vector3r& shift2, bool avoidGranularRatcheting = true);

 private:
  friend struct LayoutProbe;
};

class ScGeom6D : public ScGeom {
 public:
  Quaternionr initialOrientation1;
  Quaternionr initialOrientation2;
  Quaternionr twistCreep;
  Real twist;
  Vector3r bending;

  ScGeom6D();
  ~ScGeom6D() override;
};

class IPhys : public Serializable, public Indexable {
 public:
  IPhys() = delete;
  ~IPhys() override;
  YADEFRAG_INDEX_FUNCTIONS;
};

class NormPhys : public IPhys {
 public:
  Real kn;
  Vector3r normalForce;

  NormPhys() = delete;
  ~NormPhys() override;
};

// Force on the second body; the first one gets the opposite force.
class NormShearPhys : public NormPhys {
 public:
  Real ks;
  Vector3r shearForce;

  NormShearPhys() = delete;
  ~NormShearPhys() override;
};

class FrictPhys : public NormShearPhys {
 public:
  Real tangensOfFrictionAngle;
#if YADEFRAG_YADE >= 202601
  Real frictDissip;
#endif

  FrictPhys();
  ~FrictPhys() override;
};

class RotStiffFrictPhys : public FrictPhys {
 public:
  Real kr;
  Real ktw;

  RotStiffFrictPhys() = delete;
  ~RotStiffFrictPhys() override;
};

class MindlinPhys : public RotStiffFrictPhys {
 public:
  Real kno;
  Real kso;
  Real maxBendPl;
  Vector3r normalViscous;
  Vector3r shearViscous;
  Vector3r shearElastic;
  Vector3r usElastic;
  Vector3r usTotal;
  Vector3r momentBend;
  Vector3r momentTwist;
  Real radius;
  Real adhesionForce;
  bool isAdhesive;
  bool isSliding;
  Real betan;
  Real betas;
#if YADEFRAG_YADE >= 202502
  Real beta;
#endif
  Vector3r prevU;
  Eigen::Matrix<Real, 2, 1> Fs;
#if YADEFRAG_YADE < 202502  // the feature PARTIALSAT
  Real initD;
  bool isBroken;
#endif

  MindlinPhys();
  ~MindlinPhys() override;
};

class CohFrictPhys : public RotStiffFrictPhys {
 public:
  bool cohesionDisablesFriction;
  bool cohesionBroken;
  bool fragile;
  Real maxRollPl;
  Real maxTwistPl;
  Real normalAdhesion;
  Real shearAdhesion;
#if YADEFRAG_YADE >= 202502
  Real rollingAdhesion;
  Real twistingAdhesion;
#endif
  Real unp;
  Real unpMax;
  bool momentRotationLaw;
  bool initCohesion;
  Real creep_viscosity;
  Vector3r moment_twist;
  Vector3r moment_bending;

  CohFrictPhys();
  ~CohFrictPhys() override;
};

class ViscElPhys : public FrictPhys {
 public:
  Real R;
  Real cn;
  Real cs;
  Real Fn;
  Real Fv;
  Real mR;
  unsigned mRtype;

  ViscElPhys();
  ~ViscElPhys() override;
};

class Interaction : public Serializable {
 public:
  bool isActive;
  struct {
    bool geomExists;
    shared_ptr<IGeomFunctor> geom;
    shared_ptr<IPhysFunctor> phys;
    shared_ptr<LawFunctor> constLaw;
  } functorCache;
  Body::id_t id1;
  Body::id_t id2;
  long iterMadeReal;
  long iterLastSeen;
  shared_ptr<IGeom> geom;
  shared_ptr<IPhys> phys;
  Vector3i cellDist;
  int linIx;
  long iterBorn;

  Interaction();
  Interaction(Body::id_t id1, Body::id_t id2);
  ~Interaction() override;

  bool isReal() const { return geom && phys; }
  const Body::id_t& getId1() const { return id1; }
  const Body::id_t& getId2() const { return id2; }
  void swapOrder();
  void reset();
};

class InteractionContainer : public Serializable {
  using ContainerT = vector<shared_ptr<Interaction>>;
  ContainerT linIntrs;
  ContainerT sortedIntrs;
  const vector<shared_ptr<Body>>* bodies;
  std::size_t currSize;
  shared_ptr<Interaction> empty;
  ContainerT interaction;

 public:
  using iterator = ContainerT::iterator;
  using const_iterator = ContainerT::const_iterator;

  bool dirty;
  std::mutex drawloopmutex;
  bool serializeSorted;
  long iterColliderLastRun;

  InteractionContainer() = delete;
  ~InteractionContainer() override;

  iterator begin() { return linIntrs.begin(); }
  iterator end() { return linIntrs.end(); }
  const_iterator begin() const { return linIntrs.begin(); }
  const_iterator end() const { return linIntrs.end(); }
  std::size_t size() { return currSize; }
  shared_ptr<Interaction>& operator[](std::size_t i) { return linIntrs[i]; }
  const shared_ptr<Interaction>& operator[](std::size_t i) const { return linIntrs[i]; }

  bool insert(Body::id_t id1, Body::id_t id2);
  bool insert(const shared_ptr<Interaction>& interaction);
  // linPos must be the interaction's linIx: the package is built with assertions that require it.
  bool erase(Body::id_t id1, Body::id_t id2, int linPos = -1);
  const shared_ptr<Interaction>& find(Body::id_t id1, Body::id_t id2);

 private:
  friend struct LayoutProbe;  // layout_checks.cpp checks the private members, too
};

}  // namespace yade
