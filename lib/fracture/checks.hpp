#pragma once
// Brittle materials that cannot be, and fracture energies that a mesh or a step cannot resolve.

#include <string>

#include "core/ids.hpp"
#include "fracture/crack_edges.hpp"
#include "mesh/brittle_material.hpp"
#include "mesh/model.hpp"

namespace yadefrag {

/// Throws InputError unless the material can crack and every value can be meant: for the callers
/// that were asked for a brittle one, since a strength of 0 elsewhere says that there is none.
void checkBrittle(const BrittleMaterial& material);

/// Throws InputError if, between two triangles of the component, a step would cross the cohesive
/// law's whole opening: ¼k·σ/δc < 1 must hold, δc = 2Gc/σ, σ the strength that the strongest edge
/// is likely to have. k = Δt²(L/2)·thickness·(1/m₁ + 1/m₂) is what 1 Pa takes from the opening at
/// one end of an edge of length L, whose half it is, and m a third of a triangle's mass: no node
/// ends up with less. A quarter, since the leapfrog is stable up to ω = 2/Δt: ¼kσ is the smallest
/// opening at which the law's slope can be resolved. Without a fracture energy there is nothing to
/// resolve.
void checkCohesiveResolution(const Model& model, ComponentId component, double dt);

/// The same; of a body whose strength or fracture energy differ by place, edge by edge with the
/// values that `edges` has.
void checkCohesiveResolution(const Model& model, const CrackEdges& edges, ComponentId component,
                             double dt);

/// The same for bonds between bodies.
void checkBondResolution(const Model& model, const CrackEdges& edges, double dt);

/// A sentence where the zone in which a crack's faces still hold is shorter than four elements, so
/// that bodies with a notch or a crack bear too much; else empty. Its length is E·Gc/σc²
/// (Hillerborg, Modéer and Petersson 1976, Cem. Concr. Res. 6, 773), and that of a crack that
/// slides E·κGc/(βσc)²: the shorter one counts. An element's length is the mean of the component's
/// edges.
[[nodiscard]] std::string cohesiveZoneWarning(const Model& model, ComponentId component);
/// The same, of a body whose strength or fracture energy differ by place for its shortest zone.
[[nodiscard]] std::string cohesiveZoneWarning(const Model& model, const CrackEdges& edges,
                                              ComponentId component);
/// The same of the bonds from edge `first` on.
[[nodiscard]] std::string bondZoneWarning(const Model& model, const CrackEdges& edges,
                                          EdgeId first);

}  // namespace yadefrag
