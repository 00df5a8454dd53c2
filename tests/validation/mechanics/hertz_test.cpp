// Hertzian contact: half cylinder on a block, at rest.
//
// Our finest mesh (edges of 0.12 and 0.08 mm, 111 loaded nodes) gives
// p₀ = 3622 MPa, and 3621 MPa at 0.19 and 0.125 mm: 1.0 % above Hertz's two half spaces, which the
// block of sixteen half widths and the strains of some per cent are not.

#include <gtest/gtest.h>
#include <algorithm>

#include "step/figures.hpp"
#include "step/hertz.hpp"

namespace yadefrag::test {
namespace {

constexpr double kFinest = 3622e6;  // Pa, p₀ of smooth surfaces on our finest mesh
constexpr HertzMesh kCoarse{.cylinder = .75e-3, .block = .5e-3};

void pressed(const HertzMesh& mesh) {
  const Hertz hertz;
  const HertzResult result = press(hertz, mesh);
  record("p0_in_MPa", result.peak / 1e6);
  record("half_width_of_the_fit_in_mm", result.fitted * 1e3);
  record("rms_off_the_ellipse", result.rough);
  record("rms_second_difference", result.waviness);
  record("kinetic_over_strain", result.kinetic);
  figure("p0_over_hertz", result.peak / hertz.pressure(), 1, .04);
  figure("p0_over_finest", result.peak / kFinest, 1, .015);
  // Within one element.
  figure("half_width_in_mm", result.touching * 1e3, hertz.halfWidth() * 1e3,
         std::max(mesh.cylinder, mesh.block) * 1e3);
  figure("contact_force_over_load", result.total, 1, 1e-3);
}

HertzMesh with(HertzMesh mesh, bool smooth, int passes) {
  mesh.smooth = smooth;
  mesh.passes = passes;
  return mesh;
}

TEST(HertzContact, ClosedForm) {
  EXPECT_NEAR(Hertz().halfWidth(), 6.215e-3, 1e-6);
  EXPECT_NEAR(Hertz().pressure(), 3585e6, 1e6);
}

TEST(HertzContact, Smooth) { pressed(with(kCoarse, true, 1)); }
TEST(HertzContact, SmoothInTwoPasses) { pressed(with(kCoarse, true, 2)); }
TEST(HertzContact, Straight) { pressed({.cylinder = .5e-3, .block = .75e-3, .passes = 1}); }
TEST(HertzContact, StraightInTwoPasses) {
  pressed({.cylinder = .5e-3, .block = .75e-3, .passes = 2});
}

// The cylinder coarser than the block: its facets press with their corners where it is straight.
TEST(HertzContact, SmoothSurfacesHaveTheSmootherPressure) {
  const Hertz hertz;
  const HertzResult straight = press(hertz, with(kCoarse, false, 1));
  const HertzResult smooth = press(hertz, with(kCoarse, true, 1));
  record("straight_rms_off_the_ellipse", straight.rough);
  record("smooth_rms_off_the_ellipse", smooth.rough);
  record("straight_p0_in_MPa", straight.peak / 1e6);
  record("times_smoother", straight.waviness / smooth.waviness);
  EXPECT_LT(smooth.rough, .02);
  EXPECT_GT(straight.rough, 8 * smooth.rough);
  EXPECT_GT(straight.waviness, 15 * smooth.waviness);
}

TEST(HertzContact, FinestMesh) {
  pressed({.cylinder = .12e-3, .block = .08e-3, .smooth = true, .passes = 1});
}

}  // namespace
}  // namespace yadefrag::test
