#include "mesh/assembly.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "core/errors.hpp"
#include "core/lanes.hpp"
#include "core/tolerances/mesh.hpp"

namespace yadefrag {

namespace {

/// The tensor with these principal values, in the directions of `stress`.
std::array<double, 3> turned(const std::array<double, 3>& stress, double radius, double first,
                             double second) {
  const double middle = (first + second) / 2, half = (stress[0] - stress[1]) / 2;
  if (radius == 0) return {middle, middle, 0};
  const double by = (first - second) / (2 * radius);
  return {middle + by * half, middle - by * half, by * stress[2]};
}

bool isSmall(double strain) { return std::abs(strain) <= tolerance::kMostStretch; }

}  // namespace

/// In principal directions σ₁ = P₁/s₂ and σ₂ = P₂/s₁, where P is a function of the stretches s: two
/// linear equations for s₁ − 1 and s₂ − 1.
std::optional<std::array<double, 3>> stretchOf(const ElasticMaterial& material,
                                               const std::array<double, 3>& stress) {
  const double modulus = material.waveModulus(), lame = material.lame();
  const double mean = (stress[0] + stress[1]) / 2, half = (stress[0] - stress[1]) / 2;
  const double radius = std::hypot(half, stress[2]);
  const double s1 = mean + radius, s2 = mean - radius;
  const double det = modulus * modulus - (lame - s1) * (lame - s2);
  const double e1 = (modulus * s1 - (lame - s1) * s2) / det;
  const double e2 = (modulus * s2 - (lame - s2) * s1) / det;
  if (!isSmall(e1) || !isSmall(e2)) return std::nullopt;
  return turned(stress, radius, 1 + e1, 1 + e2);
}

/// In principal directions σ det F = κ (J² − 1)/2 + 2μe, where det F is that in the plane.
std::optional<SpatialStretch> stretchOf(const ElasticMaterial& material,
                                        const std::array<double, 3>& stress, double across) {
  const double bulk = material.young / (3 * (1 - 2 * material.poisson));
  const double shear = material.shearModulus();
  const double middle = (stress[0] + stress[1]) / 2;
  const double radius = std::hypot((stress[0] - stress[1]) / 2, stress[2]);
  const double mean = (2 * middle + across) / 3;
  double size = 1, last = 0;
  std::array<double, 3> stretches{};
  for (int i = 0; i < tolerance::kStretches && size != last; ++i) {
    const double squared = 1 + 2 * size * mean / bulk;  // J²
    if (!(squared > 0)) return std::nullopt;
    const auto stretchAt = [&](double one) {
      return expOf(size * (one - mean) / (2 * shear) + logOf(squared) / 6);
    };
    stretches = {stretchAt(middle + radius), stretchAt(middle - radius), stretchAt(across)};
    last = size, size = stretches[0] * stretches[1];
    for (const double one : stretches)
      if (!isSmall(one - 1)) return std::nullopt;
  }
  return SpatialStretch{turned(stress, radius, stretches[0], stretches[1]), stretches[2]};
}

std::optional<SpatialStretch> stretchAround(const ElasticMaterial& material,
                                            const std::array<double, 3>& stress, double around) {
  const double shear = material.shearModulus(), lame = material.lame();
  const double middle = (stress[0] + stress[1]) / 2;
  const double radius = std::hypot((stress[0] - stress[1]) / 2, stress[2]);
  const std::array<double, 3> principal{middle + radius, middle - radius, around};
  std::array<double, 3> stretches{1, 1, 1}, last{};
  for (int i = 0; i < tolerance::kStretches && stretches != last; ++i) {
    last = stretches;
    std::array<double, 3> piola{};
    double sum = 0;
    for (std::size_t k = 0; k < 3; ++k)
      sum += piola[k] = principal[k] * last[(k + 1) % 3] * last[(k + 2) % 3];
    const double mean = lame * sum / (2 * shear + 3 * lame);
    for (std::size_t k = 0; k < 3; ++k) {
      stretches[k] = 1 + (piola[k] - mean) / (2 * shear);
      if (!isSmall(stretches[k] - 1)) return std::nullopt;
    }
  }
  return SpatialStretch{turned(stress, radius, stretches[0], stretches[1]), stretches[2]};
}

/// F = d·D⁻¹ is the stretch S for the present edges d: D⁻¹ = d⁻¹·S.
void stretch(Triangles& triangles, ElementId element, const std::array<double, 3>& stretch) {
  const auto [xx, yy, xy] = stretch;
  auto& i = triangles.inverseEdges[element.value];
  i = {i[0] * xx + i[1] * xy, i[0] * xy + i[1] * yy, i[2] * xx + i[3] * xy, i[2] * xy + i[3] * yy};
  triangles.area[element.value] /= xx * yy - xy * xy;
}

namespace {

void addMasses(Model& model, const Component& c) {
  for (std::size_t t = c.firstTriangle; t < c.lastTriangle; ++t) {
    const ElementId e(t);
    const double density = model.materialOf(e).material.density * model.depthOf(e);
    for (std::size_t i = 0; i < 3; ++i)
      model.nodes.mass[model.triangles.nodes[t][i].value] +=
          density * model.triangles.area[t] / 3 * model.massShare(e, i);
  }
}

void appendTriangle(Triangles& triangles, const std::array<Vec2, 3>& x) {
  const Vec2 d1 = x[1] - x[0];
  const Vec2 d2 = x[2] - x[0];
  const double det = cross(d1, d2);
  triangles.inverseEdges.push_back({d2.y / det, -d2.x / det, -d1.y / det, d1.x / det});
  triangles.area.push_back(det / 2);
}

bool anyYields(const Model& model) {
  return std::ranges::any_of(model.components, &Component::yields);
}

bool anyFails(const Model& model) {
  return std::ranges::any_of(model.components, &Component::fails);
}

/// Rows of bodies that do not yield have no meaning.
void appendPlasticState(Model& model, const Component& added) {
  PlasticState& state = model.triangles.plastic;
  if (!anyYields(model)) return;
  state.resize(model.triangles.size());
  if (anyFails(model)) state.damage.resize(model.triangles.size());
  if (!state.resistance.empty()) state.resistance.resize(model.triangles.size(), 1);
  if (added.yields())
    for (std::size_t e = added.firstTriangle; e < added.lastTriangle; ++e)
      state.begin(e, model.triangles.inverseEdges[e], added.plastic.startTemperature);
}

/// Returns the stretches across the plane, if they are state of the body.
std::vector<double> addStress(Model& model, const Component& added,
                              std::span<const std::array<double, 3>> stress,
                              std::span<const double> across) {
  Triangles& triangles = model.triangles;
  std::vector<double> thickness;
  const bool isSpatial = !across.empty() && !added.material.planeStress;
  if (isSpatial && added.yields()) thickness.resize(stress.size(), 1);
  if ((isSpatial && !added.yields() && !model.axisymmetric) || !triangles.stressAcross.empty())
    triangles.stressAcross.resize(triangles.size());
  for (std::size_t t = 0; t < stress.size(); ++t) {
    const ElementId element(added.firstTriangle + t);
    const ElasticMaterial& material = model.materialOf(element).material;
    const bool isGiven = isSpatial && !std::isnan(across[t]);
    if (isGiven && added.yields()) {
      const SpatialStretch all = stretchOf(material, stress[t], across[t]).value();
      stretch(triangles, element, all.plane);
      thickness[t] = all.across;
      continue;
    }
    if (isGiven && model.axisymmetric) {
      const SpatialStretch all = stretchAround(material, stress[t], across[t]).value();
      stretch(triangles, element, all.plane);
      triangles.radius[element.value] /= all.across;
      continue;
    }
    stretch(triangles, element, stretchOf(material, stress[t]).value());
    if (isGiven)
      triangles.stressAcross[element.value] =
          across[t] - material.poisson * (stress[t][0] + stress[t][1]);
  }
  return thickness;
}

void removeTriangles(Model& model, Component& gone) {
  const std::uint32_t first = gone.firstTriangle;
  const std::uint32_t last = gone.lastTriangle;
  keepRows(model.triangles.columns(), model.triangles.size(),
           [&](std::size_t t) { return t < first || t >= last; });
  for (Component& c : model.components)
    if (c.firstTriangle >= last) {
      c.firstTriangle -= last - first;
      c.lastTriangle -= last - first;
    }
  gone.firstTriangle = gone.lastTriangle = first;
}

void appendMaterials(Model& model, const MaterialPlaces& places, Component& added) {
  added.firstMaterial = static_cast<std::uint32_t>(model.materials.size());
  model.materials.insert(model.materials.end(), places.materials.begin(), places.materials.end());
  added.lastMaterial = static_cast<std::uint32_t>(model.materials.size());
  std::vector<std::uint32_t>& material = model.triangles.material;
  if (places.empty() && material.empty()) return;
  material.resize(added.firstTriangle);
  material.insert(material.end(), places.ofTriangle.begin(), places.ofTriangle.end());
  material.resize(model.triangles.size());
}

void removeMaterials(Model& model, Component& gone) {
  const std::uint32_t first = gone.firstMaterial, last = gone.lastMaterial;
  model.materials.erase(model.materials.begin() + first, model.materials.begin() + last);
  for (Component& c : model.components)
    if (c.firstMaterial >= last) {
      c.firstMaterial -= last - first;
      c.lastMaterial -= last - first;
    }
  gone.firstMaterial = gone.lastMaterial = 0;
  if (model.materials.empty()) model.triangles.material = {};
}

}  // namespace

void checkTriangles(const TriangleMesh& mesh) {
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const auto& [a, b, c] = mesh.triangles[t];
    const double twice = cross(mesh.nodes[b] - mesh.nodes[a], mesh.nodes[c] - mesh.nodes[a]);
    if (!(twice > 0))
      throw InputError(fmt::format(
          "triangle {} of the mesh has the area {:g} m²; it must be positive (counter-clockwise).",
          t, twice / 2));
  }
}

