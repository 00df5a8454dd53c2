#include "fracture/checks.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <vector>

#include "core/errors.hpp"
#include "fracture/edge_strength.hpp"

namespace yadefrag {
namespace {

/// (elements) Along the cohesive zone. A notched beam bears 15 % too much with eight, 20 % with
/// six, 45 % with four (notched_beam_test.cpp).
constexpr double kZoneElements = 8;

std::string text(double value, const char* unit) {
  std::array<char, 48> buffer;
  (void)std::snprintf(buffer.data(), buffer.size(), "%.4g%s", value, unit);
  return buffer.data();
}

/// What would do, with room for the rounding to three digits.
std::string atMost(double value, const char* unit) {
  std::array<char, 48> buffer;
  (void)std::snprintf(buffer.data(), buffer.size(), "at most %.3g%s", .99 * value, unit);
  return buffer.data();
}

void require(bool holds, const char* name, double value, const char* unit, const char* right) {
  if (holds) return;
  throw InputError(std::string(name) + " is " + text(value, unit) + "; it must be " + right + ".");
}

struct Edge {
  NodeId low, high;
  double length;       // m
  double inverseMass;  // 1/kg, of the least that one triangle can give to a node
  double volume;       // m³, of a third of the triangle
  [[nodiscard]] bool joins(const Edge& o) const { return low == o.low && high == o.high; }
};

/// The three sides of every triangle of a component; the two of an inner edge are neighbours.
std::vector<Edge> sidesOf(const Model& model, const Component& body) {
  std::vector<Edge> sides;
  sides.reserve(3 * std::size_t{body.lastTriangle - body.firstTriangle});
  for (std::uint32_t e = body.firstTriangle; e < body.lastTriangle; ++e) {
    if (model.triangles.isDropped(e)) continue;
    const double mass = body.material.density * body.thickness * model.triangles.area[e];
    const auto& nodes = model.triangles.nodes[e];
    for (std::size_t i = 0; i < 3; ++i) {
      const auto [low, high] = std::minmax(nodes[i], nodes[(i + 1) % 3]);
      const Vec2 along = model.nodes.position[high.value] - model.nodes.position[low.value];
      sides.push_back(
          {low, high, norm(along), 3 / mass, body.thickness * model.triangles.area[e] / 3});
    }
  }
  std::sort(sides.begin(), sides.end(), [](const Edge& a, const Edge& b) {
    return a.low != b.low ? a.low < b.low : a.high < b.high;
  });
  return sides;
}

struct EdgeSums {
  std::size_t inner = 0;
  double meanLength = 0;  // m, of inner and outer ones
  /// (m²/kg) Greatest (L/2)(1/m₁ + 1/m₂) of the inner ones.
  double lightest = 0;
  double leastVolume = INFINITY;  // m³, of the inner ones
};

EdgeSums sumsOf(const Model& model, const Component& body) {
  const std::vector<Edge> sides = sidesOf(model, body);
  EdgeSums sums;
  for (std::size_t i = 0; i < sides.size(); ++i) {
    if (i > 0 && sides[i].joins(sides[i - 1])) {
      ++sums.inner;
      const double inverse = sides[i].inverseMass + sides[i - 1].inverseMass;
      sums.lightest = std::max(sums.lightest, sides[i].length / 2 * inverse);
      sums.leastVolume = std::min(sums.leastVolume, sides[i].volume + sides[i - 1].volume);
    } else {
      sums.meanLength += sides[i].length;
    }
  }
  const std::size_t edges = sides.size() - sums.inner;
  if (edges > 0) sums.meanLength /= static_cast<double>(edges);
  return sums;
}

std::string named(const BrittleMaterial& material, ComponentId component) {
  return "fractureEnergy is " + text(material.fractureEnergy, " J/m²") + " in component " +
         std::to_string(component.value);
}

}  // namespace

void checkBrittle(const BrittleMaterial& material) {
  const auto positive = [](double x) { return x > 0 && std::isfinite(x); };
  const auto notNegative = [](double x) { return x >= 0 && std::isfinite(x); };
  require(positive(material.tensileStrength), "tensileStrength", material.tensileStrength, " Pa",
          "positive and finite for a material that cracks");
  require(notNegative(material.fractureEnergy), "fractureEnergy", material.fractureEnergy, " J/m²",
          "positive and finite, or 0 for cracks that open at once");
  require(positive(material.shearFactor), "shearFactor", material.shearFactor, "",
          "positive and finite");
  require(positive(material.shearEnergyFactor), "shearEnergyFactor", material.shearEnergyFactor, "",
          "positive and finite");
  require(notNegative(material.weibullModulus), "weibullModulus", material.weibullModulus, "",
          "positive and finite, or 0 for strengths without this scatter");
  require(notNegative(material.referenceVolume), "referenceVolume", material.referenceVolume, " m³",
          "positive and finite, or 0 for strengths on which the volume has no influence");
  require(material.strengthScatter >= 0 && material.strengthScatter < 1, "strengthScatter",
          material.strengthScatter, "", "at least 0 and below 1");
}

void checkCohesiveResolution(const Model& model, ComponentId component, double dt) {
  const Component& body = model.components[component.value];
  if (!body.brittle.cracks() || body.brittle.fractureEnergy <= 0) return;
  const EdgeSums sums = sumsOf(model, body);
  if (sums.inner == 0) return;
  const double strength = likelyLargestStrength(body.brittle, sums.inner, sums.leastVolume);
  const double critical = 2 * body.brittle.fractureEnergy / strength;
  const double crossed = dt * dt * body.thickness * sums.lightest * strength / 4;
  if (crossed < critical) return;
  const double ratio = critical / crossed;
  // Masses go with the size squared; with a step in proportion, what is crossed goes with the size.
  throw InputError(named(body.brittle, component) + ": a crack holds up to an opening of " +
                   text(critical, " m") + ", which a step of " + text(dt, " s") +
                   " does not resolve; a step of " + atMost(dt * std::sqrt(ratio), " s") +
                   " would do, or elements of " + atMost(ratio * sums.meanLength, " m") + " (now " +
                   text(sums.meanLength, " m") + ") with a step in proportion.");
}

std::string cohesiveZoneWarning(const Model& model, ComponentId component) {
  const Component& body = model.components[component.value];
  const BrittleMaterial& brittle = body.brittle;
  if (!brittle.cracks() || brittle.fractureEnergy <= 0) return {};
  const double zone = body.material.young / brittle.tensileStrength * brittle.fractureEnergy /
                      brittle.tensileStrength;
  const double size = sumsOf(model, body).meanLength;
  const double wanted = zone / kZoneElements;
  if (size <= wanted) return {};
  return named(brittle, component) + ": the cohesive zone is " + text(zone, " m") +
         " long, less than eight elements of " + text(size, " m") +
         "; notched or cracked bodies bear too much, with four elements half as much again, and "
         "elements of " +
         atMost(wanted, " m") + " would do.";
}

}  // namespace yadefrag
