#pragma once

#include "abi/indexable.hpp"
#include "abi/serializable.hpp"

namespace yade {

class Scene;
class State;

class Material : public Serializable, public Indexable {
 public:
  int id;
  string label;
  Real density;

  Material() = delete;
  ~Material() override;
  virtual shared_ptr<State> newAssocState() const;
  virtual bool stateTypeOk(State* state) const;

  // Both throw std::runtime_error for a material that is not in the scene.
  static const shared_ptr<Material> byId(int id, Scene* scene = nullptr);
  static const shared_ptr<Material> byLabel(const string& label, Scene* scene = nullptr);

 protected:
  int& modifyClassIndex() override;

 public:
  const int& getClassIndex() const override;
  const int& getBaseClassIndex(int depth) const override;
  const int& getMaxCurrentlyUsedClassIndexOfKin() const override;

 protected:
  void incrementMaxCurrentlyUsedClassIndexOfKin() override;
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
  string getBaseClassName(unsigned int i = 0) const override;
  int getBaseClassNumber() const override;
  string getClassName() const override;
  void pySetAttr(const string& key, const py::object& value) override;
  py::dict pyDict() const override;
  void callPostLoad() override;
  void pyRegisterClass(py::object scope) override;
  const int& getClassIndex() const override;
  const int& getBaseClassIndex(int depth) const override;

 protected:
  int& modifyClassIndex() override;
};

}  // namespace yade
