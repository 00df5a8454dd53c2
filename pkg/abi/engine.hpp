#pragma once
// Engines: the parts of the simulation loop.

#include "abi/serializable.hpp"
#include "abi/timing.hpp"

namespace yade {

class Scene;

class Engine : public Serializable {
 public:
  Scene* scene;
  TimingInfo timingInfo;
  shared_ptr<TimingDeltas> timingDeltas;
  bool dead;
  int ompThreads;
  string label;

  Engine();
  ~Engine() override;
  string getBaseClassName(unsigned int i = 0) const override;
  int getBaseClassNumber() const override;
  string getClassName() const override;
  void pySetAttr(const string& key, const py::object& value) override;
  py::dict pyDict() const override;
  void callPostLoad() override;
  void pyRegisterClass(py::object scope) override;
  virtual bool isActivated();
  virtual void action();
};

class GlobalEngine : public Engine {
 public:
  GlobalEngine() = default;
  ~GlobalEngine() override;
  string getBaseClassName(unsigned int i = 0) const override;
  int getBaseClassNumber() const override;
  string getClassName() const override;
  void pySetAttr(const string& key, const py::object& value) override;
  py::dict pyDict() const override;
  void callPostLoad() override;
  void pyRegisterClass(py::object scope) override;
};

}  // namespace yade
