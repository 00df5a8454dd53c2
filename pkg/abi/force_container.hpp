#pragma once
// Forces and torques per body and thread: a member of Scene whose data stay hidden.

#include "abi/basics.hpp"

namespace yade {

class ForceContainer {
  alignas(8) unsigned char hidden_[304];

 public:
  ForceContainer() = delete;
  ForceContainer(const ForceContainer&) = delete;
  ~ForceContainer();
  void addMaxId(int id);
  void addForce(int id, const Vector3r& force);
  void addTorque(int id, const Vector3r& torque);
  // Sums up what the threads have added; to be called before reading.
  void sync();
  const Vector3r& getForce(int id);
  const Vector3r& getTorque(int id);
};

}  // namespace yade
