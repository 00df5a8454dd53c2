#pragma once

#include <map>

#include "abi/bound.hpp"
#include "abi/material.hpp"
#include "abi/shape.hpp"
#include "abi/state.hpp"

namespace yade {

class Interaction;
class Scene;

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
  virtual void userForcedDisplacementRedrawHook();

  static const shared_ptr<Body>& byId(id_t id, Scene* scene = nullptr);
  static const shared_ptr<Body>& byId(id_t id, shared_ptr<Scene> scene);

  id_t getId() const { return id; }
  mask_t getGroupMask() const { return groupMask; }
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
  void updateRealBodies();
};

}  // namespace yade
