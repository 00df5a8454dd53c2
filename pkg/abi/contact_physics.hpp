#pragma once
// Forces of a contact, as computed by YADE's laws with a normal and a shear part.

#include "abi/indexable.hpp"
#include "abi/serializable.hpp"

namespace yade {

class IPhys : public Serializable, public Indexable {
 public:
  IPhys() = delete;
  ~IPhys() override;
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

}  // namespace yade
