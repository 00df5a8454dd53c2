#pragma once
// State, stress and energy of bodies that yield, for output and for the energy balance. The stored
// state is that of the last forces, at xⁿ⁻¹; here it is returned to the yield surface at xⁿ, as the
// next step will do. `dt` (s): the last step.

#include <array>
#include <span>
#include <vector>

#include "dynamics/plastic_return.hpp"
#include "mesh/model.hpp"

namespace yadefrag {

/// By triangle; those of bodies that do not yield have no meaning.
[[nodiscard]] std::vector<YieldPoint> presentPoints(const Model& model, double dt);
/// An element at the present positions, with its own volume strain, not that of its nodes.
[[nodiscard]] Returned presentState(const Model& model, ElementId element, double dt);

/// (J) Energies of these bodies at the half step (energy_ledger.hpp).
struct YieldingEnergy {
  double strain = 0;
  /// Half of the dissipation of the last motion, which the ledger does not yet contain.
  double dissipated = 0;
};
[[nodiscard]] YieldingEnergy yieldingEnergy(const Model& model, double dt);
/// The same for some elements, which must be whole fragments.
[[nodiscard]] YieldingEnergy yieldingEnergy(const Model& model, std::span<const ElementId> elements,
                                            double dt);
/// Damage by triangle; 0 where the material does not fail.
[[nodiscard]] std::vector<double> presentDamage(const Model& model, double dt);

/// (Pa) Cauchy stress xx, yy, xy of the elements of these bodies.
void setYieldingStresses(const Model& model, double dt,
                         std::vector<std::array<double, 3>>& stresses);
/// (Pa) Their stress zz; 0 in plane stress.
void setYieldingAcross(const Model& model, double dt, std::vector<double>& stresses);
/// Triangles of a body that flow without any motion.
[[nodiscard]] std::size_t countYielding(const Model& model, ComponentId body);
}  // namespace yadefrag
