#pragma once
// Engines: the parts of the simulation loop.

#include "yade/layout.hpp"
#include "yade/serializable.hpp"

namespace yade {

class Scene;

// The data that yade.timing reads.
struct TimingInfo {
  using delta = unsigned long long;
  long nExec;
  delta nsec;
  static bool enabled;
};

class TimingDeltas;  // used by pointer only

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
  YADEFRAG_YADE_FUNCTIONS;
  virtual bool isActivated();
  virtual void action();
};

class GlobalEngine : public Engine {
 public:
  GlobalEngine() = default;
  ~GlobalEngine() override;
  YADEFRAG_YADE_FUNCTIONS;
};

class FieldApplier : public GlobalEngine {
 public:
  int fieldWorkIx;
  FieldApplier() = delete;
  ~FieldApplier() override;
  void action() override;
};

// Its record of the fastest body determines when a collider must search.
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
#if YADEFRAG_YADE >= 202502
 public:
  enum class RotAlgorithm { delValle2023 = 1, Omelyan1998 = 2, Fincham1992 = 3 };
  RotAlgorithm rotAlgorithm;
  int normalizeEvery;
  int niterOmelyan1998;
#endif
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
  YADEFRAG_YADE_FUNCTIONS;
  void action() override;

 private:
  friend struct LayoutProbe;
};

}  // namespace yade
