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

/// (elements) Along the cohesive zone. A notched beam bears 2 to 9 % too much with four
/// (notched_beam_test.cpp).
constexpr double kZoneElements = 4;

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

std::string named(double fractureEnergy, ComponentId component) {
  return "fractureEnergy is " + text(fractureEnergy, " J/m²") + " in component " +
         std::to_string(component.value);
}

/// An edge's own values.
struct Cohesive {
  double strength;        // Pa
  double fractureEnergy;  // J/m²
  std::string where;      // of edges in bodies that are not the same everywhere
  [[nodiscard]] double critical() const { return 2 * fractureEnergy / strength; }
};

/// `crossed` (m): what a step takes from the opening.
void requireResolved(const Cohesive& edge, double crossed, double meanLength, ComponentId component,
                     double dt) {
  const double critical = edge.critical();
  if (crossed < critical) return;
  const double ratio = critical / crossed;
  // Masses go with the size squared; with a step in proportion, what is crossed goes with the size.
  throw InputError(named(edge.fractureEnergy, component) + edge.where +
                   ": a crack holds up to an opening of " + text(critical, " m") +
                   ", which a step of " + text(dt, " s") + " does not resolve; a step of " +
                   atMost(dt * std::sqrt(ratio), " s") + " would do, or elements of " +
                   atMost(ratio * meanLength, " m") + " (now " + text(meanLength, " m") +
                   ") with a step in proportion.");
}

std::string zoneSentence(const Component& body, const Cohesive& edge, double size,
                         ComponentId component) {
  const double zone = body.material.young / edge.strength * edge.fractureEnergy / edge.strength;
  const double wanted = zone / kZoneElements;
  if (size <= wanted) return {};
  return named(edge.fractureEnergy, component) + edge.where + ": the cohesive zone is " +
         text(zone, " m") + " long, less than four elements of " + text(size, " m") +
         "; notched or cracked bodies bear too much, and elements of " + atMost(wanted, " m") +
         " would do.";
}

/// (m²/kg) (L/2)(1/m₁ + 1/m₂) of an edge, m the least that one triangle can give to a node.
double lightnessOf(const Model& model, const CrackEdges& edges, EdgeId edge) {
  const Side side = edges.side(edge, 0);
  const Component& body = model.components[model.triangles.component[side.element.value].value];
  double inverse = 0;
  for (const ElementId element : edges.element[edge.value])
    inverse += 3 / (body.material.density * body.thickness * model.triangles.area[element.value]);
  const Vec2 along = model.nodes.position[lastNode(model, side).value] -
                     model.nodes.position[firstNode(model, side).value];
  return norm(along) / 2 * inverse;
}

/// The edge of a body with the least `measure`, of those that hold after they crack; none()
/// without.
template <class Measure>
EdgeId leastOf(const Model& model, const CrackEdges& edges, ComponentId component,
               Measure measure) {
  EdgeId least = EdgeId::none();
  double lowest = INFINITY;
  for (std::size_t i = 0; i < edges.size(); ++i) {
    const std::uint32_t element = edges.element[i][0].value;
    if (model.triangles.component[element] != component || edges.fractureEnergy[i] <= 0 ||
        model.triangles.isDropped(element) || model.triangles.isDropped(edges.element[i][1].value))
      continue;
    const double value = measure(EdgeId(i));
    if (value < lowest) lowest = value, least = EdgeId(i);
  }
  return least;
}

Cohesive valuesOf(const Model& model, const CrackEdges& edges, EdgeId edge) {
  const Vec2 at = model.nodes.position[firstNode(model, edges.side(edge, 0)).value];
  return {edges.strength[edge.value], edges.fractureEnergy[edge.value],
          " at (" + text(at.x, "") + ", " + text(at.y, "") + ")"};
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
  const double crossed = dt * dt * body.thickness * sums.lightest * strength / 4;
  requireResolved({strength, body.brittle.fractureEnergy, {}}, crossed, sums.meanLength, component,
                  dt);
}

void checkCohesiveResolution(const Model& model, const CrackEdges& edges, ComponentId component,
                             double dt) {
  const Component& body = model.components[component.value];
  if (!body.brittleByPlace) return checkCohesiveResolution(model, component, dt);
  const auto crossed = [&](EdgeId edge) {
    return dt * dt * body.thickness * lightnessOf(model, edges, edge) * edges.strength[edge.value] /
           4;
  };
  const EdgeId worst = leastOf(model, edges, component, [&](EdgeId edge) {
    return edges.fractureEnergy[edge.value] / edges.strength[edge.value] / crossed(edge);
  });
  if (worst == EdgeId::none()) return;
  requireResolved(valuesOf(model, edges, worst), crossed(worst), sumsOf(model, body).meanLength,
                  component, dt);
}

std::string cohesiveZoneWarning(const Model& model, ComponentId component) {
  const Component& body = model.components[component.value];
  const BrittleMaterial& brittle = body.brittle;
  if (!brittle.cracks() || brittle.fractureEnergy <= 0) return {};
  return zoneSentence(body, {brittle.tensileStrength, brittle.fractureEnergy, {}},
                      sumsOf(model, body).meanLength, component);
}

std::string cohesiveZoneWarning(const Model& model, const CrackEdges& edges,
                                ComponentId component) {
  const Component& body = model.components[component.value];
  if (!body.brittleByPlace) return cohesiveZoneWarning(model, component);
  const EdgeId worst = leastOf(model, edges, component, [&](EdgeId edge) {
    const double strength = edges.strength[edge.value];
    return edges.fractureEnergy[edge.value] / strength / strength;
  });
  if (worst == EdgeId::none()) return {};
  return zoneSentence(body, valuesOf(model, edges, worst), sumsOf(model, body).meanLength,
                      component);
}

}  // namespace yadefrag
