#pragma once
// The dispatcher that updates the bounds of bodies.

#include "abi/engine.hpp"
#include "abi/functor.hpp"

namespace yade {

class Dispatcher : public Engine {
 public:
  Dispatcher() = delete;
  ~Dispatcher() override;
  virtual string getFunctorType() const;
  virtual int getDimension() const;
  virtual string getBaseClassType(unsigned int i) const;
};

template <class FunctorType>
class Dispatcher1D : public Dispatcher {
  alignas(8) unsigned char callTable_[48];  // YADE's second base class, without virtual functions

 public:
  Dispatcher1D() = delete;
};

class BoundDispatcher : public Dispatcher1D<BoundFunctor> {
 public:
  vector<shared_ptr<BoundFunctor>> functors;
  bool activated;
  Real sweepDist;
  Real minSweepDistFactor;
  Real updatingDispFactor;
  Real targetInterv;

  BoundDispatcher() = delete;
  ~BoundDispatcher() override;
  bool isActivated() override;
  void action() override;
  void processBody(const shared_ptr<Body>& body);
};

}  // namespace yade
