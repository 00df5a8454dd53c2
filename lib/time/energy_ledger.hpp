#pragma once
// Energy balance.
//
// The leapfrog has velocities at n−½ and positions at n. With v̄ = ½(vⁿ⁻½ + vⁿ⁺½), a step changes
// the kinetic energy ½m|vⁿ⁻½|² by exactly Δv f·v̄, Δv = ½(Δtⁿ⁻¹ + Δtⁿ). Work is therefore computed
// with v̄. The strain energy is that of the half step, between xⁿ⁻¹ = xⁿ − Δt vⁿ⁻½ and xⁿ:
//   Σ V [½(W(F) + W(F')) − ¼(P − P') : (F − F')],   F at xⁿ, F' at xⁿ⁻¹.
// For small strains the sum of kinetic and strain energy is the invariant of the leapfrog: it is
// constant, except for rounding, at any stable step. With ½(W + W') alone it would oscillate by up
// to the energy of the highest modes. In large deformation and rotation the invariant has a further
// term of second order in Δt, for which no expression is known here. In free motion this term
// returns to its old value. Each impact of soft bodies that rotate changes it permanently, mostly
// downwards: in a drum with stones of rubber by 5·10⁻⁴ of the work at 0.8 of the critical step,
// 1.3·10⁻⁴ at 0.4, 3·10⁻⁵ at 0.2. Where the step changes from Δt to Δt', the invariant jumps by
// (Δt² − Δt'²)/8 f·M⁻¹f, which is of second order, too.

#include <span>

#include "mesh/model.hpp"

namespace yadefrag {

/// J, sums since the start. Each is energy that left the bodies' kinetic and strain energy, except
/// `external`, which is energy supplied.
struct EnergyLedger {
  double contact = 0;   ///< −ΣF·v̄Δt of normal contact forces, on cohesive cracks, too
  double friction = 0;  ///< −ΣF·v̄Δt of friction, on cohesive cracks, too
  /// Of the cohesive law, and the loss of smoothed strain energy when nodes split.
  double fracture = 0;
  /// Plastic work, up to the last positions at which forces were computed.
  double plastic = 0;
  double damping = 0;  ///< mass-proportional damping and bulk viscosity
  double dropped = 0;  ///< energy of fragments that were removed
  /// Gravity, loads, external forces, prescribed motion; where bodies yield, also what changes of
  /// the step's length add (ExplicitDynamics::energyOfChange).
  double external = 0;
  /// (kg m²/s) Angular momentum that contact and cohesive tractions have created: both act between
  /// nodes and should create none. Counted while cracks are cohesive.
  double spin = 0;

  /// J, constant to the order of the scheme.
  [[nodiscard]] double total(double kinetic, double strain) const {
    return kinetic + strain + contact + friction + fracture + plastic + damping + dropped -
           external;
  }
};

/// J, at n − ½.
double kineticEnergy(const Nodes& nodes);
/// kg m²/s, Σ m|r||v|, with r from the centre of mass: a bound of the angular momentum.
double sumOfSpins(const Nodes& nodes);
/// N m, Σ x × f, by node.
double moment(std::span<const Vec2> positions, std::span<const Vec2> forces);

/// J, at n − ½; Δt is that of the last step.
double strainEnergy(const Model& model, double dt);
/// J, at n − ½, of some elements; of bodies with smoothed strains, these must be whole fragments.
double strainEnergy(const Model& model, double dt, std::span<const ElementId> elements);

}  // namespace yadefrag
