#pragma once
// What draws the scene in YADE's 3D view; there is one only in a yade with a window.

#include "abi/serializable.hpp"

namespace yade {

class OpenGLRenderer : public Serializable {
 public:
  OpenGLRenderer() = delete;
  ~OpenGLRenderer() override;
  // Makes a functor of every class that draws.
  void init();
};

}  // namespace yade
