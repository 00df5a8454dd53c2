#pragma once
// The geometry of a contact, as YADE's contact laws for spheres use it.

#include "abi/indexable.hpp"
#include "abi/interaction.hpp"

namespace yade {

class IGeom : public Serializable, public Indexable {
 public:
  IGeom() = delete;
  ~IGeom() override;

 protected:
  int& modifyClassIndex() override;

 public:
  const int& getClassIndex() const override;
  const int& getBaseClassIndex(int depth) const override;
  const int& getMaxCurrentlyUsedClassIndexOfKin() const override;

 protected:
  void incrementMaxCurrentlyUsedClassIndexOfKin() override;
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

}  // namespace yade
