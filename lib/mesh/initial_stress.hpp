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

/// Changes a triangle without stress so that its present shape is stretched by this much: its
/// stress-free edges and area become those before the stretch.
void stretch(Triangles& triangles, ElementId element, const std::array<double, 3>& stretch);

}  // namespace yadefrag
