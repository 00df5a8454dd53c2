#include "entries/surface_segment.hpp"

#include <algorithm>
#include "core/errors.hpp"

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

void SurfaceSegment::archiveMore(AnyArchive& archive) {
  std::vector<int> spheres;
  std::vector<double> values;
  for (const Changed& one : changed) {
    spheres.push_back(one.sphere);
    values.insert(values.end(), {one.share, one.tolerated});
  }
  archive.item("changedIds", spheres);
  archive.item("changedContacts", values);
  if (archive.isLoading()) {
    if (values.size() != 2 * spheres.size())
      throw InputError(
          "The saved state of a SurfaceSegment is damaged (its contacts with spheres are invalid); "
          "load another save.");
    changed.clear();
    for (std::size_t i = 0; i < spheres.size(); ++i)
      changed.push_back({spheres[i], values[2 * i], values[2 * i + 1]});
  }
}

Attributes SurfaceSegment::attributes() {
  using C = SurfaceSegment;
  return attributeList(
      attribute("start", &C::start, "Begin of the piece (m)."),
      attribute("end", &C::end, "End of the piece (m)."),
      attribute("middle", &C::middle,
                "Of an arc: its central node (m), at which the tangents of its two ends "
                "meet."),
      attribute("before", &C::before,
                "Direction (unit vector) of the previous piece at `start`; zero: "
                "there is none, `start` is a free end."),
      attribute("after", &C::after,
                "Direction (unit vector) of the next piece at `end`; zero: "
                "there is none."),
      attribute("kind", &C::kind,
                "0: a segment between two nodes, 1 and 2: its first and second half, 3: an arc "
                "around a node."),
      attribute(
          "halo", &C::halo,
          "Length (m) by which the bound is larger than the piece, on every side: the distance "
          "that the piece may move before the next search."),
      attribute("entry", &C::entry, "Number of the surface entry in its FESolver; -1: none."),
      attribute("component", &C::component, "Number of the finite-element body; -1: none."),
      attribute("selfContact", &C::selfContact,
                "True if this piece may touch other pieces of its own body."));
}

}  // namespace yadefrag
