#pragma once
// Initial stress: the stress-free shape of triangles that are stressed in their present shape.

#include <array>
#include <optional>

#include "mesh/elastic_material.hpp"
#include "mesh/model.hpp"

namespace yadefrag {

/// The symmetric stretch (xx, yy, xy) that causes a Cauchy stress (Pa; xx, yy, xy, tension
/// positive) by the material law of dynamics/elastic_law.hpp; no value if a principal stretch
/// exceeds tolerance::kMostStretch.
[[nodiscard]] std::optional<std::array<double, 3>> stretchOf(const ElasticMaterial& material,
                                                             const std::array<double, 3>& stress);

/// Stretches in the plane and across it.
struct SpatialStretch {
  std::array<double, 3> plane;
  double across;
};
/// The same with a given stress across the plane (Pa), by the law of materials that yield
/// (dynamics/yield_law.hpp).
[[nodiscard]] std::optional<SpatialStretch> stretchOf(const ElasticMaterial& material,
                                                      const std::array<double, 3>& stress,
                                                      double across);

/// Changes a triangle without stress so that its present shape is stretched by this much: its
/// stress-free edges and area become those before the stretch.
void stretch(Triangles& triangles, ElementId element, const std::array<double, 3>& stretch);

}  // namespace yadefrag
