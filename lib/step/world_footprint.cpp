// World: memory by use of the arrays. It shows that unused features have no arrays.

#include "step/world.hpp"

namespace yadefrag {

Footprint World::footprint() const {
  Footprint sum;
  const Nodes& nodes = model.nodes;
  const Triangles& triangles = model.triangles;
  sum.add(Use::kMesh, nodes.position, nodes.velocity, nodes.mass, nodes.held, nodes.component,
          triangles.nodes, triangles.inverseEdges, triangles.area, triangles.component,
          model.components, reference);
  sum.add(Use::kMaterials, triangles.material, model.materials);
  sum.add(Use::kLoads, nodes.load, outerForces, allOuterForces_, pressures, absorbing.segments);
  sum.add(Use::kHeld, nodes.motion, nodes.arm, model.motions, givenVelocities, undo_.driven,
          reactions);
  const ContactSurfaces& s = surfaces;
  sum.add(Use::kSurfaces, s.segmentNode, s.segmentNext, s.segmentPrev, s.segmentEntry,
          s.nodeSegment, s.entrySegment, s.piece, s.next, s.prev, s.loop, s.component);
  sum.add(Use::kSmooth, s.segmentSmooth);
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
