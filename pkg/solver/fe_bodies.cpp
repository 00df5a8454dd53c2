// Bodies of FESolver that a script adds, bonds and removes.

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <span>
#include <utility>

#include "bodies/sphere_overlap.hpp"
#include "core/errors.hpp"
#include "core/tolerances/spheres.hpp"
#include "elements/element_state.hpp"
#include "fracture/brittle_checks.hpp"
#include "solver/fe_solver.hpp"

namespace yadefrag {

/// Bodies of two solvers would have no contact with each other.
void FESolver::requireAlone(const yade::Scene& here) const {
  const auto& present = here.bodies->body;
  for (std::size_t id = 0; id < present.size(); ++id) {
    if (bodies_.entryOf(static_cast<yade::Body::id_t>(id)) != EntryId::none() || !present[id])
      continue;
    const auto* segment = dynamic_cast<const SurfaceSegment*>(present[id]->shape.get());
    if (segment && segment->entry >= 0)
      throw InputError(
          "The scene has bodies of another FESolver; add this one to that solver, or they would "
          "not touch each other.");
  }
}

namespace {

/// BrittleFEMat.coarseMesh of each material.
std::vector<CoarseMesh> choicesOf(const std::vector<yade::shared_ptr<FEMat>>& materials) {
  std::vector<CoarseMesh> choices;
  for (const auto& one : materials) {
    const auto* brittle = dynamic_cast<const BrittleFEMat*>(one.get());
    choices.push_back(brittle ? coarseMeshNamed(brittle->coarseMesh) : CoarseMesh::kWarn);
  }
  return choices;
}

/// Changes `spec.places`. Returns a sentence on that, or an empty one.
std::string fitToCoarseMesh(const TriangleMesh& mesh, BodySpec& spec,
                            std::span<const CoarseMesh> choices) {
  const BodyMaterial& one = spec;
  const std::span<const BodyMaterial> all =
      spec.materials.empty() ? std::span(&one, 1) : std::span(spec.materials.materials);
  const FittedValues fitted =
      fitToMesh(mesh, {all, choices, spec.materials.ofTriangle}, spec.places);
  if (fitted.triangles == 0) return {};
  std::string changed;
  if (fitted.leastStrength < 1)
    changed = fmt::format("the strength is reduced, to {:.3g} of it", fitted.leastStrength);
  if (fitted.mostEnergy > 1)
    changed += fmt::format("{}the fracture energy is raised, to {:.3g} times it",
                           changed.empty() ? "" : ", ", fitted.mostEnergy);
  return fmt::format(
      "{} of {} triangles do not resolve the cohesive zone: {} for the largest (coarseMesh).",
      fitted.triangles, mesh.triangles.size(), changed);
}

/// Throws InputError if the new body is where a sphere is.
void requireApartFromSpheres(const yade::Scene& scene, const TriangleMesh& mesh,
                             const BodySpec& spec) {
  std::vector<std::array<Vec2, 3>> triangles;
  const auto at = [&](std::uint32_t node) {
    return spec.displacement.empty() ? mesh.nodes[node]
                                     : mesh.nodes[node] + spec.displacement[node];
  };
  if (!spec.displacement.empty() && spec.displacement.size() != mesh.nodes.size()) return;
  for (const auto& [a, b, c] : mesh.triangles) triangles.push_back({at(a), at(b), at(c)});
  const auto found = deepestOverlap(scene, 0, 1, triangles, tolerance::kPlacedOverlap);
  if (found)
    throw InputError(
        fmt::format("The new body overlaps sphere #{} by {:.3g} m, {:.3g} of its radius; it may "
                    "touch others at the start, but not overlap them.",
                    found->sphere, found->depth, found->depth / found->radius));
}

/// If the initial stress of a body is outside of its yield surface.
std::string startWarning(const Model& model, ComponentId component) {
  const Component& body = model.components[component.value];
  const std::size_t count = body.yields() ? countYielding(model, component) : 0;
  if (count == 0) return {};
  return fmt::format(
      "The initial stress is outside of the yield surface in {} of {} triangles, which flow in the "
      "first step: take a lower stress, or in plane strain another one across the plane (the "
      "fourth number).",
      count, body.lastTriangle - body.firstTriangle);
}

}  // namespace

AddedBody FESolver::addBody(const TriangleMesh& mesh, BodySpec spec,
                            const std::vector<yade::shared_ptr<FEMat>>& materials) {
  yade::Scene& here = *yade::Omega::instance().getScene();
  if (here.isPeriodic) throw InputError("The scene is periodic, but FE bodies cannot be.");
  bodies_.requireAll(here);
  requireAlone(here);
  if (spec.materials.ofTriangle.empty())
    static_cast<BodyMaterial&>(spec) = bodyMaterialOf(*materials.front());
  else
    for (const auto& one : materials) spec.materials.materials.push_back(bodyMaterialOf(*one));
  if (!spec.selfContact && wholeOf(spec).brittle.cracks())
    throw InputError(
        "selfContact is False, but the body has joints, or a material that cracks or fails, and "
        "its fragments must touch each other; it must be True.");
  const std::vector<CoarseMesh> choices = choicesOf(materials);
  requireApartFromSpheres(here, mesh, spec);
  std::string message = fitToCoarseMesh(mesh, spec, choices);
  const ComponentId component = world_.addBody(mesh, spec);
  if (message.empty() && std::ranges::find(choices, CoarseMesh::kWarn) != choices.end())
    message = cohesiveZoneWarning(world_.model, world_.fracture.edges, component);
  if (!spec.stress.empty()) {
    const std::string yields = startWarning(world_.model, component);
    if (!yields.empty()) message += (message.empty() ? "" : " ") + yields;
  }
  scene = &here;
  bodies_.add(here, world_, materials);
  for (const auto& one : materials) materials_.add(one);
  return {static_cast<int>(component.value), std::move(message)};
}

/// Nodes have moved, or sides were divided.
void FESolver::followBonds() {
  yade::Scene& here = *yade::Omega::instance().getScene();
  bodies_.follow(here, world_);
  bodies_.update(world_, {}, 1);
  here.doSort = true;
}

void FESolver::removeBody(int component) {
  yade::Scene& here = *yade::Omega::instance().getScene();
  bodies_.requireAll(here);
  const auto& components = world_.model.components;
  const auto index = static_cast<std::size_t>(component);
  if (component < 0 || index >= components.size() ||
      components[index].firstTriangle == components[index].lastTriangle)
    throw InputError(fmt::format("component is {}, which is no body of this FESolver.", component));
  balance_.forget(world_, ComponentId(index));
  loadedForces_.clear();
  bodies_.remove(here, world_, ComponentId(index));
  world_.removeBody(ComponentId(index));
}

double FESolver::criticalTimeStep() {
  giveSettings();
  return world_.criticalTimeStep();
}

}  // namespace yadefrag
