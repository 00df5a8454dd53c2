#include "fracture/edge_strength.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "core/errors.hpp"
#include "core/random_bits.hpp"
#include "core/tolerances/fracture.hpp"
#include "fracture/brittle_checks.hpp"

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

namespace {

/// (m) Side of an equilateral triangle of the same area.
double sizeOf(const TriangleMesh& mesh, std::size_t triangle) {
  const auto& [a, b, c] = mesh.triangles[triangle];
  const double area =
      std::abs(cross(mesh.nodes[b] - mesh.nodes[a], mesh.nodes[c] - mesh.nodes[a])) / 2;
  return 2 * std::sqrt(area / std::numbers::sqrt3);
}

/// Values by triangle: those that are given, or those of the materials.
template <class OfMaterial>
void complete(std::vector<double>& values, std::size_t count, OfMaterial ofMaterial) {
  if (!values.empty()) return;
  values.resize(count);
  for (std::size_t t = 0; t < count; ++t) values[t] = ofMaterial(t);
}

}  // namespace

CoarseMesh coarseMeshNamed(const std::string& name) {
  if (name == "warn") return CoarseMesh::kWarn;
  if (name == "strength") return CoarseMesh::kStrength;
  if (name == "energy") return CoarseMesh::kEnergy;
  throw InputError(
      fmt::format("coarseMesh is '{:.60}'; it must be 'warn', 'strength' or 'energy'.", name));
}

double cohesiveZone(double young, double energy, double strength, const BrittleMaterial& material) {
  return young / strength * (energy * material.softening.steepPart()) / strength *
         std::min(1., slidingZone(material));
}

FittedValues fitToMesh(const TriangleMesh& mesh, const MaterialsOfMesh& body,
                       BrittlePlaces& places) {
  const auto isKept = [](CoarseMesh choice) { return choice == CoarseMesh::kWarn; };
  if (std::ranges::all_of(body.choices, isKept)) return {};
  const std::size_t count = mesh.triangles.size();
  const auto numberOf = [&](std::size_t t) { return body.numbers.empty() ? 0 : body.numbers[t]; };
  const auto brittleOf = [&](std::size_t t) -> const BrittleMaterial& {
    return body.materials[numberOf(t)].brittle;
  };
  FittedValues fitted;
  std::vector<double> strength = places.strength, energy = places.fractureEnergy;
  complete(strength, count, [&](std::size_t t) { return brittleOf(t).tensileStrength; });
  complete(energy, count, [&](std::size_t t) { return brittleOf(t).fractureEnergy; });
  for (std::size_t t = 0; t < count; ++t) {
    const CoarseMesh choice = body.choices[numberOf(t)];
    if (isKept(choice) || !brittleOf(t).cracks() || energy[t] <= 0) continue;
    const double young = body.materials[numberOf(t)].material.young;
    const double zone = cohesiveZone(young, energy[t], strength[t], brittleOf(t));
    const double part = zone / (tolerance::kZoneElements * sizeOf(mesh, t));
    if (part >= 1) continue;
    ++fitted.triangles;
    if (choice == CoarseMesh::kStrength) {
      strength[t] *= std::sqrt(part);
      fitted.leastStrength = std::min(fitted.leastStrength, std::sqrt(part));
    } else {
      energy[t] /= part;
      fitted.mostEnergy = std::max(fitted.mostEnergy, 1 / part);
    }
  }
  if (fitted.triangles == 0) return fitted;
  // A triangle that never cracks has no valid strength: 'places' needs one, which is ignored.
  for (double& one : strength)
    if (one <= 0) one = kUnbreakable;
  places.strength = std::move(strength), places.fractureEnergy = std::move(energy);
  return fitted;
}

}  // namespace yadefrag
