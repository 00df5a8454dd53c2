#pragma once
// Strength or fracture energy for triangles that do not resolve the cohesive zone.
//
// A crack needs the energy Gc only if elements resolve its zone, l = E·Gc/σc²: of larger ones a
// side breaks when the stress averaged over them reaches σc, later than the crack would. Both
// values cannot be kept. With σc' = σc√(l/4h) or Gc' = Gc·4h/l the zone has four elements of size h
// again (scaling of the crack band model: Bažant and Oh 1983, Materials and Structures 16, 155).

#include <span>
#include <string>

#include "mesh/body_material.hpp"
#include "mesh/triangle_mesh.hpp"

namespace yadefrag {

enum class CoarseMesh : std::uint8_t {
  kWarn,      ///< both values as given
  kStrength,  ///< the strength is reduced: cracks run at the right load
  kEnergy     ///< the energy is raised: whole bodies have the right strength
};

/// By name: 'warn', 'strength', 'energy'. Throws InputError for another one.
[[nodiscard]] CoarseMesh coarseMeshNamed(const std::string& name);

/// κ/β²: the length of a sliding crack's zone over that of an opening one's.
[[nodiscard]] inline double slidingZone(const BrittleMaterial& material) {
  return material.shearEnergyFactor / material.shearFactor / material.shearFactor;
}

/// (m) Length of the cohesive zone, E·Gc/σc² (Hillerborg, Modéer and Petersson 1976, Cem. Concr.
/// Res. 6, 773), and that of a sliding crack, E·κGc/(βσc)²: the shorter one. For a softening curve
/// with a steeper part, Gc is replaced by the area ½σcδs below a line of its slope: the zone at the
/// peak load is that of the line.
[[nodiscard]] double cohesiveZone(double young, double energy, double strength,
                                  const BrittleMaterial& material);

/// The materials of a body, before it is added: one, or several with a number by triangle.
struct MaterialsOfMesh {
  std::span<const BodyMaterial> materials;
  std::span<const CoarseMesh> choices;     ///< by material
  std::span<const std::uint32_t> numbers;  ///< by triangle; empty: all have the first one
};

/// What `fitToMesh` has changed.
struct FittedValues {
  std::size_t triangles = 0;  ///< their number
  double leastStrength = 1;   ///< smallest strength over the given one
  double mostEnergy = 1;      ///< largest energy over the given one
};

/// Changes the values in `places` as chosen, where a triangle does not resolve its zone; joints
/// keep their own values. The size of a triangle is the side of an equilateral one of its area.
/// `places` has values by triangle afterwards if any changed.
FittedValues fitToMesh(const TriangleMesh& mesh, const MaterialsOfMesh& body,
                       BrittlePlaces& places);

}  // namespace yadefrag
