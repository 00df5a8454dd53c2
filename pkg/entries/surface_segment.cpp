#include "entries/surface_segment.hpp"

#include <algorithm>

namespace yadefrag {

SurfaceSegment::Changed* SurfaceSegment::changedBy(yade::Body::id_t sphere) {
  const auto found = std::ranges::find(changed, sphere, &Changed::sphere);
  return found == changed.end() ? nullptr : &*found;
}

void SurfaceSegment::setChanged(const Changed& one) {
  std::erase_if(changed, [&](const Changed& other) { return other.sphere == one.sphere; });
  if (one.share != 1 || one.tolerated != 0) changed.push_back(one);
}

double SurfaceSegment::depthForLaw(yade::Body::id_t sphere, double depth) {
  if (changed.empty()) return depth;
  Changed* const one = changedBy(sphere);
  if (!one) return depth;
  one->tolerated = std::min(one->tolerated, depth);
  return one->share * (depth - one->tolerated);
}

}  // namespace yadefrag
