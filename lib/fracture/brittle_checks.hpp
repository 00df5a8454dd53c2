#pragma once
// Checks of brittle materials, and of fracture energies that a mesh or a step cannot resolve.

#include <string>

#include "core/ids.hpp"
#include "fracture/crack_edges.hpp"
#include "mesh/brittle_material.hpp"
#include "mesh/model.hpp"

namespace yadefrag {

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

/// The same; for a body whose strength or fracture energy varies by place, edge by edge with the
/// values in `edges`.
void checkCohesiveResolution(const Model& model, const CrackEdges& edges, ComponentId component,
                             double dt);

/// That condition for one edge.
[[nodiscard]] bool isResolved(const Model& model, const CrackEdges& edges, EdgeId edge, double dt);

/// The same for bonds between bodies.
void checkBondResolution(const Model& model, const CrackEdges& edges, double dt);

/// A message if the cohesive zone (`cohesiveZone`) is shorter than four elements, so that bodies
/// with a notch or a crack carry too much load, or longer than half of the body, so that one
/// without them does; otherwise empty. An element's length is the mean of the component's edges.
[[nodiscard]] std::string cohesiveZoneWarning(const Model& model, ComponentId component);
/// The same for the shortest zone of a body whose strength or fracture energy varies by place.
[[nodiscard]] std::string cohesiveZoneWarning(const Model& model, const CrackEdges& edges,
                                              ComponentId component);
/// The same for the bonds from edge `first` on.
[[nodiscard]] std::string bondZoneWarning(const Model& model, const CrackEdges& edges,
                                          EdgeId first);

}  // namespace yadefrag
