#pragma once
// Energy and stress of bodies with smoothed strains (smoothed_law.hpp), for output and for the
// energy balance.

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "dynamics/smoothed_law.hpp"
#include "mesh/model.hpp"

namespace yadefrag {

/// The gradient F of the triangles at a node, summed with a third of their volumes, now and one
/// step before.
struct NodeSum {
  SplitGradient now, before;  ///< m³
  double volume = 0;          ///< m³

  void add(const Model& model, ElementId element, double dt);
  NodeSum& operator+=(const NodeSum& other);
  /// (J) The node's part of the energy at the half step (energy_ledger.hpp).
  [[nodiscard]] double energy(const ElasticMaterial& material) const;
};

// The following functions ignore all bodies without smoothed strains.

/// (J) Energy at the half step.
double smoothedEnergy(const Model& model, double dt);
/// The same for some triangles; there must be no others at their nodes.
double smoothedEnergy(const Model& model, std::span<const ElementId> elements, double dt);

/// Sets the Cauchy stresses (Pa: xx, yy, xy), by triangle, from which the forces are computed.
void setSmoothedStresses(const Model& model, std::vector<std::array<double, 3>>& stresses);
}  // namespace yadefrag
