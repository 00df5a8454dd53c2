// One triangle that yields, on prescribed paths, compared with closed forms of ideal and hardening
// J2 plasticity. Bodies that yield, in steps: forces, energy balance, undoing, bits.

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "core/errors.hpp"
#include "elements/blocks.hpp"
#include "elements/element_state.hpp"
#include "elements/plastic_return.hpp"

namespace yadefrag {
namespace {

constexpr double kRootThree = std::numbers::sqrt3;

BodyMaterial steel(double hardening = 500e6, double exponent = .3) {
  BodyMaterial m;
  m.material = {.young = 210e9, .poisson = .3, .density = 7800, .planeStress = false};
  m.plastic.yieldStress = 400e6;
  m.plastic.hardening = hardening;
  m.plastic.hardeningExponent = exponent;
  return m;
}

/// A triangle with edges along the axes, turned by `angle` as a whole.
class Triangle {
 public:
  explicit Triangle(const BodyMaterial& m, double angle = 0) : m_(m), c_(m_), angle_(angle) {
    point = YieldPoint{};
    point.edges = {1, 0, 0, 1}, point.thickness = 1, point.strain = 0;
    point.temperature = m.plastic.startTemperature;
    move({1, 0, 0, 1});
  }

  /// Kirchhoff stress at F, in the directions of the triangle; the state stays the same.
  [[nodiscard]] PlaneStress at(const Matrix2& f) const {
    return stress(returnToYield(c_, point, motion(f), dt));
  }
  PlaneStress move(const Matrix2& f) {
    const Returned back = returnToYield(c_, point, motion(f), dt);
    point = back.point;
    last_ = edges(f);
    work += back.dissipation;
    trial = back;
    return stress(back);
  }
  [[nodiscard]] double mises() const {
    return c_.moduli.shear * trial.kept * std::sqrt(trial.trial.squaredMises());
  }
  [[nodiscard]] double across() const {
    return meanStress(trial.trial.volume, c_.moduli.bulk) +
           2 * c_.moduli.shear * trial.kept * trial.trial.across / 3;
  }
  [[nodiscard]] double shear() const { return c_.moduli.shear; }

  YieldPoint point;
  Returned trial;
  double dt = 0, work = 0;

 private:
  [[nodiscard]] TriangleMotion motion(const Matrix2& f) const {
    return {edges(f), last_, determinant(f)};
  }
  [[nodiscard]] TriangleEdges edges(const Matrix2& f) const {
    const double c = std::cos(angle_), s = std::sin(angle_);
    const auto turned = [&](double x, double y) { return Vec2{c * x - s * y, s * x + c * y}; };
    // The edges of the undeformed triangle are turned, too.
    const Vec2 first = turned(f.xx * c - f.xy * s, f.yx * c - f.yy * s);
    const Vec2 second = turned(f.xx * s + f.xy * c, f.yx * s + f.yy * c);
    return {{first.x, first.y}, {second.x, second.y}};
  }
  [[nodiscard]] PlaneStress stress(const Returned& back) const {
    PlaneStress t(back.trial, meanStress(back.trial.volume, c_.moduli.bulk), back.kept,
                  c_.moduli.shear);
    const double c = std::cos(angle_), s = std::sin(angle_);
    const PlaneStress now = t;
    t.xx = c * c * now.xx + 2 * c * s * now.xy + s * s * now.yy;
    t.yy = s * s * now.xx - 2 * c * s * now.xy + c * c * now.yy;
    t.xy = c * s * (now.yy - now.xx) + (c * c - s * s) * now.xy;
    return t;
  }

