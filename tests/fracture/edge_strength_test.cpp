// Strengths of edges, and values for triangles that do not resolve the cohesive zone.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <vector>

#include "core/errors.hpp"
#include "core/tolerances/fracture.hpp"
#include "fracture/brittle_checks.hpp"
#include "fracture/crack_edges.hpp"
#include "fracture/edge_strength.hpp"
#include "mesh/assembly.hpp"
#include "meshing/triangulate.hpp"
#include "step/bodies.hpp"

namespace yadefrag::test {
namespace {

constexpr std::size_t kEdges = 100000;
constexpr double kStrength = 300e6;
// Kolmogorov–Smirnov: a fair sample lies farther off than 1.63/√n once in a hundred times.
const double kFarthest = 1.63 / std::sqrt(kEdges);

BrittleMaterial weibull(double modulus, std::uint64_t seed = 7) {
  return {.tensileStrength = kStrength, .weibullModulus = modulus, .seed = seed};
}

BrittleMaterial even(double scatter, std::uint64_t seed = 7) {
  return {.tensileStrength = kStrength, .strengthScatter = scatter, .seed = seed};
}

std::vector<double> strengths(const BrittleMaterial& material) {
  std::vector<double> result(kEdges);
  for (std::size_t i = 0; i < kEdges; ++i) result[i] = edgeStrength(material, i);
  return result;
}

double mean(const std::vector<double>& values) {
  double sum = 0;
  for (const double v : values) sum += v;
  return sum / values.size();
}

double deviation(const std::vector<double>& values) {
  const double middle = mean(values);
  double sum = 0;
  for (const double v : values) sum += (v - middle) * (v - middle);
  return std::sqrt(sum / values.size());
}

/// Correlation of a with b, which are equally long.
double correlation(const std::vector<double>& a, const std::vector<double>& b) {
  const double middleA = mean(a);
  const double middleB = mean(b);
  double sum = 0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += (a[i] - middleA) * (b[i] - middleB);
  return sum / (a.size() * deviation(a) * deviation(b));
}

/// Largest distance of the sample's distribution from the wanted one.
double farthest(std::vector<double> values, const std::function<double(double)>& distribution) {
  std::sort(values.begin(), values.end());
  double most = 0;
  for (std::size_t i = 0; i < values.size(); ++i) {
    const double wanted = distribution(values[i]);
    most = std::max({most, std::abs(wanted - static_cast<double>(i) / values.size()),
                     std::abs(wanted - static_cast<double>(i + 1) / values.size())});
  }
  return most;
}

/// Of the strength, with mean and deviation to three deviations of the sample's mean; `wide`: that
/// of the deviation, in these.
void expectDistribution(const std::vector<double>& sample,
                        const std::function<double(double)>& distribution, double middle,
                        double spread, double wide = 1) {
  const double tolerance = 3 * spread / std::sqrt(kEdges);
  EXPECT_LT(farthest(sample, [&](double s) { return distribution(s / kStrength); }), kFarthest);
  EXPECT_NEAR(mean(sample) / kStrength, middle, tolerance);
  EXPECT_NEAR(deviation(sample) / kStrength, spread, wide * tolerance);
}

TEST(EdgeStrength, FollowsTheWeibullAndTheEvenDistribution) {
  for (const double m : {1., 2., 20., 50.}) {
    SCOPED_TRACE(m);
    const double first = std::tgamma(1 + 1 / m);
    expectDistribution(
        strengths(weibull(m)), [&](double s) { return -std::expm1(-std::pow(s, m)); }, first,
        std::sqrt(std::tgamma(1 + 2 / m) - first * first), 1.5);  // up to √2 at m = 1
  }
  const double s = .3;
  const std::vector<double> sample = strengths(even(s));
  expectDistribution(
      sample, [&](double x) { return (x - 1 + s) / (2 * s); }, 1, s / std::sqrt(3.));
  EXPECT_GT(*std::min_element(sample.begin(), sample.end()), (1 - s) * kStrength);
  EXPECT_LT(*std::max_element(sample.begin(), sample.end()), (1 + s) * kStrength);
}

TEST(EdgeStrength, OfBothScattersIsTheirProduct) {
  BrittleMaterial both = weibull(20);
  both.strengthScatter = .1;
  const BrittleMaterial none{.tensileStrength = kStrength, .seed = 3};
  EXPECT_EQ(edgeStrength(none, 1ull << 40), kStrength);
  for (std::uint64_t edge = 0; edge < 1000; ++edge)
    EXPECT_NEAR(edgeStrength(both, edge),
                edgeStrength(weibull(20), edge) * edgeStrength(even(.1), edge) / kStrength,
                1e-15 * 2 * kStrength);
}

TEST(EdgeStrength, DrawsEdgesSeedsAndScattersApart) {
  const double limit = 4 / std::sqrt(kEdges);
  const std::vector<double> a = strengths(weibull(1, 7));
  const std::vector<double> next = strengths(weibull(1, 8));
  const std::vector<double> other = strengths(even(.5, 7));
  EXPECT_LT(std::abs(correlation(a, next)), limit);
  EXPECT_LT(std::abs(correlation(a, other)), limit);
  for (std::size_t lag : {1, 2, 64}) {
    const std::vector<double> head(a.begin(), a.end() - lag);
    const std::vector<double> tail(a.begin() + lag, a.end());
    const std::vector<double> shifted(next.begin() + lag, next.end());
    EXPECT_LT(std::abs(correlation(head, tail)), limit) << lag;
    EXPECT_LT(std::abs(correlation(head, shifted)), limit) << lag;
  }
}

TEST(EdgeStrength, KeepsItsNumbersFromReleaseToRelease) {
  // A saved scene and a published run name a seed only.
  EXPECT_NEAR(edgeStrength(weibull(20, 0), 0) / kStrength, .9092983083681552, 1e-12);
  EXPECT_NEAR(edgeStrength(weibull(20, 7), 12345) / kStrength, 1.021994820635705, 1e-12);
  EXPECT_NEAR(edgeStrength(even(.3, 7), 12345) / kStrength, .7437226364983984, 1e-12);
}

// Of n edges that share a volume the weakest has one distribution, for any n: that of one edge of
// the whole volume. Without V₀ the weakest of 100 would be 100^(1/m) times as weak.
TEST(EdgeStrength, WeakestOfAVolumeDoesNotDependOnTheNumberOfEdges) {
  constexpr std::size_t kBodies = 2000;
  BrittleMaterial material = weibull(5);
  material.referenceVolume = 3;
  for (const std::size_t n : {1, 10, 50}) {
    const double volume = 2;
    const double scale = kStrength * std::pow(3. / 2, 1. / 5);
    std::vector<double> weakest(kBodies, INFINITY);
    for (std::size_t body = 0; body < kBodies; ++body)
      for (std::size_t i = 0; i < n; ++i)
        weakest[body] = std::min(
            weakest[body], edgeStrength(material, body * n + i, volume / static_cast<double>(n)));
    EXPECT_LT(farthest(weakest, [&](double s) { return -std::expm1(-std::pow(s / scale, 5)); }),
              1.63 / std::sqrt(kBodies))
        << n;
  }
  material.referenceVolume = 0;
  EXPECT_EQ(edgeStrength(material, 3, 1e-9), edgeStrength(weibull(5), 3));
  BrittleMaterial scattered = even(.3);
  scattered.referenceVolume = 3;
  EXPECT_EQ(edgeStrength(scattered, 3, 1e-9), edgeStrength(even(.3), 3));
}

/// A square metre in n × n crossed quads.
CrackEdges edgesOf(int n, const BrittleMaterial& material) {
  Model model;
  Component body;
  body.material = {1, 0, 1};
  body.brittle = material;
  body.thickness = .5;
  const auto mesh = structuredRectangle({0, 0}, {1, 1}, n, n, QuadPattern::kCrossed);
  CrackEdges edges;
  edges.addBody(model, appendBody(model, mesh, body));
  return edges;
}

// The edges of a body share its volume, but for what would belong to its outline.
TEST(EdgeStrength, FinerMeshesAreNotWeaker) {
  BrittleMaterial material = weibull(4);
  double mean[2] = {0, 0}, meanWithout[2] = {0, 0};
  for (std::uint64_t seed = 0; seed < 200; ++seed)
    for (const int k : {0, 1}) {
      material.seed = seed;
      material.referenceVolume = .5;
      const auto least = [&] {
        const CrackEdges edges = edgesOf(k == 0 ? 5 : 20, material);
        return *std::min_element(edges.strength.begin(), edges.strength.end()) / kStrength / 200;
      };
      mean[k] += least();
      material.referenceVolume = 0;
      meanWithout[k] += least();
    }
  // Γ(1 + 1/4), with three deviations of the mean; the outline's part of the volume has no edge.
  EXPECT_NEAR(mean[0], std::tgamma(1.25), .08);
  EXPECT_NEAR(mean[1], std::tgamma(1.25), .06);
  EXPECT_LT(meanWithout[1], .6 * meanWithout[0]);
}

TEST(LikelyLargestStrength, IsExceededByOneEdgeOnAverage) {
  std::size_t above = 0;
  for (std::uint64_t seed = 0; seed < 100; ++seed) {
    const BrittleMaterial material = weibull(10, seed);
    const double largest = likelyLargestStrength(material, 1000);
    for (std::uint64_t edge = 0; edge < 1000; ++edge)
      above += edgeStrength(material, edge) > largest ? 1 : 0;
  }
  EXPECT_NEAR(above, 100, 30);  // three deviations of a Poisson number
  EXPECT_DOUBLE_EQ(likelyLargestStrength(even(.3), 1000), 1.3 * kStrength);
  EXPECT_EQ(likelyLargestStrength(even(0), 1000), kStrength);
  EXPECT_EQ(likelyLargestStrength(weibull(10), 1), kStrength);
}

// --- Strength or fracture energy for triangles that do not resolve the cohesive zone.

constexpr double kYoung = 70e9, kGlassStrength = 60e6, kEnergy = 300;  // zone: 5.8 mm
constexpr double kZone = kYoung * kEnergy / (kGlassStrength * kGlassStrength);

BodyMaterial glass() { return brittle({kYoung, .2, 2500, false}, kGlassStrength, kEnergy); }

/// Triangles from a tenth of the zone to the whole of it: some resolve it.
TriangleMesh graded() {
  const SizeField sizes{{0, 0}, .06, 2, {.1 * kZone, kZone, .1 * kZone, kZone}};
  return triangulate({{{0, 0}, {.06, 0}, {.06, .02}, {0, .02}}, {}}, sizes,
                     {NodeLayout::kScattered, 1});
}

/// (m) From the lengths of the sides, by Heron's formula.
double sizeOf(const TriangleMesh& mesh, std::size_t t) {
  const auto& [i, j, k] = mesh.triangles[t];
  const double a = norm(mesh.nodes[i] - mesh.nodes[j]), b = norm(mesh.nodes[j] - mesh.nodes[k]),
               c = norm(mesh.nodes[k] - mesh.nodes[i]), s = (a + b + c) / 2;
  return std::sqrt(4 * std::sqrt(s * (s - a) * (s - b) * (s - c)) / std::numbers::sqrt3);
}

FittedValues fit(const TriangleMesh& mesh, const BodyMaterial& one, CoarseMesh choice,
                 BrittlePlaces& places) {
  return fitToMesh(mesh, {{&one, 1}, {&choice, 1}, {}}, places);
}

/// Every triangle has a zone of at least four elements afterwards, exactly four if it had less
/// before, and the value that is to be kept.
TEST(CoarseMesh, ZonesHaveFourElementsAndOneValueIsKept) {
  const TriangleMesh mesh = graded();
  const BodyMaterial one = glass();
  for (const CoarseMesh choice : {CoarseMesh::kStrength, CoarseMesh::kEnergy}) {
    BrittlePlaces places;
    const FittedValues fitted = fit(mesh, one, choice, places);
    const bool keepsEnergy = choice == CoarseMesh::kStrength;
    ASSERT_EQ(places.strength.size(), mesh.triangles.size());
    ASSERT_EQ(places.fractureEnergy.size(), mesh.triangles.size());
    std::size_t changed = 0;
    double extreme = 1;
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
      const double strength = places.strength[t], energy = places.fractureEnergy[t];
      const double wanted = tolerance::kZoneElements * sizeOf(mesh, t);
      const double zone = kYoung * energy / (strength * strength);
      if (wanted > kZone) {
        ++changed;
        ASSERT_NEAR(zone, wanted, 1e-9 * wanted);
      } else {
        ASSERT_EQ(strength, kGlassStrength);
        ASSERT_EQ(energy, kEnergy);
      }
      ASSERT_EQ(keepsEnergy ? energy / kEnergy : strength / kGlassStrength, 1);
      extreme = keepsEnergy ? std::min(extreme, strength / kGlassStrength)
                            : std::max(extreme, energy / kEnergy);
    }
    EXPECT_GT(changed, 0U);
    EXPECT_LT(changed, mesh.triangles.size());
    EXPECT_EQ(fitted.triangles, changed);
    EXPECT_DOUBLE_EQ(keepsEnergy ? fitted.leastStrength : fitted.mostEnergy, extreme);
    EXPECT_EQ(keepsEnergy ? fitted.mostEnergy : fitted.leastStrength, 1);
  }
}

TEST(CoarseMesh, NothingChangesWhereNothingIsChosenOrNeeded) {
  const TriangleMesh mesh = graded();
  BodyMaterial one = glass();
  BrittlePlaces places;
  EXPECT_EQ(fit(mesh, one, CoarseMesh::kWarn, places).triangles, 0U);
  one.brittle.fractureEnergy = 0;  // cracks open at once: no zone
  EXPECT_EQ(fit(mesh, one, CoarseMesh::kStrength, places).triangles, 0U);
  one.brittle.fractureEnergy = 100 * kEnergy;
  EXPECT_EQ(fit(mesh, one, CoarseMesh::kStrength, places).triangles, 0U);
  EXPECT_TRUE(places.empty());
}

/// Values by triangle are those that are fitted; each material has its own choice, and one that
/// does not crack has none.
TEST(CoarseMesh, ValuesByTriangleAndSeveralMaterials) {
  const TriangleMesh mesh = graded();
  const std::size_t count = mesh.triangles.size();
  BrittlePlaces places;
  places.strength.assign(count,
                         2 * kGlassStrength);  // a zone of a quarter: one element of the finest
  places.fractureEnergy.assign(count, kEnergy);
  const BodyMaterial one = glass();
  EXPECT_EQ(fit(mesh, one, CoarseMesh::kEnergy, places).triangles, count);
  for (std::size_t t = 0; t < count; ++t) {
    ASSERT_EQ(places.strength[t], 2 * kGlassStrength);
    ASSERT_NEAR(places.fractureEnergy[t] / (16 * sizeOf(mesh, t) / kZone * kEnergy), 1, 1e-9);
  }

  const std::vector<BodyMaterial> materials{glass(), glass(), {{1e9, .2, 1000, false}, {}, 0, {}}};
  const std::vector<CoarseMesh> choices{CoarseMesh::kStrength, CoarseMesh::kWarn,
                                        CoarseMesh::kWarn};
  std::vector<std::uint32_t> numbers(count);
  for (std::size_t t = 0; t < count; ++t) numbers[t] = t % 3;
  BrittlePlaces mixed;
  const FittedValues fitted = fitToMesh(mesh, {materials, choices, numbers}, mixed);
  std::size_t changed = 0;
  for (std::size_t t = 0; t < count; ++t) {
    ASSERT_GT(mixed.strength[t], 0) << "as BrittlePlaces requires";
    ASSERT_TRUE(numbers[t] != 1 || mixed.strength[t] == kGlassStrength);
    if (numbers[t] == 0 && mixed.strength[t] < kGlassStrength) ++changed;
  }
  EXPECT_GT(changed, 0U);
  EXPECT_EQ(fitted.triangles, changed);
}

/// A sliding crack has the shorter zone if κ < β²; a curve with a steep part that of its slope.
TEST(CoarseMesh, LengthOfTheZone) {
  BrittleMaterial one;
  EXPECT_DOUBLE_EQ(cohesiveZone(kYoung, kEnergy, kGlassStrength, one), kZone);
  one.shearFactor = 2;
  EXPECT_DOUBLE_EQ(cohesiveZone(kYoung, kEnergy, kGlassStrength, one), kZone / 4);
  one.shearEnergyFactor = 4;
  EXPECT_DOUBLE_EQ(cohesiveZone(kYoung, kEnergy, kGlassStrength, one), kZone);
  one.softening = softeningNamed("bilinear");
  EXPECT_NEAR(cohesiveZone(kYoung, kEnergy, kGlassStrength, one), .6 * kZone, 1e-9 * kZone);
}

TEST(CoarseMesh, NamesAreKnown) {
  EXPECT_EQ(coarseMeshNamed("warn"), CoarseMesh::kWarn);
  EXPECT_EQ(coarseMeshNamed("strength"), CoarseMesh::kStrength);
  EXPECT_EQ(coarseMeshNamed("energy"), CoarseMesh::kEnergy);
  EXPECT_THROW((void)coarseMeshNamed("Strength"), InputError);
}

}  // namespace
}  // namespace yadefrag::test
