#include <fmt/core.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <string>

#include "core/errors.hpp"
#include "core/tolerances/dynamics.hpp"
#include "core/tolerances/mesh.hpp"
#include "mesh/assembly.hpp"
#include "mesh/material_constants.hpp"
#include "step/world.hpp"

namespace yadefrag {
namespace {

/// Unless the sentence is empty.
void refuse(const std::string& sentence) {
  if (!sentence.empty()) throw InputError(sentence);
}

void require(bool holds, const char* name, double value, const char* unit, const char* right) {
  if (!holds) refuse(wrongValue(name, value, unit, right));
}

template <class Values>
void requireCount(const char* name, const Values& values, std::size_t count, const char* what) {
  if (values.empty() || values.size() == count) return;
  throw InputError(
      fmt::format("{} has {} values, but the mesh has {} {}.", name, values.size(), count, what));
}

void requireFinite(const char* name, const std::vector<Vec2>& values) {
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (isFinite(values[i])) continue;
    throw InputError(fmt::format("{} of node {} is ({:g}, {:g}); it must be finite.", name, i,
                                 values[i].x, values[i].y));
  }
}

void requireSlow(const std::vector<Vec2>& velocities) {
  for (const Vec2 velocity : velocities)
    for (const double one : {velocity.x, velocity.y})
      require(std::abs(one) <= tolerance::kMostSpeed, "velocity", one, " m/s", "at most 1e100 m/s");
}

void requireHeld(const std::vector<std::uint8_t>& held) {
  for (const std::uint8_t one : held)
    require(one <= kHeldXY, "held", one, "", "0 to 3 for every node");
}

void checkDisplacement(const TriangleMesh& mesh, const std::vector<Vec2>& displacement) {
  if (displacement.empty()) return;
  const auto at = [&](std::uint32_t node) { return mesh.nodes[node] + displacement[node]; };
  for (const auto& [a, b, c] : mesh.triangles) {
    if (cross(at(b) - at(a), at(c) - at(a)) > 0) continue;
    throw InputError(
        fmt::format("displacement inverts the triangle at ({:g}, {:g}) m; every triangle must keep "
                    "its corners' counter-clockwise order.",
                    mesh.nodes[a].x, mesh.nodes[a].y));
  }
}

bool isPositive(double value) { return value > 0 && std::isfinite(value); }

/// Only of what fails.
void checkScatter(const BodyMaterial& one) {
  if (one.plastic.fails() && !one.plastic.isFrictional()) return;
  using M = BrittleMaterial;
  for (double M::*const scatter : {&M::weibullModulus, &M::strengthScatter})
    if (one.brittle.*scatter != 0)
      refuse(brittleConstants().wrong(
          one.brittle, scatter,
          "0 unless failureStrain, failureD1, failureD2 or spallStress is given"));
}

void checkMaterial(const BodyMaterial& one) {
  refuse(elasticConstants().wrong(one.material));
  require(one.friction >= 0 && std::isfinite(one.friction), "friction", one.friction, "",
          "0 or positive, and finite");
  refuse(brittleConstants().wrong(one.brittle));
  if (!one.plastic.yields()) return;
  checkScatter(one);
  if (one.plastic.isFrictional() && one.material.planeStress)
    refuse("planeStress is True, but the material is frictional; it must be False.");
  refuse(one.plastic.wrong());
}

/// One material, or several with a number for each triangle.
void checkMaterials(const TriangleMesh& mesh, const BodySpec& spec) {
  if (spec.materials.empty()) return checkMaterial(spec);
  if (spec.element == ElementKind::kSmoothed)
    throw InputError(
        "element is 'smoothed', but the body has several materials, whose strains must not be "
        "averaged where they meet; it must be 'linear', or bodies of one material each, bonded.");
  for (const BodyMaterial& one : spec.materials.materials) {
    if (one.plastic.yields())
      throw InputError(
          "the body has several materials, one of which yields; it must be a body of its own, "
          "bonded to the others.");
    checkMaterial(one);
  }
  requireCount("material", spec.materials.ofTriangle, mesh.triangles.size(), "triangles");
  for (const std::uint32_t number : spec.materials.ofTriangle)
    require(number < spec.materials.materials.size(), "material", number, "",
            "the number of one of the body's materials");
}

const BodyMaterial& materialOf(const BodySpec& spec, std::size_t triangle) {
  if (spec.materials.empty()) return spec;
  return spec.materials.materials[spec.materials.ofTriangle[triangle]];
}

void checkPlaces(const TriangleMesh& mesh, const BodySpec& spec) {
  const BrittlePlaces& places = spec.places;
  BodySpec apart = {};  // an elastic body cracks along joints
  static_cast<BodyMaterial&>(apart) = spec, apart.materials = spec.materials;
  if (!(places.strength.empty() && places.fractureEnergy.empty()) &&
      !wholeOf(apart).brittle.cracks())
    throw InputError(
        "strength or fractureEnergy is given, but the material neither cracks nor fails; it must "
        "be a BrittleFEMat, or a PlasticFEMat with a failure strain or a spall stress.");
  if (spec.plastic.yields() && !places.joints.empty())
    throw InputError("joints are given, but the material yields; it must be a BrittleFEMat.");
  if (spec.plastic.isFrictional() && !places.strength.empty())
    throw InputError(
        "strength is given, but the material is a FrictionalFEMat; it must be a BrittleFEMat, or a "
        "PlasticFEMat that fails.");
  const bool spalls = spec.plastic.failure.spallStress < FailureLaw::kNone;
  const auto notNegative = [](double value) { return value >= 0 && std::isfinite(value); };
  requireCount("strength", places.strength, mesh.triangles.size(), "triangles");
  requireCount("fractureEnergy", places.fractureEnergy, mesh.triangles.size(), "triangles");
  for (const double one : places.strength)
    require(isPositive(one), "strength", one, spec.plastic.fails() ? "" : " Pa",
            "positive and finite for every triangle");
  for (const double one : places.fractureEnergy) {
    require(notNegative(one), "fractureEnergy", one, " J/m²",
            "0 or positive, and finite, for every triangle");
    require(one > 0 || !spalls, "fractureEnergy", one, " J/m²",
            "positive for every triangle of a material that spalls");
  }
  for (const JointEdge& joint : places.joints) {
    assert(joint.nodes[0] < mesh.nodes.size() && joint.nodes[1] < mesh.nodes.size());
    require(std::isnan(joint.strength) || notNegative(joint.strength), "jointStrength",
            joint.strength, " Pa", "0 or positive, and finite");
    require(std::isnan(joint.fractureEnergy) || notNegative(joint.fractureEnergy), "jointEnergy",
            joint.fractureEnergy, " J/m²", "0 or positive, and finite");
  }
}

/// (m/s)
double fastestNode(const BodySpec& spec) {
  double fastest = 0;
  for (const Vec2 velocity : spec.velocity) fastest = std::max(fastest, norm(velocity));
  return fastest;
}

/// A mass, an energy or a stiffness that is zero or infinite only because of the range of numbers.
void checkMasses(const TriangleMesh& mesh, const BodySpec& spec) {
  constexpr const char* kRange = "in the range of numbers, from 2e-308 to 2e+305";
  const auto isInRange = [](double value) {
    using Limits = std::numeric_limits<double>;
    return value >= Limits::min() && value <= Limits::max() / tolerance::kMostSummed;
  };
  const double fastest = fastestNode(spec);
  double energies = 0;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const auto& [a, b, c] = mesh.triangles[t];
    const ElasticMaterial& material = materialOf(spec, t).material;
    const double modulus = material.waveModulus();
    const double twice = cross(mesh.nodes[b] - mesh.nodes[a], mesh.nodes[c] - mesh.nodes[a]);
    const double mass = material.density * spec.thickness * twice / 2;
    require(isInRange(mass), "the mass of a triangle", mass, " kg", kRange);
    energies += mass * std::max(1., fastest * fastest);
    const Vec2 edges[] = {mesh.nodes[b] - mesh.nodes[a], mesh.nodes[c] - mesh.nodes[b],
                          mesh.nodes[a] - mesh.nodes[c]};
    for (const Vec2 edge : edges) {
      const double stiffness = modulus * spec.thickness * (dot(edge, edge) / twice);
      require(isInRange(stiffness), "the stiffness of a triangle", stiffness, " N/m", kRange);
    }
  }
  require(isInRange(energies), "the mass of the body, or its kinetic energy,", energies, " kg or J",
          kRange);
}