  BodyMaterial m_;
  YieldConstants c_;
  double angle_;
  TriangleEdges last_{{1, 0}, {0, 1}};
};

/// Lateral stretch at which the lateral stress is zero.
double freeSide(const Triangle& t, double along) {
  double low = .5, high = 1.5;
  for (int i = 0; i < 60; ++i) {
    const double middle = (low + high) / 2;
    (t.at({along, 0, 0, middle}).yy > 0 ? high : low) = middle;
  }
  return low;
}

/// Tension in plane strain to the logarithmic strain `most`; the lateral sides are free.
PlaneStress pull(Triangle& t, double from, double most, int steps) {
  PlaneStress stress = t.at({std::exp(from), 0, 0, 1});
  for (int i = 1; i <= steps; ++i) {
    const double along = std::exp(from + (most - from) * i / steps);
    stress = t.move({along, 0, 0, freeSide(t, along)});
  }
  return stress;
}

TEST(PlasticLaw, TensionInPlaneStrainFollowsTheHardeningCurve) {
  for (const double degrees : {0., 15., 30.}) {
    Triangle t(steel(), degrees * std::numbers::pi / 180);
    const PlaneStress stress = pull(t, 0, .2, 1000);
    const double yield = 400e6 + 500e6 * std::pow(t.point.strain, .3);
    EXPECT_NEAR(t.mises() / yield, 1, 1e-9);
    // σ = 2/√3 Y, once elastic strains are small against plastic ones: tolerance of the issue.
    EXPECT_NEAR(stress.xx / (2 / kRootThree * yield), 1, 1e-3);
    const double total = .2 - std::log(freeSide(t, std::exp(.2)));
    EXPECT_NEAR(t.point.strain / ((total - stress.xx / (2 * t.shear())) / kRootThree), 1, 1e-3);
  }
}

TEST(PlasticLaw, TenStepsGiveWhatAThousandGive) {
  Triangle few(steel()), many(steel());
  const PlaneStress a = pull(few, 0, .2, 10), b = pull(many, 0, .2, 1000);
  EXPECT_NEAR(a.xx / b.xx, 1, 5e-3);
  EXPECT_NEAR(few.point.strain / many.point.strain, 1, 5e-3);
  Triangle one(steel()), other(steel());
  PlaneStress s{one.trial.trial, 0, 1, 0}, r = s;
  for (int i = 1; i <= 10; ++i) s = one.move({1, .2 * kRootThree * i / 10, 0, 1});
  for (int i = 1; i <= 1000; ++i) r = other.move({1, .2 * kRootThree * i / 1000, 0, 1});
  EXPECT_NEAR(s.xy / r.xy, 1, 5e-3);
}

/// Simple shear of a material with small elastic strains: τ = Y/√3 with p = γ/√3.
TEST(PlasticLaw, SimpleShear) {
  for (const double degrees : {0., 15., 30.}) {
    Triangle t(steel(), degrees * std::numbers::pi / 180);
    PlaneStress s = t.at({1, 0, 0, 1});
    const double shear = .2 * kRootThree;
    for (int i = 1; i <= 1000; ++i) s = t.move({1, shear * i / 1000, 0, 1});
    const double yield = 400e6 + 500e6 * std::pow(t.point.strain, .3);
    EXPECT_NEAR(s.xy / (yield / kRootThree), 1, 1e-3);
    EXPECT_NEAR(t.point.strain / ((shear - s.xy / t.shear()) / kRootThree), 1, 1e-3);
    // The plastic work is ∫Y dp.
    const double p = t.point.strain;
    EXPECT_NEAR(t.work / (400e6 * p + 500e6 * std::pow(p, 1.3) / 1.3), 1, 1e-3);
  }
}

TEST(PlasticLaw, UnloadingIsElasticAndReversedFlowBeginsAtTheSameStress) {
  Triangle t(steel(0, 1));
  (void)pull(t, 0, .05, 200);
  const double p = t.point.strain;
  const PlaneStress top = t.move({std::exp(.05), 0, 0, freeSide(t, std::exp(.05))});
  const PlaneStress down = pull(t, .05, .0495, 5);
  EXPECT_NEAR(t.point.strain, p, 1e-12);
  // E/(1 − ν²) of the logarithmic strain; the shape has changed by 5 %, the moduli of τ have not.
  EXPECT_NEAR((top.xx - down.xx) / (5e-4 * 210e9 / .91), 1, 2e-3);
  const PlaneStress reversed = pull(t, .0495, .03, 200);
  EXPECT_NEAR(reversed.xx / -top.xx, 1, 1e-3);
}

TEST(PlasticLaw, PlaneStressHasNoStressAcross) {
  BodyMaterial m = steel();
  m.material.planeStress = true;
  Triangle t(m);
  PlaneStress s = t.at({1, 0, 0, 1});
  for (int i = 1; i <= 200; ++i) {
    const double along = std::exp(.2 * i / 200);
    s = t.move({along, 0, 0, freeSide(t, along)});
    ASSERT_LT(std::abs(t.across()), 1);
  }
  // Uniaxial: σ = Y, p = ε − σ/E.
  const double yield = 400e6 + 500e6 * std::pow(t.point.strain, .3);
  EXPECT_NEAR(s.xx / yield, 1, 1e-6);
  EXPECT_NEAR(t.point.strain / (.2 - s.xx / 210e9), 1, 1e-3);
}

TEST(PlasticLaw, RateAndTemperatureActAsJohnsonAndCookWrite) {
  BodyMaterial m = steel(292e6, .31);
  m.plastic.yieldStress = 90e6;
  m.plastic.rateFactor = .025, m.plastic.thermalExponent = 1.09;
  m.plastic.meltTemperature = 1356, m.plastic.heatCapacity = 383;
  Triangle t(m);
  t.dt = 1e-8;
  double p = 0;
  for (int i = 1; i <= 1000; ++i) {
    p = t.point.strain;
    (void)t.move({1, .5 * i / 1000, 0, 1});
  }
  const double rate = (t.point.strain - p) / t.dt;
  EXPECT_NEAR(rate / (5e-4 / 1e-8 / kRootThree), 1, 1e-3);
  const double heat = (t.point.temperature - 293) / (1356 - 293);
  const double yield = (90e6 + 292e6 * std::pow(t.point.strain, .31)) *
                       (1 + .025 * std::log(rate)) * (1 - std::pow(heat, 1.09));
  EXPECT_NEAR(t.mises() / yield, 1, 1e-4);  // the temperature is that before the step
  EXPECT_NEAR((t.point.temperature - 293) / (.9 * t.work / (7800 * 383)), 1, 1e-9);
}

TEST(PlasticLaw, PowerLawAndTable) {
  BodyMaterial power = steel(), table = steel();
  power.plastic.hardening = table.plastic.hardening = 0;
  power.plastic.offsetStrain = .01, power.plastic.hardeningExponent = .2;
  table.plastic.table = {{0, 300e6}, {.1, 500e6}, {.15, 550e6}};
  Triangle a(power), b(table);
  for (int i = 1; i <= 100; ++i)
    (void)a.move({1, .3 * i / 100, 0, 1}), (void)b.move({1, .3 * i / 100, 0, 1});
  EXPECT_NEAR(a.mises() / (400e6 * std::pow(1 + a.point.strain / .01, .2)), 1, 1e-9);
  EXPECT_GT(b.point.strain, .15);
  EXPECT_NEAR(b.mises(), 550e6, 1);  // constant after the last point
}

// --- Bodies that yield, in steps: forces, energy balance, undoing, bits.

constexpr ElementKind kKinds[] = {ElementKind::kLinear, ElementKind::kSmoothed};

/// A square of 20 mm of copper or steel that yields.
Model yielding(ElementKind kind, int side = 8, double yield = 400e6, bool planeStress = false) {
  Model model;
  TriangleMesh mesh = structuredRectangle({-.01, -.01}, {.01, .01}, side, side);
  Component c;
  c.material = kSteel;
  c.material.planeStress = planeStress;
  c.element = kind;
  c.plastic = plasticLaws()[0];
  c.plastic.yieldStress = yield;
  appendBody(model, mesh, c);
  return model;
}

/// Bulges and shears by velocities up to `most` (m/s).
void launch(Model& model, double most) {
  for (std::size_t n = 0; n < model.nodes.size(); ++n) {
    const Vec2 x = model.nodes.position[n];
    model.nodes.velocity[n] = most * Vec2{x.x / .01 + x.y / .02, std::sin(150 * x.x) * x.y / .01};
  }
}

TEST(PlasticFlow, SmallStrainsGiveTheElasticForces) {
  for (const bool planeStress : {false, true})
    for (const ElementKind kind : kKinds) {
      Model model = yielding(kind, 8, 1e12, planeStress);
      Model elastic = model;
      elastic.components[0].plastic = {};
      elastic.components[0].element = ElementKind::kLinear;
      elastic.triangles.plastic = {};
      // A uniform strain, with a rotation: means at nodes change nothing.
      for (Model* one : {&model, &elastic})
        for (Vec2& x : one->nodes.position)
          x = Vec2{.8 * x.x * 1.0001 - .6 * x.y, .6 * x.x + .8 * x.y};
      const std::vector<Vec2> a = forcesOf(model), b = forcesOf(elastic);
      double most = 0, difference = 0;
      for (std::size_t n = 0; n < a.size(); ++n)
        most = std::max(most, norm(b[n])), difference = std::max(difference, norm(a[n] - b[n]));
      EXPECT_LT(difference, 3e-4 * most);
    }
}

/// Kinetic, strain and plastic energy together, of the kinetic energy at the start.
double energyError(Model model, double speed, double factor, int steps) {
  launch(model, speed);
  Stepper run = runOf(std::move(model), factor);
  const double start = run.kinetic();
  double plastic = 0, most = 0;
  for (int i = 0; i < steps; ++i) {
    run.step();
    plastic += run.dynamics.flow().dissipation();
    if (i % 20 != 19) continue;
    const YieldingEnergy now = yieldingEnergy(run.model, run.dt);
    most = std::max(most, std::abs(run.kinetic() + now.strain + plastic + now.dissipated - start));
  }
  EXPECT_GT(plastic, .3 * start);
  return most / start;
}

TEST(PlasticFlow, EnergyIsBalanced) {
  for (const ElementKind kind : kKinds) {
    EXPECT_LT(energyError(yielding(kind), 40, .5, 400), 1e-5);
    EXPECT_LT(energyError(yielding(kind, 8, 400e6, true), 40, .5, 400), 1e-5);
  }
}

/// Of frictional materials, whose volume changes as they flow, at strains of 3 %.
TEST(PlasticFlow, EnergyOfFrictionalMaterials) {
  for (const double dilation : {0., .3, .5})
    for (const ElementKind kind : kKinds) {
      Model model;
      Component c;
      c.material = {1e9, .3, 2000, false};
      c.element = kind;
      c.plastic.cohesion = 1e6, c.plastic.internalFriction = .5, c.plastic.dilation = dilation;
      appendBody(model, structuredRectangle({-.01, -.01}, {.01, .01}, 8, 8), c);
      EXPECT_LT(energyError(std::move(model), 20, .5, 400), 1e-5) << dilation;
    }
}

TEST(PlasticFlow, TheSameBitsForAnyInstructionSet) {
  for (const PlasticMaterial& law : plasticLaws())
    for (const ElementKind kind : kKinds) {
      Model model = yielding(kind, 40);
      model.components[0].plastic = law;
      launch(model, 60);
      const Model end = expectSameForAnySet(model, .5, 100);
      EXPECT_GT(*std::ranges::max_element(end.triangles.plastic.strain), .01);
    }
}

/// The loops of a step return triangles as returnToYield does; the vector loops to the tolerance of
/// Δp.
TEST(PlasticFlow, LanesAgreeWithTheReturnOfOneTriangle) {
  for (const PlasticMaterial& law : plasticLaws()) {
    Model model = yielding(ElementKind::kSmoothed, 11);  // the last group of lanes is not full
    model.components[0].plastic = law;
    launch(model, 60);
    Stepper run = runOf(model, .5);
    double most = 0;
    for (int i = 0; i < 100; ++i) {
      const std::vector<YieldPoint> points = presentPoints(run.model, run.dt);
      run.step();
      const PlasticState& state = run.model.triangles.plastic;
      for (std::size_t e = 0; e < points.size(); ++e) {
        const YieldPoint found(state, e), &right = points[e];
        for (std::size_t j = 0; j < 4; ++j)
          most = std::max(most, std::abs(found.edges[j] - right.edges[j]) /
                                    std::abs(right.edges[0] + right.edges[3]));
        most = std::max({most, std::abs(found.thickness - right.thickness),
                         std::abs(found.strain - right.strain),
                         std::abs(found.temperature - right.temperature) / 293});
      }
    }
    EXPECT_GT(*std::ranges::max_element(run.model.triangles.plastic.strain), .01);
    EXPECT_LT(most, 1e-12);
  }
}

/// A rotation of a body that has flowed gives no forces, and its stress turns with it.
TEST(PlasticFlow, RotationsAreExact) {
  for (const ElementKind kind : kKinds) {
    Model model = yielding(kind);
    launch(model, 60);
    Stepper run = runOf(model, .5);
    run.step(100);
    const std::vector<Vec2> before = forcesOf(run.model);
    for (auto* field : {&run.model.nodes.position, &run.model.nodes.velocity})
      for (Vec2& x : *field) x = test::turnedBy(x, 2);
    const std::vector<Vec2> after = forcesOf(run.model);
    double most = 0, difference = 0;
    for (std::size_t n = 0; n < before.size(); ++n) {
      const Vec2 turned = test::turnedBy(before[n], 2);
      most = std::max(most, norm(turned));
      difference = std::max(difference, norm(turned - after[n]));
    }
    EXPECT_LT(difference, 1e-10 * most);
  }
}

}  // namespace
}  // namespace yadefrag
