// World: loads on pieces of the boundary.

#include <algorithm>
#include <utility>

#include "core/errors.hpp"
#include "step/world.hpp"

namespace yadefrag {

/// All segments whose two ends are among the nodes, ascending; InputError if there are none.
std::vector<SegmentId> World::segmentsAmong(std::span<const NodeId> nodes) const {
  requireNodes(nodes);
  std::vector<bool> chosen(model.nodes.size());
  for (const NodeId node : nodes) chosen[node.value] = true;
  std::vector<SegmentId> segments;
  for (std::size_t s = 0; s < surfaces.segments(); ++s)
    if (!surfaces.isGone(SegmentId(s)) && chosen[surfaces.segmentNode[s].value] &&
        chosen[surfaces.segmentNode[surfaces.segmentNext[s].value].value])
      segments.emplace_back(s);
  if (segments.empty())
    throw InputError("No side of the boundary has both its ends among the nodes.");
  return segments;
}

void World::setPressure(std::span<const NodeId> nodes, TimeTable value, std::uint32_t function,
                        bool intoCracks) {
  std::vector<SegmentId> segments = segmentsAmong(nodes);
  if (!value.times().empty() && !TimeTable::isValid(value.times(), value.values()))
    throw InputError("The times of a pressure must ascend, and its values be finite.");
  // The new pressure replaces earlier ones on these segments.
  for (Pressure& other : pressures)
    std::erase_if(other.segments, [&](SegmentId s) { return std::ranges::count(segments, s) > 0; });
  const auto firstNew = static_cast<std::uint32_t>(surfaces.segments());
  pressures.push_back(
      {std::move(segments), std::move(value), function, intoCracks ? firstNew : Pressure::kNever});
  removeUnusedPressures();
}

void World::setAbsorbing(std::span<const NodeId> nodes) {
  std::vector<SegmentId> segments = segmentsAmong(nodes);
  segments.insert(segments.end(), absorbing.segments.begin(), absorbing.segments.end());
  std::ranges::sort(segments);
  segments.erase(std::unique(segments.begin(), segments.end()), segments.end());
  absorbing.segments = std::move(segments);
  absorbing.findTriangles(model, surfaces);
}

/// Removes pressures without segments, or with a constant value of 0.
void World::removeUnusedPressures() {
  std::erase_if(pressures, [](const Pressure& p) {
    return p.segments.empty() || (p.function == 0 && p.value.values() == std::vector<double>{0});
  });
}

/// Must be called before the component is removed from the surfaces: later segments get lower
/// numbers.
void World::removeLoads(const std::vector<std::uint8_t>& gone) {
  std::vector<SegmentId> numbers(surfaces.segments(), SegmentId::none());
  std::size_t kept = 0;
  for (std::size_t s = 0; s < numbers.size(); ++s)
    if (gone[surfaces.component[surfaces.segmentEntry[s].value].value] == 0)
      numbers[s] = SegmentId(kept++);
  const auto renumber = [&](std::vector<SegmentId>& segments) {
    for (SegmentId& segment : segments) segment = numbers[segment.value];
    std::erase(segments, SegmentId::none());
  };
  for (Pressure& pressure : pressures) {
    renumber(pressure.segments);
    if (pressure.firstNew != Pressure::kNever)
      pressure.firstNew -= static_cast<std::uint32_t>(
          std::count(numbers.begin(), numbers.begin() + pressure.firstNew, SegmentId::none()));
  }
  renumber(absorbing.segments);
  removeUnusedPressures();
}

/// Must be called after cracks have opened or lost their cohesion. Faces of cohesive cracks have no
/// pressure.
void World::spreadPressures() {
  const auto spreads = [](const Pressure& p) { return p.firstNew != Pressure::kNever; };
  if (std::ranges::none_of(pressures, spreads)) return;
  std::vector<bool> isHeld(surfaces.segments());
  for (const EdgeId edge : fracture.cohesion.edge)
    for (const int which : {0, 1}) {
      const Side side = fracture.edges.side(edge, which);
      const std::uint32_t first = firstNode(model, side).value;
      if (first >= surfaces.nodeSegment.size()) continue;
      const SegmentId segment = surfaces.nodeSegment[first];
      if (segment == SegmentId::none()) continue;
      const SegmentId next = surfaces.segmentNext[segment.value];
      isHeld[segment.value] = surfaces.segmentNode[next.value] == lastNode(model, side);
    }
  for (Pressure& pressure : pressures) {
    if (!spreads(pressure)) continue;
    spread(pressure, surfaces);
    std::erase_if(pressure.segments, [&](SegmentId segment) {
      return segment.value >= pressure.firstNew && isHeld[segment.value];
    });
  }
}

/// External forces and pressures together.
void World::sumOuterForces() {
  allOuterForces_.clear();
  if (pressures.empty()) return;
  allOuterForces_ = outerForces;
  allOuterForces_.resize(model.nodes.size());
  for (const Pressure& pressure : pressures) {
    double value = pressure.value.at(time);
    if (pressure.function != 0) {
      const auto given =
          std::ranges::find(givenPressures, pressure.function, &GivenPressure::function);
      if (given == givenPressures.end())
        throw RunError(
            "a pressure is a function of the script, which a saved file does not have; call "
            "FESolver.pressure for it again.");
      value = given->value;
    }
    addPressure(model, surfaces, pressure.segments, value, allOuterForces_);
  }
}

void World::absorb(const StepLength& length) {
  if (absorbing.segments.empty()) return;
  absorbing.correct(model, surfaces, dynamics_.previousPosition(), dynamics_.previousVelocity(),
                    length, dynamicsSettings.drag(length));
}

}  // namespace yadefrag
