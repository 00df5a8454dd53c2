#pragma once
// The loop over interactions, with its three dispatchers.

#include <list>
#include <utility>

#include "abi/contact_geometry.hpp"
#include "abi/contact_physics.hpp"
#include "abi/dispatcher.hpp"

namespace yade {

class IntrCallback : public Serializable {
 public:
  using FuncPtr = void (*)(IntrCallback*, Interaction*);
  Scene* scene;
  IntrCallback() = delete;
  ~IntrCallback() override;
  virtual FuncPtr stepInit();
};

class IGeomDispatcher : public Dispatcher2D<IGeomFunctor, Shape, Shape> {
  bool alreadyWarnedNoCollider;

 public:
  vector<shared_ptr<IGeomFunctor>> functors;
  IGeomDispatcher() = delete;
  ~IGeomDispatcher() override;

 private:
  friend struct LayoutProbe;
};

class IPhysDispatcher : public Dispatcher2D<IPhysFunctor, Material, Material> {
 public:
  vector<shared_ptr<IPhysFunctor>> functors;
  IPhysDispatcher() = delete;
  ~IPhysDispatcher() override;
};

class LawDispatcher : public Dispatcher2D<LawFunctor, IGeom, IPhys> {
 public:
  vector<shared_ptr<LawFunctor>> functors;
  LawDispatcher() = delete;
  ~LawDispatcher() override;
};

class InteractionLoop : public GlobalEngine {
  bool alreadyWarnedNoCollider;
  vector<std::list<std::pair<Body::id_t, Body::id_t>>> eraseAfterLoopIds;

 public:
  shared_ptr<IGeomDispatcher> geomDispatcher;
  shared_ptr<IPhysDispatcher> physDispatcher;
  shared_ptr<LawDispatcher> lawDispatcher;
  vector<shared_ptr<IntrCallback>> callbacks;
  bool loopOnSortedInteractions;
#if YADEFRAG_YADE >= 202601
  bool warnRoleIg2;
#endif

  InteractionLoop();
  ~InteractionLoop() override;
  string getBaseClassName(unsigned int i = 0) const override;
  int getBaseClassNumber() const override;
  string getClassName() const override;
  void pySetAttr(const string& key, const py::object& value) override;
  py::dict pyDict() const override;
  void callPostLoad() override;
  void pyRegisterClass(py::object scope) override;
  void pyHandleCustomCtorArgs(py::tuple& args, py::dict& kw) override;
  void action() override;

 private:
  friend struct LayoutProbe;
};

}  // namespace yade
