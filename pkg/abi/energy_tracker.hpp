#pragma once
// The energy table of O.energy.

#include "abi/serializable.hpp"

namespace yade {

class EnergyTracker : public Serializable {
  alignas(8) unsigned char hidden_[152];

 public:
  EnergyTracker() = delete;
  ~EnergyTracker() override;
  void setItem_py(const string& name, Real value);
};

}  // namespace yade
