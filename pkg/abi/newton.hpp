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

  NewtonIntegrator() = delete;
  ~NewtonIntegrator() override;
  void action() override;

 private:
  friend struct LayoutProbe;
};

}  // namespace yade
