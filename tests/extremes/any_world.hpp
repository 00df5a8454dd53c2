#pragma once
// Small scenes at random: bodies of any shape, material, size and motion, some broken, some wrong;
// and what happens to them while they move.

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <random>
#include <vector>

#include "core/errors.hpp"
#include "meshing/triangulate.hpp"
#include "step/world.hpp"

namespace yadefrag::test {

/// Numbers that are the same with any standard library.
class Chance {
 public:
  explicit Chance(std::uint64_t seed) : random_(seed) {}
  double from(double low, double high) { return low + (high - low) * 0x1p-64 * double(random_()); }
  /// Even in the logarithm: 10^low to 10^high.
  double power(double low, double high) { return std::pow(10., from(low, high)); }
  bool oneIn(unsigned count) { return random_() % count == 0; }
  int below(int count) { return static_cast<int>(random_() % static_cast<unsigned>(count)); }
  double sign() { return oneIn(2) ? 1 : -1; }
  /// A value that no quantity can have.
  double wrong() {
    constexpr std::array kWrong = {-1., double(NAN), double(INFINITY), -double(INFINITY)};
    return kWrong[static_cast<std::size_t>(below(4))];
  }
  std::mt19937_64& engine() { return random_; }

 private:
  std::mt19937_64 random_;
};

/// A scene and its changes, all from one seed. Some of its changes are refused.
class AnyWorld {
 public:
  explicit AnyWorld(std::uint64_t seed) : chance_(seed) {
    scale_ = chance_.power(-4, 3);
    wave_ = chance_.power(1, 4);
    calm_ = !chance_.oneIn(4);
    world.contactSettings.passes = 1 + chance_.below(2);
    (void)chance_.oneIn(8);  // A choice of earlier versions: each seed keeps its scene.
    if (chance_.oneIn(4)) drive();
  }

  World world;
  bool isFree = true;     ///< nothing from outside: momentum is kept
  bool overlaps = false;  ///< did bodies join inside one another

  [[nodiscard]] Chance& chance() { return chance_; }

  /// One more body, to the right of those there are. Throws InputError as whatever refuses it.
  void addBody() {
    const TriangleMesh mesh = anyMesh();
    BodySpec spec = anySpec(mesh);
    const bool anyHeld = std::ranges::any_of(spec.held, [](std::uint8_t h) { return h != 0; });
    world.addBody(mesh, spec);
    isFree = isFree && !anyHeld;
  }

  /// Something that a script may do between two steps.
  void change() {
    switch (chance_.below(7)) {
      case 0:
        return addBody();
      case 1:
        return world.removeBody(
            ComponentId(static_cast<std::size_t>(chance_.below(numBodies() + 1))));
      case 2:
        return load();
      case 3:
        return prescribe();
      case 4:
        world.contactSettings.passes = 1 + chance_.below(2);
        return;
      case 5:
        world.contactSettings.halo = chance_.oneIn(3) ? 0 : chance_.from(.02, .5);
        return;
      default:
        world.threads = 1 + chance_.below(2);
    }
  }

  /// (s) Mostly a stable one.
  double anyStep() {
    const double critical = std::min(world.criticalTimeStep(), scale_ / wave_);  // if there is none
    if (chance_.oneIn(200)) return chance_.oneIn(2) ? 1.01 * critical : chance_.wrong();
    return (chance_.oneIn(4) ? chance_.power(-3, 0) : chance_.from(.3, 1)) * critical;
  }

 private:
  [[nodiscard]] int numBodies() const { return static_cast<int>(world.model.components.size()); }

  void drive() {
    isFree = false;
    StepSettings& settings = world.dynamicsSettings;
    if (chance_.oneIn(2)) settings.gravity = wave_ * wave_ / scale_ * .01 * anyVector();
    if (chance_.oneIn(2)) settings.damping = chance_.power(-3, 1) * wave_ / scale_;
    if (chance_.oneIn(2)) settings.viscosity = {chance_.from(0, .5), chance_.from(0, 3)};
  }

  Vec2 anyVector() { return {chance_.from(-1, 1), chance_.from(-1, 1)}; }

  TriangleMesh anyMesh() {
    const double radius = scale_ * (calm_ ? chance_.from(.5, 1.5) : chance_.power(-2, 1));
    // Apart, exactly in touch, or in each other.
    double gap = 0;
    if (!chance_.oneIn(6)) gap = radius * chance_.power(-12, -2);
    if (chance_.oneIn(8)) gap = -gap, overlaps = overlaps || gap < 0;
    const Vec2 centre{right_ + gap + radius, scale_ * chance_.from(-.5, .5)};
    TriangleMesh mesh = chance_.oneIn(2) ? rectangle(centre, radius) : polygon(centre, radius);
    for (const Vec2 node : mesh.nodes) right_ = std::max(right_, node.x);
    return mesh;
  }

  TriangleMesh rectangle(Vec2 centre, double radius) {
    const Vec2 half{radius, radius * (calm_ ? 1 : chance_.power(-2, 2))};
    return structuredRectangle(centre - half, centre + half, 1 + chance_.below(4),
                               1 + chance_.below(4),
                               chance_.oneIn(2) ? QuadPattern::kCrossed : QuadPattern::kUnionJack);
  }

  std::vector<Vec2> loop(Vec2 centre, double radius, double least, double sense) {
    const int corners = 3 + chance_.below(7);
    const double start = chance_.from(0, 6);
    std::vector<Vec2> points;
    for (int k = 0; k < corners; ++k) {
      const double angle =
          start + sense * 2 * std::numbers::pi * (k + chance_.from(0, .6)) / corners;
      points.push_back(centre +
                       chance_.from(least, 1) * radius * Vec2{std::cos(angle), std::sin(angle)});
    }
    return points;
  }

