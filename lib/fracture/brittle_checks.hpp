#pragma once
// Checks of brittle materials, and meshes that do not resolve the cohesive zone.

#include <span>
#include <string>

#include "core/ids.hpp"
#include "fracture/crack_edges.hpp"
#include "mesh/body_material.hpp"
#include "mesh/model.hpp"
#include "mesh/triangle_mesh.hpp"

namespace yadefrag {

// --- Strength or fracture energy for triangles that do not resolve the cohesive zone.
//
// A crack needs the energy Gc only if elements resolve its zone, l = E·Gc/σc²: of larger ones a
// side breaks when the stress averaged over them reaches σc, later than the crack would. Both
// values cannot be kept. With σc' = σc√(l/4h) or Gc' = Gc·4h/l the zone has four elements of size h
// again (scaling of the crack band model: Bažant and Oh 1983, Materials and Structures 16, 155).

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

// --- Checks of brittle materials, and of fracture energies that a mesh or a step cannot resolve.

/// Throws InputError unless the material can crack and every value is valid. Call it only for
/// materials that are meant to be brittle: elsewhere a strength of 0 means that the material never
/// cracks.
void checkBrittle(const BrittleMaterial& material);

/// Throws InputError if, between two triangles of the component, one step would close the whole
/// opening of the cohesive law. Required: ¼k·σ/δs < 1, where δs is the opening over which the
/// curve's steepest slope would fall from σ to 0 (for the straight line δc = 2Gc/σ) and σ the
/// probable strength of the strongest edge. k = Δt²(L/2)·thickness·(1/m₁ + 1/m₂) is the closing by
/// 1 Pa at one end of an edge of length L, which has half of the edge; m is a third of a triangle's
/// mass, the least mass that a node can have. The factor ¼ is due to the leapfrog, which is stable
/// up to ω = 2/Δt: ¼kσ is the smallest opening at which the slope of the law is resolved. Without a
/// fracture energy there is no condition. With a rate effect it is required at the factor at which
/// it is the hardest to satisfy; so is the message about the zone.
void checkCohesiveResolution(const Model& model, ComponentId component, double dt);

/// Throws InputError if one step would close the opening of the cohesive law; edge by edge with the
/// values in `edges` for a body whose strength or fracture energy varies by place.
void checkCohesiveResolution(const Model& model, const CrackEdges& edges, ComponentId component,
                             double dt);

/// True if no step of `dt` (s) closes the opening of the cohesive law at this edge.
[[nodiscard]] bool isResolved(const Model& model, const CrackEdges& edges, EdgeId edge, double dt);

/// Throws InputError if one step would close the opening of a bond between bodies.
void checkBondResolution(const Model& model, const CrackEdges& edges, double dt);

/// A message if the cohesive zone (`cohesiveZone`) is shorter than four elements, so that bodies
/// with a notch or a crack carry too much load, or longer than half of the body, so that one
/// without them does; otherwise empty. An element's length is the mean of the component's edges.
[[nodiscard]] std::string cohesiveZoneWarning(const Model& model, ComponentId component);
/// The message about the shortest zone of a body whose strength or energy varies by place.
[[nodiscard]] std::string cohesiveZoneWarning(const Model& model, const CrackEdges& edges,
                                              ComponentId component);
/// The message of `cohesiveZoneWarning` about the bonds from edge `first` on.
[[nodiscard]] std::string bondZoneWarning(const Model& model, const CrackEdges& edges,
                                          EdgeId first);

}  // namespace yadefrag
