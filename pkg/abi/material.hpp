#pragma once

#include "abi/indexable.hpp"
#include "abi/serializable.hpp"

namespace yade {

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
  const int& getClassIndex() const override;
  const int& getBaseClassIndex(int depth) const override;
  const int& getMaxCurrentlyUsedClassIndexOfKin() const override;

 protected:
  int& modifyClassIndex() override;
  void incrementMaxCurrentlyUsedClassIndexOfKin() override;
};

}  // namespace yade
