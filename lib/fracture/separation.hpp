#pragma once
// The fracture criterion: an edge opens if its effective traction reaches its strength.

#include <algorithm>
#include <array>
#include <cmath>
#include <span>

#include "core/vec2.hpp"
#include "elements/elastic_law.hpp"
#include "fracture/crack_edges.hpp"
#include "mesh/body_material.hpp"

namespace yadefrag {

/// (Pa) Traction across a line.
struct Traction {
  double normal;  ///< positive: tension
  double shear;   ///< along the normal rotated by 90° counter-clockwise
};

/// Cauchy's formula: t = σn, for a stress (Pa: xx, yy, xy) and a line with the unit normal n.
[[nodiscard]] inline Traction tractionOn(const std::array<double, 3>& stress, Vec2 normal) {
  const Vec2 t{stress[0] * normal.x + stress[2] * normal.y,
               stress[2] * normal.x + stress[1] * normal.y};
  return {dot(normal, t), cross(normal, t)};
}

/// (Pa) Fracture criterion of Camacho and Ortiz 1996 (Int. J. Solids Struct. 33, 2899). In tension
/// √(σₙ² + (τ/β)²); in compression the shear minus friction, max(0, |τ| − μ|σₙ|)/β. Both are |τ|/β
/// for σₙ = 0. An edge opens if this reaches its strength.
[[nodiscard]] inline double effectiveTraction(double normal, double shear,
                                              const BrittleMaterial& material, double friction) {
  if (normal >= 0) {
    const double slip = shear / material.shearFactor;
    return std::sqrt(normal * normal + slip * slip);
  }
  return std::max(0., std::abs(shear) + friction * normal) / material.shearFactor;
}

/// (Pa²) The squared bound of the effective traction on all planes.
[[nodiscard]] inline double squaredBound(const TractionBound& bound,
                                         const std::array<double, 3>& stress) {
  const double half = .5 * (stress[0] - stress[1]);
  return bound.squaredOf(.5 * (stress[0] + stress[1]),
                         std::sqrt(half * half + stress[2] * stress[2]));
}

/// (1/s) Rate of the strain in the direction of the largest principal stress, from the rate of
/// deformation (1/s: xx, yy, xy); negative while the material shortens there. Where all directions
/// are principal: the mean.
[[nodiscard]] inline double strainRateAlong(const std::array<double, 3>& stress,
                                            const std::array<double, 3>& rate) {
  const double half = .5 * (stress[0] - stress[1]);
  const double radius = std::sqrt(half * half + stress[2] * stress[2]);
  const double mean = .5 * (rate[0] + rate[1]);
  if (radius == 0) return mean;
  return mean + (.5 * (rate[0] - rate[1]) * half + rate[2] * stress[2]) / radius;
}

// --- Traction that an edge transmits at the tip of a notch or a crack. The stress averaged around
// such a node includes the unloaded material behind the tip, so that by this average an edge would
// crack far too late: a notched beam with four elements in the cohesive zone would carry 37 to 53 %
// too much load.

/// True if the triangles around a boundary node fill an angle above kTipAngle, so that the node is
/// the tip of a notch or a crack. `fan`: all these triangles, counter-clockwise.
[[nodiscard]] bool isTip(const Model& model, std::span<const ElementId> fan, NodeId node);

/// Unit normal of an edge, outward from its first triangle.
[[nodiscard]] Vec2 normalOf(const Model& model, const CrackEdges& edges, EdgeId edge);

/// (Pa) Traction that holds the triangles on the two sides of an edge together at the tip where it
/// ends, from the forces of their present stress, if both sides move with the same acceleration. It
/// acts on half of the edge, and on half of the crack that ends there, which will be cohesive, too.
[[nodiscard]] Traction tipTraction(const Model& model, const CrackEdges& edges, EdgeId edge,
                                   NodeId tip, std::span<const ElementId> fan);

/// Largest pull at the tip of the other edges that end there, over their strength.
[[nodiscard]] double otherPull(const Model& model, const CrackEdges& edges, EdgeId edge, NodeId tip,
                               std::span<const ElementId> fan);

}  // namespace yadefrag
