#include "core/four_lanes.hpp"

#include <gtest/gtest.h>

#include <array>
#include <random>

#include "core/instruction_set.hpp"

namespace yadefrag {
namespace {

using Four = std::array<double, 4>;

struct Results {
  Four cross, product;
  double dot, norm, squaredNormOfFour;
};

Results byLanes(InstructionSet set, const Four& a, const Four& b) {
  Results results;
  runFor(
      set, [&]() __attribute__((always_inline)) {
        const FourLanes one = loadFour(a.data()), two = loadFour(b.data());
        storeFour(cross(one, two), results.cross.data());
        storeFour(quaternionProduct(one, two), results.product.data());
        results.dot = dot(one, two);
        results.norm = norm(one);
        results.squaredNormOfFour = squaredNormOfFour(one);
      });
  return results;
}

// By the formulas of Eigen without vectors, component by component.
Results byComponents(const Four& a, const Four& b) {
  const auto& [ax, ay, az, aw] = a;
  const auto& [bx, by, bz, bw] = b;
  Results results;
  results.cross = {ay * bz - az * by, az * bx - ax * bz, ax * by - ay * bx, 0};
  results.product = {aw * bx + ax * bw + ay * bz - az * by, aw * by + ay * bw + az * bx - ax * bz,
                     aw * bz + az * bw + ax * by - ay * bx, aw * bw - ax * bx - ay * by - az * bz};
  results.dot = ax * bx + (ay * by + az * bz);
  results.norm = std::sqrt(ax * ax + (ay * ay + az * az));
  results.squaredNormOfFour = (ax * ax + ay * ay) + (az * az + aw * aw);
  return results;
}

class FourLanesOf : public testing::TestWithParam<InstructionSet> {};

TEST_P(FourLanesOf, HaveTheBitsOfComponents) {
  if (GetParam() == InstructionSet::kAvx2 && bestInstructionSet() != InstructionSet::kAvx2) {
    GTEST_SKIP() << "no AVX2";
  }
  std::mt19937_64 random(7);
  std::normal_distribution<double> anyValue(0, 3);
  for (int i = 0; i < 2000; ++i) {
    Four a, b;
    for (double& value : a) value = anyValue(random);
    for (double& value : b) value = anyValue(random);
    const Results lanes = byLanes(GetParam(), a, b), components = byComponents(a, b);
    for (std::size_t k = 0; k < 3; ++k) EXPECT_EQ(lanes.cross[k], components.cross[k]);
    EXPECT_EQ(lanes.product, components.product);
    EXPECT_EQ(lanes.dot, components.dot);
    EXPECT_EQ(lanes.norm, components.norm);
    EXPECT_EQ(lanes.squaredNormOfFour, components.squaredNormOfFour);
  }
}

INSTANTIATE_TEST_SUITE_P(Sets, FourLanesOf,
                         testing::Values(InstructionSet::kBaseline, InstructionSet::kAvx2));

TEST(FourLanes, ThreeLeavesTheFourthValue) {
  Four stored = {1, 2, 3, 4};
  storeThree(loadThree(stored.data()) * 2., stored.data());
  EXPECT_EQ(stored, (Four{2, 4, 6, 4}));
}

}  // namespace
}  // namespace yadefrag
