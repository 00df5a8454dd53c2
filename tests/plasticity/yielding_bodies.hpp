#pragma once
// Bodies for the problems with closed solutions of ideal plasticity.

#include <cmath>
#include <numbers>

#include "step/bodies.hpp"

namespace yadefrag::test {

/// Ideally plastic steel; k = Y/√3 is its shear strength.
inline BodySpec idealSteel(double yield = 300e6, ElementKind kind = ElementKind::kSmoothed) {
  BodySpec spec;
  spec.material = steel();
  spec.plastic.yieldStress = yield;
  spec.element = kind;
  return spec;
}

inline double shearStrength(const BodySpec& spec) {
  return spec.plastic.yieldStress / std::numbers::sqrt3;
}

/// (N/m) Mean force with which the nodes press downwards in the last fifth of the steps.
inline double meanForce(World& world, const std::vector<NodeId>& nodes, double dt, int steps) {
  double sum = 0;
  int count = 0;
  for (int i = 0; i < steps; ++i) {
    world.step(dt);
    if (i < steps * 4 / 5) continue;
    for (const NodeId n : nodes) sum -= world.reactions[n.value].y;
    ++count;
  }
  return sum / count;
}

}  // namespace yadefrag::test
