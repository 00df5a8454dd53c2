// World: memory by use of the arrays. It shows that unused features have no arrays.

#include "step/world.hpp"

namespace yadefrag {

Footprint World::footprint() const {
  Footprint sum;
  addTo(sum, model.nodes.columns());
  addTo(sum, model.triangles.columns());
  addTo(sum, surfaces.segmentColumns());
  addTo(sum, surfaces.entryColumns());
  sum.add(Use::kMesh, model.components);
  sum.add(Use::kMaterials, model.materials);
  sum.add(Use::kHeld, model.motions, givenVelocities, undo_.driven, reactions);
  sum.add(Use::kSurfaces, surfaces.nodeSegment);
  loads.addTo(sum);
  search.addTo(sum);
  sum.add(Use::kFracture, split_.changed, split_.originals, split_.sides, split_.onSurface);
  sum.add(Use::kCohesion, surfaceForces_);
  dynamics_.addTo(sum);
  contact.addTo(sum);
  fracture.addTo(sum);
  loose_.addTo(sum);
  return sum;
}

}  // namespace yadefrag
