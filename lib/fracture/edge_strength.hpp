#pragma once
// How strong each edge of a brittle body is.

#include <cstddef>
#include <cstdint>

#include "mesh/brittle_material.hpp"

namespace yadefrag {

/// (Pa) Strength of one edge. It depends on the material, its seed and the edge's number only, so
/// it is the same in any order of asking and on any thread. With a Weibull modulus m, the
/// two-parameter distribution of W. Weibull 1951 (J. Appl. Mech. 18, 293, with no lower limit):
/// P(strength < s) = 1 − exp(−(s/σc)ᵐ). So σc is the scale, below which 63 % of the edges are; the
/// mean is σc·Γ(1 + 1/m). With a scatter s: even in σc(1 ± s). With both, their product over σc.
/// With a reference volume V₀ the scale of an edge is σc(V₀/V)^(1/m), V the `volume` (m³) that the
/// edge stands for: then the weakest of n edges that share a volume has the same distribution for
/// any n, so a finer mesh is not weaker (Zhou and Molinari 2004, Int. J. Solids Struct. 41, 6573).
[[nodiscard]] double edgeStrength(const BrittleMaterial& material, std::uint64_t edge,
                                  double volume = 0);

/// (Pa) What the strongest of so many edges, each of this volume (m³), is likely to have: one edge
/// in `edges` would be stronger by the Weibull distribution, and none by the even one.
[[nodiscard]] double likelyLargestStrength(const BrittleMaterial& material, std::size_t edges,
                                           double volume = 0);

}  // namespace yadefrag
