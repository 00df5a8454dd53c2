#include "fracture/brittle_checks.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <utility>
#include <vector>

#include "core/errors.hpp"
#include "core/tolerances/fracture.hpp"
#include "fracture/edge_strength.hpp"
#include "mesh/material_constants.hpp"
#include "meshing/polygon.hpp"

namespace yadefrag {
namespace {

/// A permitted value for messages, with a margin for the rounding to three digits.
double atMost(double value) { return .99 * value; }

struct EdgeSums {
  std::size_t inner = 0;
  double meanLength = 0;  // m, of inner and outer edges
  /// (m²/kg) Greatest (L/2)(1/m₁ + 1/m₂) of the inner edges.
  double lightest = 0;
  double leastVolume = INFINITY;  // m³, of the inner edges
};

EdgeSums sumsOf(const Model& model, const Component& body) {
  const std::vector<KeyedSide> sides = sidesByNodes(model, body);
  EdgeSums sums;
  const auto thirdOf = [&](ElementId e) {  // m³, a third of a triangle's volume
    return model.depthOf(e) * model.triangles.area[e.value] / 3;
  };
  // 1/kg, for the least mass that a node of this triangle may have.
  const auto inverseMass = [&](ElementId e) {
    return 3 /
           (model.materialOf(e).material.density * body.thickness * model.triangles.area[e.value]);
  };
  for (std::size_t i = 0; i < sides.size(); ++i) {
    const std::vector<Vec2>& at = model.nodes.position;
    const double length = norm(at[sides[i].high.value] - at[sides[i].low.value]);
    if (i > 0 && sides[i].joins(sides[i - 1])) {
      const ElementId a = sides[i].side.element, b = sides[i - 1].side.element;
      ++sums.inner;
      sums.lightest = std::max(sums.lightest, length / 2 * (inverseMass(a) + inverseMass(b)));
      sums.leastVolume = std::min(sums.leastVolume, thirdOf(a) + thirdOf(b));
    } else {
      sums.meanLength += length;
    }
  }
  const std::size_t edges = sides.size() - sums.inner;
  if (edges > 0) sums.meanLength /= static_cast<double>(edges);
  return sums;
}

std::string named(double fractureEnergy, ComponentId component) {
  return fmt::format("fractureEnergy is {:.4g} J/m² in component {}", fractureEnergy,
                     component.value);
}

/// The factor of the rate effect at which an edge is the hardest to resolve: its zone and its
/// openings over their closing in one step are both proportional to the factor to the power of p −
/// 2. 1 for cracks, which have their final values.
double hardestFactor(const BrittleMaterial& material, bool isCrack = false) {
  if (isCrack || !material.rate.isOn()) return 1;
  return material.rateEnergyPower <= 2 ? material.rate.largest() : material.rate.least();
}

double hardestFactor(const Model& model, const CrackEdges& edges, EdgeId edge) {
  const auto [a, b] = edges.element[edge.value];
  return hardestFactor(materialBetween(model, a, b).brittle, edges.cracked[edge.value] != 0);
}

/// Cohesive values of one edge.
struct Cohesive {
  double strength;        // Pa
  double fractureEnergy;  // J/m²
  std::string name;       // for messages: the energy, and the edge or body that has it
  const BrittleMaterial& material;
  [[nodiscard]] double steep() const {
    return material.softening.steepOpening(strength, fractureEnergy);
  }
  /// At the strain rate of this factor.
  [[nodiscard]] Cohesive raised(double factor) const {
    if (factor == 1) return *this;
    return {factor * strength, std::pow(factor, material.rateEnergyPower) * fractureEnergy,
            fmt::format("{}, with the factor {:.3g} of rateEffect", name, factor), material};
  }
};

/// `crossed` (m): the closing of the crack in one step by its tractions.
void requireResolved(const Cohesive& edge, double crossed, double meanLength, double dt) {
  const double steep = edge.steep();
  if (crossed < steep) return;
  const double ratio = steep / crossed;
  const bool isLine = edge.material.softening == SofteningCurve();
  // Masses are proportional to the size squared. With a step in proportion to the size, `crossed`
  // is proportional to the size.
  throw InputError(fmt::format(
      "{}: a crack {} an opening of {:.4g} m, which a step of {:.4g} s "
      "does not resolve; "
      "a step of at most {:.3g} s is sufficient, or elements of at most {:.3g} m (now "
      "{:.4g} m) with a "
      "step in proportion.",
      edge.name, isLine ? "is cohesive up to" : "softens as steeply as by its strength over", steep,
      dt, atMost(dt * std::sqrt(ratio)), atMost(tolerance::kAdvisedSize * ratio * meanLength),
      meanLength));
}

std::string zoneSentence(double young, const Cohesive& edge, double size) {
  const double zone = cohesiveZone(young, edge.fractureEnergy, edge.strength, edge.material);
  const double wanted = zone / tolerance::kZoneElements;
  if (size <= wanted) return {};
  return fmt::format(
      "{}: the cohesive zone {}is {:.4g} m long, less than four elements of {:.4g} m; notched or "
      "cracked "
      "bodies carry too much load; elements of at most {:.3g} m are sufficient.",
      edge.name, slidingZone(edge.material) < 1 ? "of a sliding crack " : "", zone, size,
      atMost(tolerance::kAdvisedSize * wanted));
}

/// A zone that is long beside the body. Of an opening crack, also where a sliding one is shorter.
std::string wideSentence(double young, const Cohesive& edge, double width) {
  const double zone = cohesiveZone(young, edge.fractureEnergy, edge.strength, edge.material) /
                      std::min(1., slidingZone(edge.material));
  const double most = tolerance::kMostZone * width;
  if (zone <= most) return {};
  return fmt::format(
      "{}: the cohesive zone is {:.4g} m long, more than half of the body's smallest width of "
      "{:.4g} "
      "m; in bending and compression it then carries more than its strength; with a fractureEnergy "
      "of at most {:.3g} J/m² it does not.",
      edge.name, zone, width, atMost(most / zone * edge.fractureEnergy));
}

double widthOf(const Model& model, const Component& body) {
  std::vector<Vec2> points;
  for (std::uint32_t t = body.firstTriangle; t < body.lastTriangle; ++t)
    for (const NodeId node : model.triangles.nodes[t])
      points.push_back(model.nodes.position[node.value]);
  return smallestWidth(std::move(points));
}

std::string bodyZoneSentence(const Model& model, const Component& body, double young,
                             const Cohesive& edge) {
  std::string sentence = zoneSentence(young, edge, sumsOf(model, body).meanLength);
  if (sentence.empty()) return wideSentence(young, edge, widthOf(model, body));
  sentence.pop_back();
  return sentence + "; coarseMesh='strength' gives cracks the right load on this mesh.";
}

/// (m²/kg) (L/2)(1/m₁ + 1/m₂) of an edge, where m is the least mass of a node with one triangle
/// only.
double lightnessOf(const Model& model, const CrackEdges& edges, EdgeId edge) {
  const Side side = edges.side(edge, 0);
  double inverse = 0;
  for (const ElementId element : edges.element[edge.value])
    inverse += 3 / (model.materialOf(element).material.density * model.bodyOf(element).thickness *
                    model.triangles.area[element.value]);
  const Vec2 along = model.nodes.position[lastNode(model, side).value] -
                     model.nodes.position[firstNode(model, side).value];
  return norm(along) / 2 * inverse;
}

/// The edge with the least `measure` out of those from `first` on for which `counts` is true and
/// that are cohesive after cracking; none() if there is none. Those without a strength yet do not
/// count.
template <class Counts, class Measure>
EdgeId leastOf(const Model& model, const CrackEdges& edges, EdgeId first, Counts counts,
               Measure measure) {
  EdgeId least = EdgeId::none();
  double lowest = INFINITY;
  for (std::size_t i = first.value; i < edges.size(); ++i) {
    const auto& [a, b] = edges.element[i];
    if (edges.fractureEnergy[i] <= 0 || edges.strength[i] == kUnbreakable || !counts(EdgeId(i)) ||
        model.triangles.isDropped(a.value) || model.triangles.isDropped(b.value))
      continue;
    const double value = measure(EdgeId(i));
    if (value < lowest) lowest = value, least = EdgeId(i);
  }
  return least;
}

/// True for an edge inside the body.
auto inside(const Model& model, const CrackEdges& edges, ComponentId component) {
  return [&model, &edges, component](EdgeId edge) {
    return model.triangles.component[edges.element[edge.value][0].value] == component &&
           !edges.isBond(model, edge);
  };
}

Cohesive valuesOf(const Model& model, const CrackEdges& edges, EdgeId edge) {
  const Vec2 at = model.nodes.position[firstNode(model, edges.side(edge, 0)).value];
  const auto [a, b] = edges.element[edge.value];
  const ComponentId one = model.triangles.component[a.value];
  const ComponentId other = model.triangles.component[b.value];
  const double energy = edges.fractureEnergy[edge.value];
  const std::string name =
      one == other ? named(energy, one)
                   : fmt::format("energy is {:.4g} J/m² of the bond between the bodies {} and {}",
                                 energy, one.value, other.value);
  const BrittleMaterial& brittle = materialBetween(model, a, b).brittle;
  return {edges.strength[edge.value], energy,
          fmt::format("{} at ({:.4g}, {:.4g})", name, at.x, at.y), brittle};
}

double crossedBy(const Model& model, const CrackEdges& edges, EdgeId edge, double dt) {
  const double thickness = model.bodyOf(edges.element[edge.value][0]).thickness;
  return dt * dt * thickness * lightnessOf(model, edges, edge) * edges.strength[edge.value] / 4;
}

/// Opening over closing in one step, and length of the zone: at a factor of the rate effect, over
/// those without it.
double byRate(const Model& model, const CrackEdges& edges, EdgeId edge) {
  const double factor = hardestFactor(model, edges, edge);
  if (factor == 1) return 1;
  const auto [a, b] = edges.element[edge.value];
  return std::pow(factor, materialBetween(model, a, b).brittle.rateEnergyPower - 2);
}

/// The edge whose opening is the smallest in relation to its closing in one step.
template <class Counts>
EdgeId leastResolved(const Model& model, const CrackEdges& edges, Counts counts, double dt) {
  return leastOf(model, edges, EdgeId(std::size_t{0}), counts, [&](EdgeId edge) {
    const auto& [a, b] = edges.element[edge.value];
    const SofteningCurve& curve = materialBetween(model, a, b).brittle.softening;
    return curve.steepOpening(edges.strength[edge.value], edges.fractureEnergy[edge.value]) *
           byRate(model, edges, edge) / crossedBy(model, edges, edge, dt);
  });
}

double lengthOf(const Model& model, const CrackEdges& edges, EdgeId edge) {
  const Side side = edges.side(edge, 0);
  return norm(model.nodes.position[lastNode(model, side).value] -
              model.nodes.position[firstNode(model, side).value]);
}

/// (Pa) For a crack between two materials: the modulus of their mean compliance.
double youngAt(const Model& model, const CrackEdges& edges, EdgeId edge) {
  const auto [a, b] = edges.element[edge.value];
  return modulusOfBoth(model.materialOf(a).material.young, model.materialOf(b).material.young);
}

double zoneOf(const Model& model, const CrackEdges& edges, EdgeId edge) {
  const auto [a, b] = edges.element[edge.value];
  const BrittleMaterial& brittle = materialBetween(model, a, b).brittle;
  return byRate(model, edges, edge) * cohesiveZone(youngAt(model, edges, edge),
                                                   edges.fractureEnergy[edge.value],
                                                   edges.strength[edge.value], brittle);
}

}  // namespace

void checkBrittle(const BrittleMaterial& material) {
  const Constants<BrittleMaterial> all = brittleConstants();
  std::string sentence = all.wrong(material);
  if (sentence.empty() && material.tensileStrength == 0)
    sentence = all.wrong(material, &BrittleMaterial::tensileStrength, all.front().limits.words);
  if (!sentence.empty()) throw InputError(sentence);
}

void checkCohesiveResolution(const Model& model, ComponentId component, double dt) {
  const Component& body = model.components[component.value];
  if (!body.brittle.cracks() || body.brittle.fractureEnergy <= 0) return;
  const EdgeSums sums = sumsOf(model, body);
  if (sums.inner == 0) return;
  const double strength = likelyLargestStrength(body.brittle, sums.inner, sums.leastVolume);
  const double factor = hardestFactor(body.brittle);
  const double crossed = dt * dt * body.thickness * sums.lightest * (factor * strength) / 4;
  const double energy = body.brittle.fractureEnergy;
  const Cohesive edge{strength, energy, named(energy, component), body.brittle};
  requireResolved(edge.raised(factor), crossed, sums.meanLength, dt);
}

void checkCohesiveResolution(const Model& model, const CrackEdges& edges, ComponentId component,
                             double dt) {
  const Component& body = model.components[component.value];
  if (!body.brittleByPlace) return checkCohesiveResolution(model, component, dt);
  const EdgeId worst = leastResolved(model, edges, inside(model, edges, component), dt);
  if (worst == EdgeId::none()) return;
  const double factor = hardestFactor(model, edges, worst);
  requireResolved(valuesOf(model, edges, worst).raised(factor),
                  factor * crossedBy(model, edges, worst, dt), sumsOf(model, body).meanLength, dt);
}

bool isResolved(const Model& model, const CrackEdges& edges, EdgeId edge, double dt) {
  const auto& [a, b] = edges.element[edge.value];
  const SofteningCurve& curve = materialBetween(model, a, b).brittle.softening;
  const double energy = edges.fractureEnergy[edge.value];
  return energy <= 0 ||
         crossedBy(model, edges, edge, dt) < curve.steepOpening(edges.strength[edge.value], energy);
}

void checkBondResolution(const Model& model, const CrackEdges& edges, double dt) {
  const auto isBond = [&](EdgeId edge) { return edges.isBond(model, edge); };
  const EdgeId worst = leastResolved(model, edges, isBond, dt);
  if (worst == EdgeId::none()) return;
  requireResolved(valuesOf(model, edges, worst), crossedBy(model, edges, worst, dt),
                  lengthOf(model, edges, worst), dt);
}

std::string cohesiveZoneWarning(const Model& model, ComponentId component) {
  const Component& body = model.components[component.value];
  const BrittleMaterial& brittle = body.brittle;
  if (!brittle.cracks() || brittle.fractureEnergy <= 0) return {};
  const std::string name = named(brittle.fractureEnergy, component);
  const Cohesive edge{brittle.tensileStrength, brittle.fractureEnergy, name, brittle};
  return bodyZoneSentence(model, body, body.material.young, edge.raised(hardestFactor(brittle)));
}

std::string cohesiveZoneWarning(const Model& model, const CrackEdges& edges,
                                ComponentId component) {
  const Component& body = model.components[component.value];
  if (!body.brittleByPlace) return cohesiveZoneWarning(model, component);
  const EdgeId worst =
      leastOf(model, edges, EdgeId(std::size_t{0}), inside(model, edges, component),
              [&](EdgeId edge) { return zoneOf(model, edges, edge); });
  if (worst == EdgeId::none()) return {};
  return bodyZoneSentence(model, body, youngAt(model, edges, worst),
                          valuesOf(model, edges, worst).raised(hardestFactor(model, edges, worst)));
}

std::string bondZoneWarning(const Model& model, const CrackEdges& edges, EdgeId first) {
  const EdgeId worst = leastOf(
      model, edges, first, [&](EdgeId edge) { return edges.isBond(model, edge); },
      [&](EdgeId edge) { return zoneOf(model, edges, edge) / lengthOf(model, edges, edge); });
  if (worst == EdgeId::none()) return {};
  return zoneSentence(youngAt(model, edges, worst), valuesOf(model, edges, worst),
                      lengthOf(model, edges, worst));
}

}  // namespace yadefrag
