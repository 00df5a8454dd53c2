#pragma once
// Bodies, and what they consist of: state, bound, material, shape.

#include <map>
#include <mutex>

#include "yade/layout.hpp"
#include "yade/serializable.hpp"

namespace yade {

class BoundFunctor;
class Interaction;
class InternalForceFunctor;

template <class Scalar>
class Se3 {
 public:
  Eigen::Matrix<Scalar, 3, 1> position;
  Eigen::Quaternion<Scalar> orientation;
};
using Se3r = Se3<Real>;

class State : public Serializable, public Indexable {
 public:
  enum { DOF_NONE = 0, DOF_X = 1, DOF_Y = 2, DOF_Z = 4, DOF_RX = 8, DOF_RY = 16, DOF_RZ = 32 };
  static const unsigned DOF_ALL = 63;

  Vector3r& pos;
  Quaternionr& ori;
  std::mutex updateMutex;
  Se3r se3;
  Vector3r vel;
  Real mass;
  Vector3r angVel;
  Vector3r angMom;
  Vector3r inertia;
  Vector3r refPos;
  Quaternionr refOri;
  unsigned blockedDOFs;
  bool isDamped;
  Real densityScaling;

  State();
  ~State() override;
  YADEFRAG_INDEX_FUNCTIONS;
};

// Bounding boxes of bodies; their corners are in the unsheared coordinates of a periodic cell.
class Bound : public Serializable, public Indexable {
 public:
  int lastUpdateIter;
  Vector3r refPos;
  Real sweepLength;
  Vector3r color;
  Vector3r min;
  Vector3r max;

  Bound() = delete;
  ~Bound() override;
  YADEFRAG_INDEX_FUNCTIONS;
};

class Aabb : public Bound {
 public:
  Aabb();
  ~Aabb() override;
  const int& getClassIndex() const override;
  const int& getBaseClassIndex(int depth) const override;

 protected:
  int& modifyClassIndex() override;
};

class Material : public Serializable, public Indexable {
 public:
  int id;
  string label;
  Real density;

  Material() = delete;
  ~Material() override;
  virtual shared_ptr<State> newAssocState() const;
  virtual bool stateTypeOk(State* state) const;
  YADEFRAG_INDEX_FUNCTIONS;
};

class ElastMat : public Material {
 public:
  Real young;
  Real poisson;

  ElastMat() = delete;
  ~ElastMat() override;
};

class FrictMat : public ElastMat {
 public:
  Real frictionAngle;

  FrictMat();
  ~FrictMat() override;
  YADEFRAG_YADE_FUNCTIONS;
  const int& getClassIndex() const override;
  const int& getBaseClassIndex(int depth) const override;

 protected:
  int& modifyClassIndex() override;
};

class Shape : public Serializable, public Indexable {
 public:
  shared_ptr<BoundFunctor> boundFunctor;
  shared_ptr<InternalForceFunctor> internalforcefunctor;
  Vector3r color = Vector3r::Ones();
  bool wire = false;
  bool highlight = false;

  ~Shape() override;
  YADEFRAG_YADE_FUNCTIONS;
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

class Clump : public Shape {
 public:
  using MemberMap = std::map<int, Se3r>;
  MemberMap members;
#if YADEFRAG_YADE < 202502
  vector<int> ids;
#endif
  Clump() = delete;
  ~Clump() override;
};

class Body : public Serializable {
 public:
  using id_t = int;
  using MapId2IntrT = std::map<id_t, shared_ptr<Interaction>>;
  enum { FLAG_BOUNDED = 1, FLAG_ASPHERICAL = 2, FLAG_SUBDOMAIN = 4, FLAG_FLUIDDOMAINBBOX = 8 };
  static const id_t ID_NONE;

  id_t id;
  mask_t groupMask;
  int flags;
  int subdomain;
  shared_ptr<Material> material;
  shared_ptr<State> state;
  shared_ptr<Shape> shape;
  shared_ptr<Bound> bound;
  MapId2IntrT intrs;
  id_t clumpId;
  long iterBorn;
  Real timeBorn;

  Body();
  ~Body() override;

  id_t getId() const { return id; }
  bool isBounded() const { return (flags & FLAG_BOUNDED) != 0; }
  bool getIsSubdomain() const { return (flags & FLAG_SUBDOMAIN) != 0; }
  bool getIsFluidDomainBbox() const { return (flags & FLAG_FLUIDDOMAINBBOX) != 0; }
  bool isStandalone() const { return clumpId == ID_NONE; }
  bool isClump() const { return !isStandalone() && clumpId == id; }
  bool isClumpMember() const { return !isStandalone() && clumpId != id; }
  bool isDynamic() const { return state->blockedDOFs != State::DOF_ALL; }
};

class BodyContainer : public Serializable {
  using ContainerT = vector<shared_ptr<Body>>;

 public:
  ContainerT body;
  bool dirty;
  bool checkedByCollider;
  vector<Body::id_t> insertedBodies;
  vector<Body::id_t> erasedBodies;
  vector<Body::id_t> realBodies;
  bool useRedirection;
  bool enableRedirection;
  vector<Body::id_t> subdomainBodies;
  std::mutex drawloopmutex;

  BodyContainer() = delete;
  ~BodyContainer() override;

  std::size_t size() const;
  shared_ptr<Body>& operator[](unsigned int id);
  const shared_ptr<Body>& operator[](unsigned int id) const;
  bool exists(Body::id_t id) const;
  // Both act on the scene of `O`.
  Body::id_t insert(shared_ptr<Body> body);
  bool erase(Body::id_t id, bool eraseClumpMembers);
};

}  // namespace yade
