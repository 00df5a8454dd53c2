#include "fracture/edge_strength.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/random_bits.hpp"

namespace yadefrag {
namespace {

/// The two scatters have independent random numbers, so that both may be used together.
enum Stream : std::uint64_t { kWeibull = 1, kEven = 2 };

/// Uniform in the open interval (0, 1): number `edge` of SplitMix64's sequence, computed directly.
double uniform(std::uint64_t seed, Stream stream, std::uint64_t edge) {
  // Otherwise consecutive seeds would share their sequences, shifted by one edge.
  const std::uint64_t start = mixBits(mixBits(seed + kRandomStride) + stream * kRandomStride);
  const std::uint64_t bits = mixBits(start + (edge + 1) * kRandomStride);
  return (static_cast<double>(bits >> 12) + .5) * 0x1p-52;  // 53 bits: exact
}

/// (Pa) Scale of the Weibull distribution: 63 % of the edges of this volume (m³) are weaker.
double scaleOf(const BrittleMaterial& material, double volume) {
  if (material.weibullModulus <= 0 || material.referenceVolume <= 0)
    return material.tensileStrength;
  return material.tensileStrength *
         std::pow(material.referenceVolume / volume, 1 / material.weibullModulus);
}

/// Limits the power of a small modulus to the range of finite numbers.
double inRange(double strength) {
  return std::clamp(strength, std::numeric_limits<double>::min(),
                    std::numeric_limits<double>::max());
}

}  // namespace

double edgeStrength(const BrittleMaterial& material, std::uint64_t edge, double volume) {
  double strength = scaleOf(material, volume);
  if (material.weibullModulus > 0)
    strength *=
        std::pow(-std::log1p(-uniform(material.seed, kWeibull, edge)), 1 / material.weibullModulus);
  if (material.strengthScatter > 0)
    strength *= 1 + material.strengthScatter * (2 * uniform(material.seed, kEven, edge) - 1);
  return inRange(strength);
}

double likelyLargestStrength(const BrittleMaterial& material, std::size_t edges, double volume) {
  double strength = scaleOf(material, volume) * (1 + material.strengthScatter);
  if (material.weibullModulus > 0)  // with one or two edges: at least the scale
    strength *=
        std::pow(std::max(1., std::log(static_cast<double>(edges))), 1 / material.weibullModulus);
  return inRange(strength);
}

}  // namespace yadefrag
