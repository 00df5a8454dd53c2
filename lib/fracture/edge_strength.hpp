#pragma once
// Strengths of the edges of a brittle body.

#include <cstddef>
#include <cstdint>

#include "mesh/brittle_material.hpp"

namespace yadefrag {

/// (Pa) Strength of one edge. It depends only on the material, its seed and the edge's number, so
/// that it is the same in any order of calls and on any thread. With a Weibull modulus m: the
/// two-parameter distribution of W. Weibull 1951 (J. Appl. Mech. 18, 293, without a lower limit),
/// P(strength < s) = 1 − exp(−(s/σc)ᵐ). σc is therefore the scale, below which 63 % of the edges
/// are; the mean is σc·Γ(1 + 1/m). With a scatter s: uniform in σc(1 ± s). With both: their product
/// over σc. With a reference volume V₀ the scale of an edge is σc(V₀/V)^(1/m), where V is the
/// `volume` (m³) that belongs to the edge. The weakest of n edges that share a volume then has the
/// same distribution for any n: a finer mesh is not weaker (Zhou and Molinari 2004, Int. J. Solids
/// Struct. 41, 6573).
[[nodiscard]] double edgeStrength(const BrittleMaterial& material, std::uint64_t edge,
                                  double volume = 0);

/// (Pa) Probable strength of the strongest of `edges` edges of this volume (m³): by the Weibull
/// distribution one of them would be stronger, by the uniform one none.
[[nodiscard]] double likelyLargestStrength(const BrittleMaterial& material, std::size_t edges,
                                           double volume = 0);

/// Factor of the failure strain and of the spall stress of one triangle, of the same scatter: as
/// the strength of an edge whose material has the strength 1. `volume` (m³): of the triangle.
[[nodiscard]] inline double scatterFactor(BrittleMaterial material, std::uint64_t triangle,
                                          double volume) {
  material.tensileStrength = 1;
  return edgeStrength(material, triangle, volume);
}

}  // namespace yadefrag
