#pragma once
// Where the energy went.
//
// The leapfrog has velocities at n−½ and positions at n. With v̄ = ½(vⁿ⁻½ + vⁿ⁺½), a step changes
// the kinetic energy ½m|vⁿ⁻½|² by exactly Δv f·v̄, Δv = ½(Δtⁿ⁻¹ + Δtⁿ). Works are therefore booked
// with v̄, and the strain energy is that of the half step, between xⁿ⁻¹ = xⁿ − Δt vⁿ⁻½ and xⁿ:
//   Σ V [½(W(F) + W(F')) − ¼(P − P') : (F − F')],   F at xⁿ, F' at xⁿ⁻¹.
// For small strains the sum of the two is the leapfrog's invariant, constant to rounding at any
// stable step; ½(W + W') alone would swing by up to the energy of the highest modes. In large
// deformation and rotation the invariant has a further part, of second order in Δt, that is not
// known here. Free motion gives it back; each impact of soft bodies that turn changes it for good,
// mostly downwards: in a drum with stones of rubber by 5·10⁻⁴ of the work at 0.8 of the critical
// step, 1.3·10⁻⁴ at 0.4, 3·10⁻⁵ at 0.2. Where the step changes from Δt to Δt', it
// jumps by (Δt² − Δt'²)/8 f·M⁻¹f, which is of second order, too.

#include <span>

#include "mesh/model.hpp"

namespace yadefrag {

/// J, summed since the start. Each is what left the bodies' kinetic and strain energy, except
/// `external`, which is what came in.
struct EnergyLedger {
  double contact = 0;   ///< −ΣF·v̄Δt of normal contact forces, of cracks that still hold, too
  double friction = 0;  ///< −ΣF·v̄Δt of friction, of cracks that still hold, too
  double fracture = 0;  ///< of the cohesive law, and of strains that split nodes no longer share
  double damping = 0;   ///< mass-proportional damping and bulk viscosity
  double dropped = 0;   ///< of fragments that were taken out
  double external = 0;  ///< gravity, loads, forces from outside, prescribed motion

  /// J, constant to the scheme's order.
  [[nodiscard]] double total(double kinetic, double strain) const {
    return kinetic + strain + contact + friction + fracture + damping + dropped - external;
  }
};

/// J, at n − ½.
double kineticEnergy(const Nodes& nodes);

/// J, at n − ½; Δt is that of the last step.
double strainEnergy(const Model& model, double dt);
/// The same of some elements; of bodies with smoothed strains whole pieces only.
double strainEnergy(const Model& model, double dt, std::span<const ElementId> elements);

}  // namespace yadefrag
