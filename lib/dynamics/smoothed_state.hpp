#pragma once
// Energy and stress of bodies with smoothed strains (smoothed_law.hpp), for output and for books.

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "dynamics/smoothed_law.hpp"
#include "mesh/model.hpp"

namespace yadefrag {

/// The gradient F of the triangles at a node, summed by thirds of their volumes, now and a step
/// ago.
struct NodeSum {
  SplitGradient now, before;  ///< m³
  double volume = 0;          ///< m³

  void add(const Model& model, ElementId element, double dt);
  NodeSum& operator+=(const NodeSum& other);
  /// (J) The node's share of the energy at the half step (energy_ledger.hpp).
  [[nodiscard]] double energy(const ElasticMaterial& material) const;
};

// The following leave out all bodies without smoothed strains.

/// (J) At the half step.
double smoothedEnergy(const Model& model, double dt);
/// The same of some triangles, at whose nodes there are no others.
double smoothedEnergy(const Model& model, std::span<const ElementId> elements, double dt);

/// Sets the Cauchy stresses (Pa: xx, yy, xy), by triangle: those that make its forces.
void setSmoothedStresses(const Model& model, std::vector<std::array<double, 3>>& stresses);
/// Sets the energies (J), by triangle: its own, and its shares of the nodes'.
void setSmoothedEnergies(const Model& model, std::vector<double>& energies);

}  // namespace yadefrag
