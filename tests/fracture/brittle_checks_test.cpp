// Brittle materials: what is refused, and the traction that separates.

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "core/checks.hpp"
#include "fracture/brittle_checks.hpp"
#include "fracture/edge_strength.hpp"
#include "fracture/separation.hpp"
#include "mesh/assembly.hpp"
#include "mesh/shapes.hpp"
#include "meshing/triangulate.hpp"
#include "time/critical_time_step.hpp"

namespace yadefrag {
namespace {

using test::contains;

constexpr ElasticMaterial kCeramic{.young = 275e9, .poisson = 0, .density = 2750};
const BrittleMaterial kBrittle{.tensileStrength = 300e6, .fractureEnergy = 100};
const BrittleMaterial kTough{.tensileStrength = 300e6, .fractureEnergy = 300};
constexpr ComponentId kBody(std::size_t{0});

std::string saidOf(const BrittleMaterial& material) {
  return test::refusalOf([&] { checkBrittle(material); });
}

/// The number in a sentence that follows the words.
double numberAfter(const std::string& sentence, const std::string& words) {
  const std::size_t at = sentence.find(words);
  EXPECT_NE(at, std::string::npos) << sentence;
  return at == std::string::npos ? NAN : std::stod(sentence.substr(at + words.size()));
}

/// A square of 10 mm in `side` × `side` quads of two triangles.
Model body(int side, const BrittleMaterial& brittle, double thickness = 1) {
  Component component;
  component.material = kCeramic;
  component.brittle = brittle;
  component.thickness = thickness;
  Model model;
  appendBody(model, structuredRectangle({0, 0}, {.01, .01}, side, side), component);
  return model;
}

std::string saidAtStep(const Model& model, double dt) {
  return test::refusalOf([&] { checkCohesiveResolution(model, kBody, dt); });
}

/// A row for each reason; the sentences and more values: tests/pkg/session/test_refused_values.py.
TEST(CheckBrittle, ImpossibleConstantsAreRefused) {
  for (const BrittleMaterial& possible :
       {kBrittle,
        {.tensileStrength = 1},
        {.tensileStrength = 1, .weibullModulus = .5, .strengthScatter = .999}})
    EXPECT_EQ(saidOf(possible), "");
  double BrittleMaterial::*const values[] = {
      &BrittleMaterial::tensileStrength, &BrittleMaterial::fractureEnergy,
      &BrittleMaterial::shearFactor,     &BrittleMaterial::shearEnergyFactor,
      &BrittleMaterial::weibullModulus,  &BrittleMaterial::referenceVolume,
      &BrittleMaterial::strengthScatter};
  for (double BrittleMaterial::*const value : values)
    for (const double bad : {-1., double(NAN), double(INFINITY)}) {
      BrittleMaterial material{.tensileStrength = 1};
      material.*value = bad;
      EXPECT_NE(saidOf(material), "") << bad;
    }
  EXPECT_NE(saidOf({.tensileStrength = 0}), "");
  EXPECT_NE(saidOf({.tensileStrength = 1, .shearFactor = 0}), "");
}

TEST(CheckBrittle, ImpossibleFailureLawsAreRefused) {
  const FailureLaw possible{.d1 = .05, .d2 = 3.44, .d3 = -2.12, .energy = 1e4};
  const auto isRefused = [&](void (*change)(FailureLaw&)) {
    PlasticMaterial m{.yieldStress = 792e6, .failure = possible};
    change(m.failure);
    return !m.wrong().empty();
  };
  EXPECT_FALSE(isRefused([](FailureLaw&) {}));
  EXPECT_FALSE(isRefused([](FailureLaw& f) { f.d1 = -.2, f.strain = .1; }));
  void (*const wrong[])(FailureLaw&) = {[](FailureLaw& f) { f.strain = 0; },
                                        [](FailureLaw& f) { f.d1 = -.2; },
                                        [](FailureLaw& f) { f.d2 = -1; },
                                        [](FailureLaw& f) { f.d3 = 2.12; },
                                        [](FailureLaw& f) { f.d4 = -.05; },
                                        [](FailureLaw& f) { f.d5 = -1; },
                                        [](FailureLaw& f) { f.d5 = 1; },
                                        [](FailureLaw& f) { f = {}, f.d4 = .01; },
                                        [](FailureLaw& f) { f = {}, f.energy = 1; },
                                        [](FailureLaw& f) { f.spallStress = 1e9, f.energy = 0; }};
  for (const auto& change : wrong) EXPECT_TRUE(isRefused(change)) << &change - wrong;
}

TEST(CheckBrittle, PointsThatAreNoCurveAreRefused) {
  using Curve = std::vector<SofteningPoint>;
  for (const Curve& points : {Curve{{0, 1}},
                              {{0, .9}, {1, 0}},
                              {{0, 1}, {.9, 0}},
                              {{0, 1}, {.5, .2}, {.5, .1}, {1, 0}},
                              {{0, 1}, {.3, .2}, {.5, .4}, {1, 0}}}) {
    EXPECT_FALSE(SofteningCurve::isValid(points));
    EXPECT_THROW((void)SofteningCurve(points), InputError);
  }
  using Rates = std::vector<RatePoint>;
  for (const Rates& points :
       {Rates{{1, 2}}, {{2, 1}, {1, 2}}, {{0, 1}, {1, 2}}, {{1, 1}, {2, .9}}}) {
    EXPECT_FALSE(RateEffect::isValid(points));
    EXPECT_THROW((void)RateEffect(points), InputError);
  }
  EXPECT_NO_THROW((void)RateEffect({{1, 1}, {2, 1000}}));
  EXPECT_THROW((void)softeningNamed("quadratic"), InputError);
  EXPECT_THROW((void)rateEffectNamed("ceb"), InputError);
}

// A curve that falls three times as steeply as the strength over its critical opening, which is
// 1.8 times that of the line: the step counts the slope, and so does the zone's length. With a
// scatter the step is that of the strongest edge; thickness cancels.
TEST(CheckCohesiveResolution, RefusesFromTheStepOfTheFormulaOn) {
  BrittleMaterial concrete = kBrittle, scattered = kBrittle;
  concrete.softening = softeningNamed("petersson");
  scattered.weibullModulus = 5, scattered.strengthScatter = .1;
  const double strength = kBrittle.tensileStrength,
               strongest = likelyLargestStrength(scattered, 20 * 20 + 2 * 20 * 19);
  EXPECT_GT(strongest, 1.5 * strength);
  // What the step takes from an opening held by the strength, over the critical one: legs h,
  // diagonals √2h between triangles of h²/2, lumped by thirds.
  const auto expectLimit = [](const Model& model, double ofStrength, double part) {
    constexpr double h = 5e-4, dt = 1e-8;
    const double node = kCeramic.density * h * h / 2 / 3;
    const double compliance = dt * dt * (std::sqrt(2.) * h / 2) * (2 / node);
    const double crossed = compliance * ofStrength / (2 * kBrittle.fractureEnergy / ofStrength);
    const double limit = 2 * dt / std::sqrt(crossed) * part;
    EXPECT_EQ(saidAtStep(model, .9999 * limit), "");
    std::string sentence = saidAtStep(model, 1.0001 * limit);
    EXPECT_NE(sentence, "");
    return sentence;
  };
  expectLimit(body(20, kBrittle), strength, 1);
  expectLimit(body(20, kBrittle, .001), strength, 1);
  expectLimit(body(20, scattered), strongest, 1);
  const Model model = body(20, concrete);
  const std::string sentence = expectLimit(model, strength, std::sqrt(.6));
  EXPECT_TRUE(
      contains(sentence, "softens as steeply as by its strength over an opening of 4e-07 m"));
  EXPECT_TRUE(contains(cohesiveZoneWarning(model, kBody), "is 0.0001833 m long"))
      << cohesiveZoneWarning(model, kBody);
}

TEST(CheckCohesiveResolution, TheSentenceStatesWhatSufficesAndItSuffices) {
  const Model model = body(20, kBrittle);
  const double dt = 1e-7;
  const std::string sentence = saidAtStep(model, dt);
  EXPECT_EQ(sentence.substr(0, sentence.find(';')),
            "fractureEnergy is 100 J/m² in component 0: a crack is cohesive up to an opening of "
            "6.667e-07 m, which a step of 1e-07 s does not resolve");
  const double step = numberAfter(sentence, "a step of at most ");
  EXPECT_EQ(saidAtStep(model, step), "");
  EXPECT_NE(saidAtStep(model, 1.03 * step), "");
  const double now = numberAfter(sentence, "(now ");
  EXPECT_NEAR(now, 5e-4 * (2 + std::sqrt(2.)) / 3, .02 * now);
  const double size = numberAfter(sentence, "elements of at most ");
  const int side = static_cast<int>(std::ceil(20 * now / size));
  EXPECT_EQ(saidAtStep(body(side, kBrittle), dt * 20 / side), "");
  const int coarse = static_cast<int>(.85 * side);
  EXPECT_NE(saidAtStep(body(coarse, kBrittle), dt * 20 / coarse), "");
}

TEST(CheckCohesiveResolution, AcceptsAStableStepWhereTheZoneIsResolved) {
  for (const int side : {120, 200}) {  // the zone is 0.92 mm: 9 and more elements
    const Model model = body(side, kTough);
    ASSERT_EQ(cohesiveZoneWarning(model, kBody), "");
    EXPECT_EQ(saidAtStep(model, criticalTimeStep(model)), "");
  }
}

TEST(CheckCohesiveResolution, HasNothingToResolveWithoutAFractureEnergyOrAnInnerEdge) {
  for (const BrittleMaterial& material : {BrittleMaterial{.tensileStrength = 300e6}, {}}) {
    EXPECT_EQ(saidAtStep(body(4, material), 1), "");
    EXPECT_EQ(cohesiveZoneWarning(body(4, material), kBody), "");
  }
  Component component;
  component.material = kCeramic;
  component.brittle = kBrittle;
  Model one;
  appendBody(one, test::oneTriangle({0, 0}, {.01, 0}, {0, .01}), component);
  EXPECT_EQ(saidAtStep(one, 1), "");
}

TEST(CheckCohesiveResolution, ChecksItsOwnComponentOnly) {
  Model model = body(200, kTough);
  Component coarse = model.components[0];
  appendBody(model, structuredRectangle({1, 0}, {2, 1}, 2, 2), coarse);
  const double dt = criticalTimeStep(body(200, kTough));
  EXPECT_EQ(saidAtStep(model, dt), "");
  EXPECT_EQ(cohesiveZoneWarning(model, kBody), "");
  EXPECT_TRUE(contains(cohesiveZoneWarning(model, ComponentId(std::size_t{1})), "component 1"));
}

TEST(CohesiveZoneWarning, StatesZoneElementAndWhatSuffices) {
  const double zone = 275e9 * 100 / 9e16;
  const std::string sentence = cohesiveZoneWarning(body(20, kBrittle), kBody);
  EXPECT_EQ(sentence.substr(0, sentence.find(';')),
            "fractureEnergy is 100 J/m² in component 0: the cohesive zone is 0.0003056 m long, "
            "less than four elements of 0.0005668 m");
  const double wanted = numberAfter(sentence, "at most ");
  EXPECT_LT(wanted, zone / 4);
  EXPECT_GT(wanted, .88 * zone / 4);
  const double legToMean = (2 + std::sqrt(2.)) / 3;
  EXPECT_EQ(cohesiveZoneWarning(body(std::ceil(.01 * legToMean / wanted), kBrittle), kBody), "");
  EXPECT_NE(cohesiveZoneWarning(body(.01 * legToMean / wanted * .85, kBrittle), kBody), "");
}

TEST(CohesiveZoneWarning, UsesTheZoneOfASlidingCrackIfThatIsShorter) {
  constexpr int kSide = 100;
  ASSERT_EQ(cohesiveZoneWarning(body(kSide, kTough), kBody), "");  // 0.92 mm, eight elements
  BrittleMaterial material = kTough;
  material.shearFactor = 3, material.shearEnergyFactor = 2;
  const double zone = 275e9 * 300 / 9e16 * 2 / 9;
  const std::string sentence = cohesiveZoneWarning(body(kSide, material), kBody);
  EXPECT_NEAR(numberAfter(sentence, "the cohesive zone of a sliding crack is "), zone, 1e-3 * zone);
  EXPECT_NEAR(numberAfter(sentence, "at most "), .9 * zone / 4, .02 * zone / 4);
  material.shearEnergyFactor = 9;
  EXPECT_EQ(cohesiveZoneWarning(body(kSide, material), kBody), "");
}

TEST(CohesiveZoneWarning, StatesAZoneThatIsLongBesideTheBody) {
  BrittleMaterial material{.tensileStrength = 300e6, .fractureEnergy = 1600};  // 4.9 mm
  EXPECT_EQ(cohesiveZoneWarning(body(20, material), kBody), "");
  material.fractureEnergy = 2000;
  const std::string sentence = cohesiveZoneWarning(body(20, material), kBody);
  EXPECT_EQ(
      sentence.substr(0, sentence.find(';')),
      "fractureEnergy is 2000 J/m² in component 0: the cohesive zone is 0.006111 m long, more "
      "than half of the body's smallest width of 0.01 m");
  for (const double angle : {.1, .35, .8, 1.2, 2., 3.}) {
    Model turned = body(20, material);
    for (Vec2& at : turned.nodes.position) at = test::turnedBy(at, angle);
    EXPECT_EQ(cohesiveZoneWarning(turned, kBody), sentence) << angle;
  }
  material.fractureEnergy = numberAfter(sentence, "with a fractureEnergy of at most ");
  EXPECT_GT(material.fractureEnergy, 1600);
  EXPECT_EQ(cohesiveZoneWarning(body(20, material), kBody), "");
}

// --- separation

const BrittleMaterial kEven{.tensileStrength = 1e6};
const BrittleMaterial kShearProof{.tensileStrength = 1e6, .shearFactor = 2};
constexpr double kFriction = .4;

Vec2 direction(double angle) { return {std::cos(angle), std::sin(angle)}; }

TEST(Separation, TractionOfTheAxesAndTheDiagonal) {
  const std::array<double, 3> stress{3, -5, 2};
  const Traction x = tractionOn(stress, {1, 0});
  EXPECT_EQ(x.normal, 3);
  EXPECT_EQ(x.shear, 2);
  const Traction y = tractionOn(stress, {0, 1});
  EXPECT_EQ(y.normal, -5);
  EXPECT_EQ(y.shear, -2);  // along −x
  const Traction diagonal = tractionOn(stress, direction(std::numbers::pi / 4));
  EXPECT_NEAR(diagonal.normal, (3 - 5) / 2. + 2, 1e-14);
  EXPECT_NEAR(diagonal.shear, (-5 - 3) / 2., 1e-14);
}

TEST(Separation, EffectiveTractionIsTheFormula) {
  EXPECT_EQ(effectiveTraction(5, 0, kShearProof, kFriction), 5);
  EXPECT_EQ(effectiveTraction(3, 4, kEven, kFriction), 5);
  EXPECT_EQ(effectiveTraction(3, -8, kShearProof, kFriction), 5);
  EXPECT_DOUBLE_EQ(effectiveTraction(-5, 4, kEven, kFriction), 2);
  EXPECT_DOUBLE_EQ(effectiveTraction(-5, -4, kShearProof, kFriction), 1);
  EXPECT_EQ(effectiveTraction(-10, 4, kEven, kFriction), 0);   // just sticks
  EXPECT_EQ(effectiveTraction(-100, 4, kEven, kFriction), 0);  // sticks
  EXPECT_EQ(effectiveTraction(-5, 4, kEven, 0), 4);
}

TEST(Separation, IsContinuousAndGrowsWithTheNormalTraction) {
  for (const double shear : {-3., 0., 1e-6, 3.}) {
    const double none = effectiveTraction(0, shear, kShearProof, kFriction);
    EXPECT_EQ(none, std::abs(shear) / 2);
    EXPECT_NEAR(effectiveTraction(-1e-12, shear, kShearProof, kFriction), none, 1e-12);
    EXPECT_NEAR(effectiveTraction(1e-12, shear, kShearProof, kFriction), none, 1e-12);
    double before = 0;
    for (double normal = -20; normal < 20; normal += .125) {
      const double now = effectiveTraction(normal, shear, kShearProof, kFriction);
      EXPECT_GE(now, before);
      EXPECT_LE(now - before, .125 + 1e-12);  // never steeper than 1 (friction/β < 1)
      before = now;
    }
  }
}

}  // namespace
}  // namespace yadefrag
