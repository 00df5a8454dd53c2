#pragma once
// What makes a material crack.

#include <cstdint>

namespace yadefrag {

struct BrittleMaterial {
  double tensileStrength = 0;  ///< Pa, σc; 0: never cracks
  double fractureEnergy = 0;   ///< J/m², Gc; 0: a crack opens at once
  /// β: shear strength over tensile strength. The shear strength is β·σc + tan φ · pressure.
  double shearFactor = 1;
  /// κ = GII/GI: work that a crack takes by shear, over Gc, which it takes by tension.
  double shearEnergyFactor = 1;
  double weibullModulus = 0;   ///< of the strengths' scatter; 0: none
  double strengthScatter = 0;  ///< relative half-width of an even scatter; 0: none
  std::uint64_t seed = 0;      ///< of the scatter
  double referenceVolume = 0;  ///< m³, V₀ of the Weibull scatter; 0: the volume has no influence

  [[nodiscard]] bool cracks() const { return tensileStrength > 0; }
  /// (m) Opening at which a crack no longer holds anything.
  [[nodiscard]] double criticalOpening() const { return 2 * fractureEnergy / tensileStrength; }
};

}  // namespace yadefrag
