#include "step/body_check.hpp"

#include <cmath>
#include <limits>
#include <sstream>

#include "core/errors.hpp"
#include "fracture/checks.hpp"
#include "step/world.hpp"

namespace yadefrag {
namespace {

void require(bool holds, const char* name, double value, const char* unit, const char* right) {
  if (holds) return;
  std::ostringstream text;
  text << name << " is " << value << unit << "; it must be " << right << ".";
  throw InputError(text.str());
}

template <class Values>
void requireLength(const char* name, const Values& values, const TriangleMesh& mesh) {
  if (values.empty() || values.size() == mesh.nodes.size()) return;
  std::ostringstream text;
  text << name << " has " << values.size() << " values, but the mesh has " << mesh.nodes.size()
       << " nodes.";
  throw InputError(text.str());
}

void requireFinite(const char* name, const std::vector<Vec2>& values) {
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (isFinite(values[i])) continue;
    std::ostringstream text;
    text << name << " of node " << i << " is (" << values[i].x << ", " << values[i].y
         << "); it must be finite.";
    throw InputError(text.str());
  }
}

void requireHeld(const std::vector<std::uint8_t>& held) {
  for (const std::uint8_t one : held)
    require(one <= kHeldXY, "held", one, "", "0 to 3 for every node");
}

bool isPositive(double value) { return value > 0 && std::isfinite(value); }

void checkMaterial(const BodySpec& spec) {
  const ElasticMaterial& m = spec.material;
  const char* positive = "positive and finite";
  require(isPositive(m.young), "young", m.young, " Pa", positive);
  require(m.poisson > -1 && m.poisson < .5, "poisson", m.poisson, "", "above -1 and below 0.5");
  require(isPositive(m.density), "density", m.density, " kg/m³", positive);
  require(isPositive(spec.thickness), "thickness", spec.thickness, " m", positive);
  require(spec.friction >= 0 && std::isfinite(spec.friction), "friction", spec.friction, "",
          "0 or positive, and finite");
  if (spec.brittle.tensileStrength != 0) checkBrittle(spec.brittle);
}

/// A mass that is zero, or infinite, by the range of numbers alone.
void checkMasses(const TriangleMesh& mesh, const BodySpec& spec) {
  for (const auto& [a, b, c] : mesh.triangles) {
    const double twice = cross(mesh.nodes[b] - mesh.nodes[a], mesh.nodes[c] - mesh.nodes[a]);
    if (!(twice > 0)) continue;  // is told by the triangle's number
    const double mass = spec.material.density * spec.thickness * twice / 2;
    require(mass >= std::numeric_limits<double>::min() && std::isfinite(mass),
            "the mass of a triangle", mass, " kg", "in the range of numbers, from 2e-308 on");
  }
}

}  // namespace

void checkBody(const TriangleMesh& mesh, const BodySpec& spec) {
  requireLength("velocity", spec.velocity, mesh);
  requireLength("displacement", spec.displacement, mesh);
  requireLength("held", spec.held, mesh);
  requireLength("smoothNodes", spec.smoothNodes, mesh);
  requireFinite("velocity", spec.velocity);
  requireFinite("displacement", spec.displacement);
  requireHeld(spec.held);
  checkMaterial(spec);
  checkMasses(mesh, spec);
}

}  // namespace yadefrag
