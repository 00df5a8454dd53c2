#pragma once
// When an edge opens: its effective traction against its strength.

#include <algorithm>
#include <array>
#include <cmath>

#include "core/vec2.hpp"
#include "mesh/brittle_material.hpp"

namespace yadefrag {

/// (Pa) What one side of a line does to the other.
struct Traction {
  double normal;  ///< positive: pulls
  double shear;   ///< along the normal turned left
};

/// Cauchy: t = σn, of a stress (Pa: xx, yy, xy) on a line with the unit normal n.
[[nodiscard]] inline Traction tractionOn(const std::array<double, 3>& stress, Vec2 normal) {
  const Vec2 t{stress[0] * normal.x + stress[2] * normal.y,
               stress[2] * normal.x + stress[1] * normal.y};
  return {dot(normal, t), cross(normal, t)};
}

/// (Pa) Camacho and Ortiz 1996 (Int. J. Solids Struct. 33, 2899), the fracture criterion: under
/// tension √(σₙ² + (τ/β)²), under compression what friction leaves of the shear, max(0, |τ| −
/// μ|σₙ|)/β. Both are |τ|/β where σₙ = 0. An edge opens where this reaches its strength.
[[nodiscard]] inline double effectiveTraction(double normal, double shear,
                                              const BrittleMaterial& material, double friction) {
  if (normal >= 0) return std::hypot(normal, shear / material.shearFactor);
  return std::max(0., std::abs(shear) + friction * normal) / material.shearFactor;
}

/// (Pa) A bound of the effective traction on all planes, from Mohr's circle with centre c and
/// radius r: √((c + r)² + ((r√(1 + μ²) + μc)/β)²), either part if positive. |τ| + μσₙ is largest
/// where the second part says, so |τ| is below it where σₙ ≥ 0, and |τ| − μ|σₙ| where σₙ < 0. It is
/// convex: a mean of stresses has no more than the largest of them.
[[nodiscard]] inline double largestTraction(const std::array<double, 3>& stress,
                                            const BrittleMaterial& material, double friction) {
  const double centre = .5 * (stress[0] + stress[1]);
  const double half = .5 * (stress[0] - stress[1]);
  const double radius = std::sqrt(half * half + stress[2] * stress[2]);
  const double tension = std::max(0., centre + radius);
  const double shear =
      std::max(0., radius * std::sqrt(1 + friction * friction) + friction * centre) /
      material.shearFactor;
  return std::sqrt(tension * tension + shear * shear);
}

}  // namespace yadefrag