ComponentId appendBody(Model& model, const TriangleMesh& mesh, const Component& component,
                       const MaterialPlaces& materials,
                       std::span<const std::array<double, 3>> stress,
                       std::span<const double> across) {
  checkTriangles(mesh);
  const ComponentId id(model.components.size());
  Nodes& nodes = model.nodes;
  Triangles& triangles = model.triangles;
  const std::size_t firstNode = nodes.size();

  static_assert(kFree == 0);  // as all values of new rows
  resizeRows(nodes.columns(), firstNode + mesh.nodes.size());
  for (std::size_t i = 0; i < mesh.nodes.size(); ++i) {
    nodes.position[firstNode + i] = nodes.reference[firstNode + i] = mesh.nodes[i];
    nodes.component[firstNode + i] = id;
  }

  Component added = component;
  added.firstTriangle = static_cast<std::uint32_t>(triangles.size());
  for (const auto& [a, b, c] : mesh.triangles) {
    triangles.nodes.push_back(
        {NodeId(firstNode + a), NodeId(firstNode + b), NodeId(firstNode + c)});
    appendTriangle(triangles, {mesh.nodes[a], mesh.nodes[b], mesh.nodes[c]});
  }
  added.lastTriangle = static_cast<std::uint32_t>(triangles.size());
  triangles.component.resize(triangles.size(), id);
  if (model.axisymmetric)
    for (const auto& [a, b, c] : mesh.triangles)
      triangles.radius.push_back((mesh.nodes[a].x + mesh.nodes[b].x + mesh.nodes[c].x) / 3);
  appendMaterials(model, materials, added);
  model.components.push_back(added);
  const std::vector<double> thickness = addStress(model, added, stress, across);
  appendPlasticState(model, added);
  std::ranges::copy(thickness, triangles.plastic.thickness.begin() + added.firstTriangle);
  addMasses(model, added);
  return id;
}

