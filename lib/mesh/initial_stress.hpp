#pragma once
// Triangles that are stressed where they are: what shape they would have without stress.

#include <array>
#include <optional>

#include "mesh/elastic_material.hpp"
#include "mesh/model.hpp"

namespace yadefrag {

/// The symmetric stretch (xx, yy, xy) by which a material comes to a Cauchy stress (Pa; xx, yy, xy,
/// tension positive) in the law of dynamics/elastic_law.hpp; none where a principal stretch is not
/// within tolerance::kMostStretch.
[[nodiscard]] std::optional<std::array<double, 3>> stretchOf(const ElasticMaterial& material,
                                                             const std::array<double, 3>& stress);

/// From now on a triangle that has no stress would have it after this stretch: its stress-free
/// edges and area are those before it.
void stretch(Triangles& triangles, ElementId element, const std::array<double, 3>& stretch);

}  // namespace yadefrag
