#pragma once
// What makes a material crack.

#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

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

/// An edge of a body's mesh on a joint.
struct JointEdge {
  std::array<std::uint32_t, 2> nodes;  ///< of the mesh
  /// Pa, without scatter; 0: open from the start; not a number: as the triangles beside it have it.
  double strength = 0;
  double fractureEnergy = NAN;  ///< J/m²; not a number: as the triangles beside it have it
};

/// Where a body's strength and fracture energy are not its material's.
struct BrittlePlaces {
  std::vector<double> strength;        ///< Pa, by triangle of the mesh; empty: the material's
  std::vector<double> fractureEnergy;  ///< J/m², likewise
  std::vector<JointEdge> joints;

  [[nodiscard]] bool empty() const {
    return strength.empty() && fractureEnergy.empty() && joints.empty();
  }
};

}  // namespace yadefrag
