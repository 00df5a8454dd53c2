#pragma once
// The base of every collider.

#include "abi/dispatcher.hpp"

namespace yade {

class Collider : public GlobalEngine {
 public:
  shared_ptr<BoundDispatcher> boundDispatcher;
  mask_t avoidSelfInteractionMask;

  Collider();
  ~Collider() override;
  string getBaseClassName(unsigned int i = 0) const override;
  int getBaseClassNumber() const override;
  string getClassName() const override;
  void pySetAttr(const string& key, const py::object& value) override;
  py::dict pyDict() const override;
  void callPostLoad() override;
  void pyRegisterClass(py::object scope) override;
  void pyHandleCustomCtorArgs(py::tuple& args, py::dict& kw) override;
  virtual vector<Body::id_t> probeBoundingVolume(const Bound& bound);
  virtual void invalidatePersistentData();
  bool mayCollide(const Body* a, const Body* b, Body::id_t subdomain);
};

}  // namespace yade
