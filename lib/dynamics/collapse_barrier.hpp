#pragma once
// Resistance to collapse. The elastic law has a finite energy at zero area, so that an impact could
// invert an element whatever the step. An element compressed to x < 1 of the area fraction
// `kBarrierBegin` therefore has the additional energy density κ(1 − x)³/x: its first two
// derivatives vanish at x = 1, so that forces and stiffness have no jump there, and nothing changes
// above.

#include "core/tolerances/dynamics.hpp"
#include "dynamics/elastic_law.hpp"

namespace yadefrag {

/// κ relative to (λ + 2μ) kBarrierBegin². A larger one makes a step too long as soon as an element
/// enters the barrier, a smaller one lets elements become so flat that they need more steps: a
/// column that hits a wall at 1.5 of the wave speed takes 4500, 1900, 1600 steps with 3, 10, 20.
inline constexpr double kBarrier = 10;

/// The energy density as a function of J = det F, and its derivatives with respect to J.
struct CollapseBarrier {
  double energy = 0;                ///< J/m³
  double slope = 0, curvature = 0;  ///< Pa

  /// `modulus`: λ + 2μ (Pa). No barrier for an inverted element, in which no step may end.
  CollapseBarrier(double area, double modulus) {
    if (!(area > 0 && area < tolerance::kBarrierBegin)) return;
    const double x = area / tolerance::kBarrierBegin, y = 1 - x;
    const double unit = kBarrier * modulus * tolerance::kBarrierBegin;
    energy = unit * tolerance::kBarrierBegin * y * y * y / x;
    slope = unit * (3 - 2 * x - 1 / (x * x));
    curvature = unit / tolerance::kBarrierBegin * (2 / (x * x * x) - 2);
  }
};

/// ∂J/∂F
inline Matrix2 cofactor(const Matrix2& f) { return {f.yy, -f.yx, -f.xy, f.xx}; }

/// (J/m³) Twice the barrier's energy density at the half step between two gradients
/// (energy_ledger.hpp).
inline double twiceBarrierEnergy(const Matrix2& now, const Matrix2& before, double modulus) {
  const CollapseBarrier a(determinant(now), modulus), b(determinant(before), modulus);
  const Matrix2 change = now - before;
  return a.energy + b.energy -
         (a.slope * contract(cofactor(now), change) -
          b.slope * contract(cofactor(before), change)) /
             2;
}

}  // namespace yadefrag
