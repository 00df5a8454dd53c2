#pragma once
// The material of a triangle, and the assignment of materials to the triangles of a body.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

#include "mesh/plastic_material.hpp"
#include "mesh/rate_effect.hpp"
#include "mesh/softening_curve.hpp"

namespace yadefrag {

/// Isotropic elasticity of a plane body.
struct ElasticMaterial {
  double young = 0;  ///< Pa
  double poisson = 0;
  double density = 0;  ///< kg/m³
  bool planeStress = false;

  /// Pa, Lamé's second constant (shear modulus).
  [[nodiscard]] double shearModulus() const { return young / (2 * (1 + poisson)); }
  /// Pa, Lamé's first constant. In plane stress it has the value for which the out-of-plane stress
  /// is zero.
  [[nodiscard]] double lame() const {
    return planeStress ? young * poisson / (1 - poisson * poisson)
                       : young * poisson / ((1 + poisson) * (1 - 2 * poisson));
  }
  /// Pa, stiffness of a plane compression wave: ρc².
  [[nodiscard]] double waveModulus() const { return lame() + 2 * shearModulus(); }
};

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
  /// Factor of Gc by the speed of the crack when it reaches an edge; the edge keeps that energy.
  RateEffect speed{};

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

struct BodyMaterial {
  ElasticMaterial material;
  BrittleMaterial brittle;
  double friction = 0;  ///< tan of the friction angle
  PlasticMaterial plastic;
};

/// (Pa) Strength of an edge that never cracks, in a body with edges that can.
inline constexpr double kUnbreakable = std::numeric_limits<double>::max();

/// Fracture of a material that cracks only where it has failed: an edge gets its strength then.
[[nodiscard]] inline BrittleMaterial untilFailure(const FailureLaw& law) {
  return {.tensileStrength = kUnbreakable, .fractureEnergy = law.energy};
}

/// The materials of a body with several; empty for a body with one.
struct MaterialPlaces {
  std::vector<BodyMaterial> materials;
  std::vector<std::uint32_t> ofTriangle;  ///< number of the material, by triangle of the mesh

  [[nodiscard]] bool empty() const { return materials.empty(); }
};

/// One material that bounds all materials of a body: the elasticity of the first one, and bounds
/// for fracture: the least strength (joints included), shear factor and friction. The strength is 0
/// if no edge can crack.
[[nodiscard]] inline BodyMaterial boundOf(const MaterialPlaces& materials,
                                          const BrittlePlaces& places) {
  BodyMaterial bound = materials.materials.front();
  bound.brittle = {};
  bound.brittle.shearFactor = std::numeric_limits<double>::infinity();
  double least = kUnbreakable;
  bool cracks = !places.joints.empty();
  for (const BodyMaterial& one : materials.materials) {
    bound.friction = std::min(bound.friction, one.friction);
    bound.brittle.shearFactor = std::min(bound.brittle.shearFactor, one.brittle.shearFactor);
    if (!one.brittle.cracks()) continue;
    cracks = true;
    least = std::min(least, one.brittle.tensileStrength);
  }
  for (const JointEdge& joint : places.joints)
    if (joint.strength > 0) least = std::min(least, joint.strength);
  if (cracks) bound.brittle.tensileStrength = least;
  return bound;
}

}  // namespace yadefrag