std::vector<NodeId> removeBody(Model& model, ComponentId component) {
  removeTriangles(model, model.components[component.value]);
  removeMaterials(model, model.components[component.value]);
  model.components[component.value].plastic = {};
  if (!anyYields(model)) model.triangles.plastic = {};
  if (!anyFails(model)) model.triangles.plastic.damage = model.triangles.plastic.resistance = {};
  model.components[component.value].name.clear();
  std::vector<std::uint8_t> gone(model.components.size());
  gone[component.value] = 1;
  return removeNodes(model, gone);
}

std::vector<NodeId> removeNodes(Model& model, const std::vector<std::uint8_t>& gone) {
  Nodes& nodes = model.nodes;
  std::vector<NodeId> renumbered(nodes.size(), NodeId::none());
  std::size_t kept = 0;
  for (std::size_t n = 0; n < nodes.size(); ++n)
    if (gone[nodes.component[n].value] == 0) renumbered[n] = NodeId(kept++);
  for (auto& corners : model.triangles.nodes)
    for (NodeId& node : corners) node = renumbered[node.value];
  keepRows(nodes.columns(), nodes.size(),
           [&](std::size_t n) { return renumbered[n] != NodeId::none(); });
  return renumbered;
}

void lumpMasses(Model& model) {
  model.nodes.mass.assign(model.nodes.size(), 0);
  for (const Component& c : model.components) addMasses(model, c);
}

}  // namespace yadefrag
