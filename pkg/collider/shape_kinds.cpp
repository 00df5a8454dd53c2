#include "collider/shape_kinds.hpp"

#include <algorithm>
#include <array>
#include <string>
#include <string_view>

#include "entries/surface_segment.hpp"

namespace yadefrag {

ShapeKind ShapeKinds::find(const yade::Shape& shape) {
  static constexpr std::array<std::string_view, 10> rigid = {
      "Facet",    "Box",      "Wall",     "Polyhedra",      "Tetra",
      "GridNode", "LevelSet", "Cylinder", "PotentialBlock", "PotentialParticle"};
  const std::string name = shape.getClassName();
  if (name == "Sphere") return ShapeKind::kSphere;
  if (name == SurfaceSegment::kName) return ShapeKind::kSegment;
  const bool isRigid = std::find(rigid.begin(), rigid.end(), name) != rigid.end();
  return isRigid ? ShapeKind::kRigid : ShapeKind::kFollower;
}

}  // namespace yadefrag
