#include "bodies/sphere_overlap.hpp"

#include <algorithm>
#include <cmath>
#include <memory>
#include <vector>

#include "search/contact_search.hpp"
#include "step/overlap_check.hpp"
#include "yade/helpers.hpp"

namespace yadefrag {
namespace {

/// (m) 0 inside; the corners are counter-clockwise.
double distanceTo(const std::array<Vec2, 3>& triangle, Vec2 point) {
  double least = INFINITY;
  bool isInside = true;
  for (int i = 0; i < 3; ++i) {
    const Vec2 start = triangle[i], along = triangle[(i + 1) % 3] - start, arm = point - start;
    isInside = isInside && cross(along, arm) >= 0;
    const double share = std::clamp(dot(arm, along) / dot(along, along), 0., 1.);
    least = std::min(least, norm(arm - share * along));
  }
  return isInside ? 0 : least;
}

/// Those of bodies `first` to the last with a circle in the plane, and the boxes around them.
template <class Visit>
void visitSpheres(const yade::Scene& scene, std::size_t first, yade::mask_t mask, Visit visit) {
  const auto& bodies = scene.bodies->body;
  for (std::size_t id = first; id < bodies.size(); ++id) {
    const yade::Body* body = bodies[id].get();
    const auto* sphere = body ? dynamic_cast<const yade::Sphere*>(body->shape.get()) : nullptr;
    if (!sphere || !body->isBounded() || (body->groupMask & mask) == 0) continue;
    const auto& place = body->state->se3.position;
    if (!(std::abs(place[2]) < sphere->radius)) continue;
    Box box = Box::absent();
    const Vec2 centre = inPlane(place), reach{sphere->radius, sphere->radius};
    include(box, centre - reach), include(box, centre + reach);
    visit(body->id, centre, sphere->radius, box);
  }
}

}  // namespace

std::optional<SphereOverlap> deepestOverlap(const yade::Scene& scene, std::size_t first,
                                            yade::mask_t mask,
                                            std::span<const std::array<Vec2, 3>> triangles,
                                            double tolerated) {
  Box all = Box::absent();
  std::vector<Box> boxes;
  std::unique_ptr<ContactSearch> search;
  std::vector<BoxId> near;
  std::optional<SphereOverlap> deepest;
  for (const auto& triangle : triangles)
    for (const Vec2 corner : triangle) include(all, corner);
  visitSpheres(scene, first, mask,
               [&](yade::Body::id_t id, Vec2 centre, double radius, const Box& around) {
                 if (!overlaps(around, all)) return;
                 if (!search) {
                   boxes.resize(triangles.size(), Box::absent());
                   for (std::size_t i = 0; i < boxes.size(); ++i)
                     for (const Vec2 corner : triangles[i]) include(boxes[i], corner);
                   search = makeSearch(SearchMethod::kLebesgue);
                   search->update(boxes);
                 }
                 near.clear();
                 search->findOverlaps(around, near);
                 for (const BoxId one : near) {
                   const double depth = radius - distanceTo(triangles[one.value], centre);
                   const double most = deepest ? deepest->depth / deepest->radius : tolerated;
                   if (depth > most * radius) deepest = SphereOverlap{id, depth, radius};
                 }
               });
  return deepest;
}

}  // namespace yadefrag
