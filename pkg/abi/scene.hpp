#pragma once

#include "abi/body.hpp"
#include "abi/cell.hpp"
#include "abi/engine.hpp"
#include "abi/force_container.hpp"
#include "abi/interaction.hpp"

namespace yade {

class EnergyTracker;

class Scene : public Serializable {
  const unsigned int hostNameMax = 255;

 public:
  static const int nSpeedIter = 10;

  ForceContainer forces;
  Eigen::Matrix<Real, nSpeedIter, 1> SpeedElements;

 private:
  alignas(8) unsigned char rendererAndClock_[24];  // shared_ptr<OpenGLRenderer>, prevTime

 public:
  Real dt;
  long iter;
  bool subStepping;
  int subStep;
  Real time;
  Real speed;
  long stopAtIter;
  Real stopAtTime;
  bool isPeriodic;
  bool trackEnergy;
  bool doSort;
  bool runInternalConsistencyChecks;
  Body::id_t selectedBody;
  int subdomain;
  shared_ptr<Shape> subD;
  vector<string> tags;
  vector<shared_ptr<Engine>> engines;
  vector<shared_ptr<Engine>> _nextEngines;
  shared_ptr<BodyContainer> bodies;
  shared_ptr<InteractionContainer> interactions;
  shared_ptr<EnergyTracker> energy;
  vector<shared_ptr<Material>> materials;
  shared_ptr<Bound> bound;
  shared_ptr<Cell> cell;
  vector<shared_ptr<Serializable>> miscParams;

 private:
  alignas(8) unsigned char dispParams_[24];

 public:
  Scene() = delete;
  ~Scene() override;
  bool timeStepperPresent();
  bool timeStepperActive();
  void moveToNextTimeStep();
};

}  // namespace yade