struct Extent {
  double farthest = 0;         // m, largest coordinate
  double shortest = INFINITY;  // m, edge
};

Extent extentOf(const TriangleMesh& mesh) {
  Extent extent;
  for (const Vec2 node : mesh.nodes)
    extent.farthest = std::max({extent.farthest, std::abs(node.x), std::abs(node.y)});
  for (const auto& t : mesh.triangles)
    for (int i = 0; i < 3; ++i)
      extent.shortest =
          std::min(extent.shortest, norm(mesh.nodes[t[(i + 1) % 3]] - mesh.nodes[t[i]]));
  return extent;
}

/// (m/s) Largest speed of compression waves.
double fastestWave(const BodySpec& spec) {
  const auto wave = [](const ElasticMaterial& m) { return std::sqrt(m.waveModulus() / m.density); };
  if (spec.materials.empty()) return wave(spec.material);
  double fastest = 0;
  for (const BodyMaterial& one : spec.materials.materials)
    fastest = std::max(fastest, wave(one.material));
  return fastest;
}

/// Checks that strains and displacements in a step are larger than the rounding of coordinates.
void checkRounding(const TriangleMesh& mesh, const BodySpec& spec) {
  const Extent extent = extentOf(mesh);
  if (extent.shortest < tolerance::kLeastSize * extent.farthest)
    throw InputError(fmt::format(
        "The mesh has an edge of {:g} m and a coordinate of {:g} m, whose rounding is too large "
        "for "
        "that edge; edges must be longer than {:g} m, or the scene nearer to the origin.",
        extent.shortest, extent.farthest, tolerance::kLeastSize * extent.farthest));
  const double fastest = fastestNode(spec);
  const double step = extent.shortest / fastestWave(spec);
  const double seen = tolerance::kLeastMotion * extent.farthest;
  if (fastest == 0 || fastest * step >= seen) return;
  throw InputError(fmt::format(
      "velocity is {:g} m/s at most: at coordinates of {:g} m, a step of {:g} s would be lost in "
      "rounding; it must be zero or above {:g} m/s, or the scene nearer to the origin.",
      fastest, extent.farthest, step, seen / step));
}

