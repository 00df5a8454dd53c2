#pragma once
// Forces and torques per body and thread: a member of Scene.

#include "abi/basics.hpp"

namespace yade {

class ForceContainer {
  vector<vector<Vector3r>> _forceData;
  vector<vector<Vector3r>> _torqueData;
  alignas(8) unsigned char hidden_[256];

 public:
  ForceContainer() = delete;
  ForceContainer(const ForceContainer&) = delete;
  ~ForceContainer();
  void addMaxId(int id);
  void addForce(int id, const Vector3r& force);
  void addTorque(int id, const Vector3r& torque);
  // Sums the contributions of the threads; must be called before reading.
  void sync();
  const Vector3r& getForce(int id);
  const Vector3r& getTorque(int id);

 private:
  friend struct LayoutProbe;
};

}  // namespace yade
