// Hertzian contact: half cylinder on a block, at rest.
//
// Our finest mesh (edges of 0.12 and 0.08 mm, 111 loaded nodes) gives
// p₀ = 3622 MPa, and 3621 MPa at 0.19 and 0.125 mm: 1.0 % above Hertz's two half spaces, which the
// block of sixteen half widths and the strains of some per cent are not.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

#include "core/checks.hpp"
#include "step/bodies.hpp"

namespace yadefrag::test {
namespace {

/// The case, in SI units, and its closed form (plane strain, two half spaces).
struct Hertz {
  double radius = .05;  ///< m, of the cylinder
  double line = 35e6;   ///< N/m, load
  ElasticMaterial cylinder{210e9, .3, 7800, false};
  ElasticMaterial block{70e9, .3, 2600, false};  ///< waves as fast as in the cylinder

  [[nodiscard]] double modulus() const {  // Pa, E*
    const auto compliance = [](const ElasticMaterial& m) {
      return (1 - m.poisson * m.poisson) / m.young;
    };
    return 1 / (compliance(cylinder) + compliance(block));
  }
  [[nodiscard]] double halfWidth() const {  // m
    return std::sqrt(4 * line * radius / (std::numbers::pi * modulus()));
  }
  /// Pa, p₀
  [[nodiscard]] double pressure() const { return 2 * line / (std::numbers::pi * halfWidth()); }
};

struct HertzMesh {
  double cylinder, block;  ///< m, edges at the contact
  bool smooth = false;
  int passes = 2;
};

struct PressureAt {
  double x, p;  ///< m, Pa
};

/// What is measured once all is at rest.
struct HertzResult {
  double peak = 0;         ///< Pa, p₀ by least squares of p² = p₀²(1 − x²/a²)
  double fitted = 0;       ///< m, a of the same fit
  double touching = 0;     ///< m, half of what the loaded nodes cover
  double rough = 0;        ///< rms of p − fit within 0.9 a, over p₀
  double waviness = 0;     ///< rms of second differences of p − fit within 0.9 a, over p₀
  double total = 0;        ///< contact force over load
  double kinetic = 0;      ///< over strain energy
  double penetration = 0;  ///< m
  std::vector<PressureAt> profile;
};

constexpr double kSize = .01;             // m, of edges far from the contact
constexpr double kWide = .1, kDeep = .1;  // m, half width and depth of the block

/// Distances from the contact's middle up to `end`: even by `fine` where there may be contact, then
/// wider and wider.
std::vector<double> graded(double fine, double even, double end) {
  std::vector<double> at{0};
  while (at.back() < end) {
    const double step = std::min(kSize, fine + std::max(0., .25 * (at.back() - even)));
    at.push_back(at.back() + step);
  }
  const double scale = end / at.back();
  for (double& s : at) s *= scale;
  return at;
}

/// From −end to end, both left out.
std::vector<double> bothSides(const std::vector<double>& right) {
  std::vector<double> all;
  for (std::size_t i = right.size() - 1; i-- > 1;) all.push_back(-right[i]);
  all.insert(all.end(), right.begin(), right.end() - 1);
  return all;
}

TriangleMesh halfCylinder(const Hertz& hertz, double fine) {
  const double r = hertz.radius;
  Polygon polygon;
  polygon.outline = {{r, r}, {0, r}, {-r, r}};
  for (const double s : bothSides(graded(fine, 1.5 * hertz.halfWidth(), std::numbers::pi / 2 * r)))
    polygon.outline.push_back({r * std::sin(s / r), r - r * std::cos(s / r)});
  return triangulate(polygon, kSize);
}

TriangleMesh plate(const Hertz& hertz, double fine) {
  Polygon polygon;
  polygon.outline = {{-kWide, -kDeep}, {kWide, -kDeep}, {kWide, 0}};
  std::vector<double> top = bothSides(graded(fine, 1.5 * hertz.halfWidth(), kWide));
  for (auto s = top.rbegin(); s != top.rend(); ++s) polygon.outline.push_back({*s, 0});
  polygon.outline.push_back({-kWide, 0});
  return triangulate(polygon, kSize);
}

/// Nodes where the surfaces can meet become smooth.
void smoothNear(BodySpec& spec, const TriangleMesh& mesh, double reach) {
  spec.smoothNodes.assign(mesh.nodes.size(), 0);
  for (const std::uint32_t node : mesh.loops[0])
    if (std::abs(mesh.nodes[node].x) < reach && std::abs(mesh.nodes[node].y) < reach)
      spec.smoothNodes[node] = 1;
}

/// Nodal contact force over tributary length along a body's boundary, where there is any.
std::vector<PressureAt> pressures(const World& world, ComponentId on) {
  std::vector<PressureAt> profile;
  const ContactSurfaces& surfaces = world.surfaces;
  const auto& x = world.model.nodes.position;
  for (std::size_t s = 0; s < surfaces.segments(); ++s) {
    const NodeId node = surfaces.segmentNode[s];
    const double force = norm(world.contact.forces()[node.value]);
    if (world.model.nodes.component[node.value] != on || force == 0) continue;
    const Vec2 before = x[surfaces.segmentNode[surfaces.segmentPrev[s].value].value];
    const Vec2 after = x[surfaces.segmentNode[surfaces.segmentNext[s].value].value];
    const double length = (norm(x[node.value] - before) + norm(after - x[node.value])) / 2;
    profile.push_back({x[node.value].x, force / length});
  }
  std::sort(profile.begin(), profile.end(),
            [](const PressureAt& a, const PressureAt& b) { return a.x < b.x; });
  return profile;
}

/// Least squares of p² = A − B x².
void fit(HertzResult& result) {
  double n = 0, q = 0, qq = 0, y = 0, qy = 0;
  for (const auto& [x, p] : result.profile) {
    n += 1, q += x * x, qq += x * x * x * x, y += p * p, qy += x * x * p * p;
  }
  const double b = -(n * qy - q * y) / (n * qq - q * q);
  const double a = (y + b * q) / n;
  result.peak = std::sqrt(a);
  result.fitted = std::sqrt(a / b);
}

/// How far from the fit, and how uneven from node to node.
void roughness(HertzResult& result) {
  std::vector<double> off;
  for (const auto& [x, p] : result.profile) {
    const double at = x / result.fitted;
    if (std::abs(at) < .9) off.push_back(p / result.peak - std::sqrt(1 - at * at));
  }
  double sum = 0, second = 0;
  for (const double o : off) sum += o * o;
  for (std::size_t i = 1; i + 1 < off.size(); ++i)
    second += std::pow(off[i - 1] - 2 * off[i] + off[i + 1], 2);
  result.rough = std::sqrt(sum / static_cast<double>(off.size()));
  result.waviness = std::sqrt(second / static_cast<double>(off.size() - 2));
}

HertzResult measure(const World& world, ComponentId coarser, const Hertz& hertz) {
  HertzResult result;
  result.profile = pressures(world, coarser);
  result.total = std::abs(contactForce(world, coarser).y) / hertz.line;
  result.kinetic = world.kineticEnergy() / world.strainEnergy();
  result.penetration = world.contact.maxPenetration();
  result.touching = (result.profile.back().x - result.profile.front().x) / 2;
  fit(result);
  roughness(result);
  return result;
}

HertzResult press(const Hertz& hertz, const HertzMesh& mesh) {
  World world;
  world.contactSettings.passes = mesh.passes;
  const TriangleMesh upper = halfCylinder(hertz, mesh.cylinder), lower = plate(hertz, mesh.block);
  BodySpec a = moving(upper, hertz.cylinder, {}), b = moving(lower, hertz.block, {});
  // The cylinder would roll or slide: its two nodes on the axis of symmetry stay there.
  hold(a, upper, kHeldX, [&](Vec2 x) {
    return norm(x) < 1e-9 || norm(x - Vec2{0, hertz.radius}) < 1e-9;
  });
  hold(b, lower, kHeldXY, [](Vec2 x) { return x.y < -kDeep + 1e-9; });
  if (mesh.smooth) {
    smoothNear(a, upper, .6 * hertz.radius);
    smoothNear(b, lower, .6 * hertz.radius);
  }
  const ComponentId cylinder = world.addBody(upper, a), block = world.addBody(lower, b);
  // An even load on the flat top.
  std::vector<Vec2> loads(world.model.nodes.size());
  addTraction(
      upper, {0, -hertz.line / (2 * hertz.radius)},
      [&](Vec2 x) { return x.y > hertz.radius * (1 - 1e-9); }, loads);
  world.setLoads(loads);
  // The cylinder bouncing on the block: some 5 kHz.
  world.dynamicsSettings.damping = 2 * 2 * std::numbers::pi * 5e3;
  const double dt = .8 * world.criticalTimeStep();
  while (world.time < .7e-3) world.step(dt);
  return measure(world, mesh.cylinder > mesh.block ? cylinder : block, hertz);
}

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
