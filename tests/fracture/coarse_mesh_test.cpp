// Strength or fracture energy for triangles that do not resolve the cohesive zone.

#include "fracture/coarse_mesh.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "core/errors.hpp"
#include "core/tolerances/fracture.hpp"
#include "meshing/triangulate.hpp"

namespace yadefrag::test {
namespace {

constexpr double kYoung = 70e9, kStrength = 60e6, kEnergy = 300;  // zone: 5.8 mm
constexpr double kZone = kYoung * kEnergy / (kStrength * kStrength);

BodyMaterial glass() {
  BodyMaterial one;
  one.material = {kYoung, .2, 2500, false};
  one.brittle.tensileStrength = kStrength;
  one.brittle.fractureEnergy = kEnergy;
  return one;
}

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
        ASSERT_EQ(strength, kStrength);
        ASSERT_EQ(energy, kEnergy);
      }
      ASSERT_EQ(keepsEnergy ? energy / kEnergy : strength / kStrength, 1);
      extreme = keepsEnergy ? std::min(extreme, strength / kStrength)
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
  places.strength.assign(count, 2 * kStrength);  // a zone of a quarter: one element of the finest
  places.fractureEnergy.assign(count, kEnergy);
  const BodyMaterial one = glass();
  EXPECT_EQ(fit(mesh, one, CoarseMesh::kEnergy, places).triangles, count);
  for (std::size_t t = 0; t < count; ++t) {
    ASSERT_EQ(places.strength[t], 2 * kStrength);
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
    ASSERT_TRUE(numbers[t] != 1 || mixed.strength[t] == kStrength);
    if (numbers[t] == 0 && mixed.strength[t] < kStrength) ++changed;
  }
  EXPECT_GT(changed, 0U);
  EXPECT_EQ(fitted.triangles, changed);
}

/// A sliding crack has the shorter zone if κ < β²; a curve with a steep part that of its slope.
TEST(CoarseMesh, LengthOfTheZone) {
  BrittleMaterial one;
  EXPECT_DOUBLE_EQ(cohesiveZone(kYoung, kEnergy, kStrength, one), kZone);
  one.shearFactor = 2;
  EXPECT_DOUBLE_EQ(cohesiveZone(kYoung, kEnergy, kStrength, one), kZone / 4);
  one.shearEnergyFactor = 4;
  EXPECT_DOUBLE_EQ(cohesiveZone(kYoung, kEnergy, kStrength, one), kZone);
  one.softening = softeningNamed("bilinear");
  EXPECT_NEAR(cohesiveZone(kYoung, kEnergy, kStrength, one), .6 * kZone, 1e-9 * kZone);
}

TEST(CoarseMesh, NamesAreKnown) {
  EXPECT_EQ(coarseMeshNamed("warn"), CoarseMesh::kWarn);
  EXPECT_EQ(coarseMeshNamed("strength"), CoarseMesh::kStrength);
  EXPECT_EQ(coarseMeshNamed("energy"), CoarseMesh::kEnergy);
  EXPECT_THROW((void)coarseMeshNamed("Strength"), InputError);
}

}  // namespace
}  // namespace yadefrag::test
