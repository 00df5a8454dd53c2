#pragma once
// How strong each edge of a brittle body is.

#include <cstddef>
#include <cstdint>

#include "mesh/brittle_material.hpp"

namespace yadefrag {

/// (Pa) Strength of one edge. It hangs on the material, its seed and the edge's number alone, so it
/// is the same in any order of asking and on any thread. With a Weibull modulus m, the
/// two-parameter distribution of W. Weibull 1951 (J. Appl. Mech. 18, 293, with no lower limit):
/// P(strength < s) = 1 − exp(−(s/σc)ᵐ). So σc is the scale, below which 63 % of the edges are; the
/// mean is σc·Γ(1 + 1/m). With a scatter s: even in σc(1 ± s). With both, their product over σc.
[[nodiscard]] double edgeStrength(const BrittleMaterial& material, std::uint64_t edge);

/// (Pa) What the strongest of so many edges is likely to have: one edge in `edges` would be
/// stronger by the Weibull distribution, and none by the even one.
[[nodiscard]] double likelyLargestStrength(const BrittleMaterial& material, std::size_t edges);

}  // namespace yadefrag
