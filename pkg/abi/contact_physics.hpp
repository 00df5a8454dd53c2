#pragma once
// Forces of a contact, as computed by YADE's laws with a normal and a shear part.

#include "abi/indexable.hpp"
#include "abi/layout.hpp"
#include "abi/serializable.hpp"

namespace yade {

class IPhys : public Serializable, public Indexable {
 public:
  IPhys() = delete;
  ~IPhys() override;

 protected:
  int& modifyClassIndex() override;

 public:
  const int& getClassIndex() const override;
  const int& getBaseClassIndex(int depth) const override;
  const int& getMaxCurrentlyUsedClassIndexOfKin() const override;

 protected:
  void incrementMaxCurrentlyUsedClassIndexOfKin() override;
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

}  // namespace yade
