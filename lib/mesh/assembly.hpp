#pragma once
// Adds bodies to the model and removes them; its arrays have no gaps.

#include <array>
#include <optional>
#include <span>
#include <vector>

#include "mesh/body_material.hpp"
#include "mesh/model.hpp"
#include "mesh/triangle_mesh.hpp"

namespace yadefrag {

/// Throws InputError if a triangle has no positive area.
void checkTriangles(const TriangleMesh& mesh);

/// Adds a mesh as a new component: at rest, free, and without stress in its present shape. The
/// function fills in the ranges of triangles and materials of `component`. Throws as
/// checkTriangles. `stress`: initial stress of each triangle in the present shape, Pa (xx, yy, xy);
/// empty: none; `across`: that across the plane, empty or NaN: not given. The stretch of each
/// stress must exist (see stretchOf).
ComponentId appendBody(Model& model, const TriangleMesh& mesh, const Component& component,
                       const MaterialPlaces& materials = {},
                       std::span<const std::array<double, 3>> stress = {},
                       std::span<const double> across = {});

/// Removes a component's nodes, triangles and materials. The other nodes keep their order, and
/// components keep their ids. Returns the new number of each old node, none() for removed nodes.
std::vector<NodeId> removeBody(Model& model, ComponentId component);

/// Removes only the nodes of all components with a mark in `gone` (by component).
std::vector<NodeId> removeNodes(Model& model, const std::vector<std::uint8_t>& gone);

/// Sets the mass of every node: a third of ρ·area·thickness of each of its triangles.
void lumpMasses(Model& model);

// --- Initial stress: the stress-free shape of triangles that are stressed in their present shape.

/// The symmetric stretch (xx, yy, xy) that causes a Cauchy stress (Pa; xx, yy, xy, tension
/// positive) by the material law of elements/elastic_law.hpp; no value if a principal stretch
/// exceeds tolerance::kMostStretch.
[[nodiscard]] std::optional<std::array<double, 3>> stretchOf(const ElasticMaterial& material,
                                                             const std::array<double, 3>& stress);

/// Stretches in the plane and across it.
struct SpatialStretch {
  std::array<double, 3> plane;
  double across;
};
/// The stretches that cause a Cauchy stress in the plane and one across it (Pa), by the law of
/// materials that yield (elements/yield_law.hpp).
[[nodiscard]] std::optional<SpatialStretch> stretchOf(const ElasticMaterial& material,
                                                      const std::array<double, 3>& stress,
                                                      double across);
/// The same by the law of elements/elastic_law.hpp, with the stress around the axis (Pa).
[[nodiscard]] std::optional<SpatialStretch> stretchAround(const ElasticMaterial& material,
                                                          const std::array<double, 3>& stress,
                                                          double around);

/// Changes a triangle without stress so that its present shape is stretched by this much: its
/// stress-free edges and area become those before the stretch.
void stretch(Triangles& triangles, ElementId element, const std::array<double, 3>& stretch);

}  // namespace yadefrag
