#pragma once
// Forces and torques per body and thread: an opaque member of Scene.

#include "abi/basics.hpp"

namespace yade {

class ForceContainer {
  alignas(8) unsigned char hidden_[304];

 public:
  ForceContainer() = delete;
  ForceContainer(const ForceContainer&) = delete;
  ~ForceContainer();
  void addMaxId(int id);
};

}  // namespace yade