/// `across`: NaN if it is not given.
bool hasStretch(const ElasticMaterial& material, const std::array<double, 3>& stress, double across,
                bool yields, bool axisymmetric) {
  const bool isSpatial = !material.planeStress && !std::isnan(across);
  if (isSpatial && yields) return stretchOf(material, stress, across).has_value();
  if (isSpatial && axisymmetric) return stretchAround(material, stress, across).has_value();
  return stretchOf(material, stress) && !std::isinf(across);
}

void checkStress(const TriangleMesh& mesh, const BodySpec& spec, bool axisymmetric) {
  if (spec.stress.empty()) return;
  requireCount("stress", spec.stress, mesh.triangles.size(), "triangles");
  if (!spec.displacement.empty())
    throw InputError("displacement and stress are both given, but only one of them can be.");
  requireCount("stress", spec.stressAcross, mesh.triangles.size(), "triangles");
  for (std::size_t t = 0; t < spec.stress.size(); ++t) {
    const auto& stress = spec.stress[t];
    const ElasticMaterial& material = materialOf(spec, t).material;
    const double across = spec.stressAcross.empty() ? NAN : spec.stressAcross[t];
    require(!material.planeStress || std::isnan(across) || across == 0, "stress zz", across, " Pa",
            "0 in plane stress");
    if (hasStretch(material, stress, across, spec.plastic.yields(), axisymmetric)) continue;
    const Vec2 at = mesh.nodes[mesh.triangles[t][0]];
    throw InputError(
        fmt::format("stress at ({:g}, {:g}) m is ({:g}, {:g}, {:g}{}) Pa, by which the material "
                    "with young {:g} Pa would be strained by more than half; it must be less, and "
                    "finite.",
                    at.x, at.y, stress[0], stress[1], stress[2],
                    std::isnan(across) ? "" : fmt::format(", {:g}", across), material.young));
  }
}

}  // namespace

void checkBody(const TriangleMesh& mesh, const BodySpec& spec, bool axisymmetric) {
  const std::size_t nodes = mesh.nodes.size();
  requireCount("velocity", spec.velocity, nodes, "nodes");
  requireCount("displacement", spec.displacement, nodes, "nodes");
  requireCount("held", spec.held, nodes, "nodes");
  requireCount("smoothNodes", spec.smoothNodes, nodes, "nodes");
  requireFinite("velocity", spec.velocity);
  requireSlow(spec.velocity);
  requireFinite("displacement", spec.displacement);
  requireHeld(spec.held);
  require(isPositive(spec.thickness), "thickness", spec.thickness, " m", "positive and finite");
  checkMaterials(mesh, spec);
  checkPlaces(mesh, spec);
  checkTriangles(mesh);
  checkDisplacement(mesh, spec.displacement);
  checkStress(mesh, spec, axisymmetric);
  checkMasses(mesh, spec);
  checkRounding(mesh, spec);
}

}  // namespace yadefrag
