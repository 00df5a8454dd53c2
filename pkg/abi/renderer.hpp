#pragma once
// Draws the scene in YADE's 3D view; it exists only in a yade with a window.

#include "abi/serializable.hpp"

namespace yade {

class OpenGLRenderer : public Serializable {
 public:
  OpenGLRenderer() = delete;
  ~OpenGLRenderer() override;
  // Creates a functor of every class that draws.
  void init();
};

}  // namespace yade
