#pragma once
// The integrator. Its record of the fastest body determines when a collider must search.

#include "abi/engine.hpp"
#include "abi/layout.hpp"

namespace yade {

class FieldApplier : public GlobalEngine {
 public:
  int fieldWorkIx;
  FieldApplier() = delete;
  ~FieldApplier() override;
  void action() override;
};

class NewtonIntegrator : public FieldApplier {
  bool syncEnsured;
  bool cellChanged;
  int homoDeform;
  bool bodySelected;
  Matrix3r dVelGrad;
  Vector3r dSpin;

 public:
  bool densityScaling;
  Real updatingDispFactor;
  vector<Real> threadMaxVelocitySq;
  Real damping;
  Vector3r gravity;
  Real maxVelocitySq;
  bool exactAsphericalRot;

 private:
  // Since 2025: rotAlgorithm, normalizeEvery, niterOmelyan1998. Before: padding.
  unsigned char rotation_[yadefrag::layoutBytes("NewtonIntegrator", "prevVelGrad") -
                          yadefrag::layoutBytes("NewtonIntegrator", "exactAsphericalRot") - 1];

 public:
  Matrix3r prevVelGrad;
  Vector3r prevCellSize;
  bool warnNoForceReset;
  int nonviscDampIx;
  bool kinSplit;
  bool dampGravity;
  int kinEnergyIx;
  int kinEnergyTransIx;
  int kinEnergyRotIx;
  int mask;

  NewtonIntegrator();
  ~NewtonIntegrator() override;
  string getBaseClassName(unsigned int i = 0) const override;
  int getBaseClassNumber() const override;
  string getClassName() const override;
  void pySetAttr(const string& key, const py::object& value) override;
  py::dict pyDict() const override;
  void callPostLoad() override;
  void pyRegisterClass(py::object scope) override;
  void action() override;

 private:
  friend struct LayoutProbe;
};

}  // namespace yade