  /// A star, seldom with a hole, seldom one whose edges cross.
  TriangleMesh polygon(Vec2 centre, double radius) {
    Polygon shape{loop(centre, radius, calm_ ? .6 : .05, 1), {}};
    if (chance_.oneIn(5)) shape.holes.push_back(loop(centre, .25 * radius, .3, -1));
    if (chance_.oneIn(40)) std::swap(shape.outline[0], shape.outline[1]);
    if (chance_.oneIn(100)) shape.outline[2] = shape.outline[0];
    const double size = chance_.oneIn(100) ? chance_.wrong() : radius * chance_.from(.4, 3);
    return triangulate(shape, size);
  }

  ElasticMaterial anyMaterial() {
    ElasticMaterial material;
    material.density = calm_ ? chance_.power(2, 4) : chance_.power(-2, 6);
    material.poisson = chance_.oneIn(6) ? chance_.from(-.9, .499) : chance_.from(0, .4);
    material.planeStress = chance_.oneIn(3);
    const double speed = calm_ ? wave_ : wave_ * chance_.power(-2, 2);
    material.young = material.density * speed * speed;
    if (chance_.oneIn(150)) material.young = chance_.wrong();
    if (chance_.oneIn(150)) material.density = chance_.wrong();
    if (chance_.oneIn(150)) material.poisson = chance_.oneIn(2) ? .5 : chance_.wrong();
    return material;
  }

  BrittleMaterial anyBrittle(double young) {
    BrittleMaterial brittle;
    brittle.tensileStrength = young * chance_.power(-6, -1);
    if (chance_.oneIn(10)) brittle.tensileStrength = chance_.oneIn(2) ? 1e-300 : 1e300;
    if (chance_.oneIn(3))
      brittle.fractureEnergy = brittle.tensileStrength * scale_ * chance_.power(-6, 1);
    if (chance_.oneIn(2)) brittle.strengthScatter = chance_.from(0, .9);
    if (chance_.oneIn(4)) brittle.weibullModulus = chance_.power(-1, 3);
    if (chance_.oneIn(4)) brittle.referenceVolume = chance_.power(-12, 6);
    brittle.shearFactor = chance_.power(-1, 1);
    if (chance_.oneIn(4)) brittle.shearEnergyFactor = chance_.power(-2, 2);
    brittle.seed = chance_.engine()();
    if (chance_.oneIn(100)) brittle.strengthScatter = chance_.wrong();
    if (chance_.oneIn(100)) brittle.shearFactor = 0;
    if (chance_.oneIn(100)) brittle.fractureEnergy = chance_.wrong();
    return brittle;
  }

  BodySpec anySpec(const TriangleMesh& mesh) {
    BodySpec spec;
    spec.material = anyMaterial();
    if (chance_.oneIn(2)) spec.brittle = anyBrittle(std::abs(spec.material.young));
    spec.thickness = chance_.power(-1, 1);
    if (chance_.oneIn(2)) spec.friction = chance_.power(-2, 2);
    spec.selfContact = !chance_.oneIn(3);
    // To the left, onto what is there.
    const double speed = wave_ * chance_.power(-5, calm_ ? -.5 : .5);
    const Vec2 velocity = speed * Vec2{chance_.from(-1, .2), chance_.from(-.5, .5)};
    const double spin = chance_.oneIn(3) ? speed / scale_ * chance_.from(-1, 1) : 0;
    const bool smooth = chance_.oneIn(3), held = chance_.oneIn(10);
    for (const Vec2 node : mesh.nodes) {
      const Vec2 arm = node - mesh.nodes.front();
      spec.velocity.push_back(velocity + spin * Vec2{-arm.y, arm.x});
      if (held) spec.held.push_back(static_cast<std::uint8_t>(chance_.below(4)));
      if (smooth) spec.smoothNodes.push_back(chance_.oneIn(4) ? 0 : 1);
    }
    spoil(spec);
    return spec;
  }

  /// Values that only a mistake can make.
  void spoil(BodySpec& spec) {
    if (!chance_.oneIn(30)) return;
    const double wrong = chance_.wrong();
    switch (chance_.below(6)) {
      case 0:
        spec.thickness = chance_.oneIn(2) ? 0 : wrong;
        return;
      case 1:
        spec.friction = wrong;
        return;
      case 2:
        spec.velocity.back().x = INFINITY;
        return;
      case 3:
        spec.displacement.assign(spec.velocity.size(), {0, NAN});
        return;
      case 4:
        spec.held.assign(spec.velocity.size(), 7);
        return;
      default:
        spec.velocity.pop_back();
    }
  }

  void load() {
    std::vector<Vec2> loads;
    double mass = 0;
    for (const double m : world.model.nodes.mass) mass += m;
    const double force = mass * wave_ * wave_ / scale_ * chance_.power(-6, -2);
    for (std::size_t i = 0; i < world.model.nodes.size(); ++i) loads.push_back(force * anyVector());
    if (chance_.oneIn(20) && !loads.empty()) loads.back().y = NAN;
    world.setLoads(std::move(loads));
    isFree = false;
  }

  void prescribe() {
    const auto count = static_cast<int>(world.model.nodes.size());
    const NodeId node(static_cast<std::size_t>(chance_.below(count + 1)));
    const double speed = chance_.oneIn(20) ? NAN : wave_ * chance_.power(-6, -1);
    world.prescribe(std::span(&node, 1), static_cast<std::uint8_t>(chance_.below(4)),
                    speed * anyVector());
    isFree = false;
  }

  Chance chance_;
  double scale_ = 1, wave_ = 1;  // m, m/s
  bool calm_ = true;  // bodies of about one size and stiffness, slower than a third of their waves
  double right_ = 0;  // m, where the bodies end
};

}  // namespace yadefrag::test
