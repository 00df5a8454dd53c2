#pragma once
// Material constants of fracture.

#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

#include "mesh/rate_effect.hpp"
#include "mesh/softening_curve.hpp"

namespace yadefrag {

struct BrittleMaterial {
  double tensileStrength = 0;  ///< Pa, σc; 0: the material never cracks
  double fractureEnergy = 0;   ///< J/m², Gc; 0: a crack opens at once
  /// β: shear strength over tensile strength. The shear strength is β·σc + tan φ · pressure.
  double shearFactor = 1;
  /// κ = GII/GI: energy per area that a crack dissipates in shear, over that in tension, Gc.
  double shearEnergyFactor = 1;
  double weibullModulus = 0;   ///< of the scatter of strengths; 0: no scatter
  double strengthScatter = 0;  ///< relative half-width of a uniform scatter; 0: no scatter
  std::uint64_t seed = 0;      ///< of the scatter
  double referenceVolume = 0;  ///< m³, V₀ of the Weibull scatter; 0: the volume has no influence
  SofteningCurve softening{};  ///< the traction by opening, of a crack with a fracture energy
  /// Factor of the strength by the strain rate with which an edge cracks; it keeps that strength.
  RateEffect rate{};
  double rateEnergyPower = 1;  ///< p: Gc is multiplied by that factor to the power of p

  [[nodiscard]] bool cracks() const { return tensileStrength > 0; }
};

/// An edge of a body's mesh that lies on a joint.
struct JointEdge {
  std::array<std::uint32_t, 2> nodes;  ///< node numbers in the mesh
  /// Pa, without scatter; 0: open from the start; NaN: that of the adjacent triangles.
  double strength = 0;
  double fractureEnergy = NAN;  ///< J/m²; NaN: that of the adjacent triangles
};

/// Strengths and fracture energies that differ from those of the body's material.
struct BrittlePlaces {
  std::vector<double> strength;        ///< Pa, by triangle of the mesh; empty: that of the material
  std::vector<double> fractureEnergy;  ///< J/m², likewise
  std::vector<JointEdge> joints;

  [[nodiscard]] bool empty() const {
    return strength.empty() && fractureEnergy.empty() && joints.empty();
  }
};

}  // namespace yadefrag
