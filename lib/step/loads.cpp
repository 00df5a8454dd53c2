#include "step/loads.hpp"

#include <algorithm>
#include <cassert>
#include <utility>

#include "core/arrays.hpp"
#include "core/errors.hpp"

namespace yadefrag {
namespace {

/// All segments whose two ends are among the nodes, ascending; InputError if there are none.
std::vector<SegmentId> segmentsAmong(const ContactSurfaces& surfaces, std::size_t nodeCount,
                                     std::span<const NodeId> nodes) {
  std::vector<bool> chosen(nodeCount);
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

bool spreads(const Pressure& pressure) { return pressure.firstNew != Pressure::kNever; }

}  // namespace

void Loads::setPressure(const Model& model, const ContactSurfaces& surfaces,
                        std::span<const NodeId> nodes, TimeTable value, std::uint32_t function,
                        bool intoCracks) {
  std::vector<SegmentId> segments = segmentsAmong(surfaces, model.nodes.size(), nodes);
  if (!value.times().empty() && !TimeTable::isValid(value.times(), value.values()))
    throw InputError("The times of a pressure must ascend, and its values be finite.");
  // The new pressure replaces earlier ones on these segments.
  for (Pressure& other : pressures)
    std::erase_if(other.segments, [&](SegmentId s) { return std::ranges::count(segments, s) > 0; });
  const auto firstNew = static_cast<std::uint32_t>(surfaces.segments());
  pressures.push_back(
      {std::move(segments), std::move(value), function, intoCracks ? firstNew : Pressure::kNever});
  removeUnused();
}

void Loads::setAbsorbing(const Model& model, const ContactSurfaces& surfaces,
                         std::span<const NodeId> nodes) {
  std::vector<SegmentId> segments = segmentsAmong(surfaces, model.nodes.size(), nodes);
  segments.insert(segments.end(), absorbing.segments.begin(), absorbing.segments.end());
  sortUnique(segments);
  absorbing.segments = std::move(segments);
  absorbing.findTriangles(model, surfaces);
}

/// Removes pressures without segments, or with a constant value of 0.
void Loads::removeUnused() {
  std::erase_if(pressures, [](const Pressure& p) {
    return p.segments.empty() || (p.function == 0 && p.value.values() == std::vector<double>{0});
  });
}

void Loads::renumber(std::span<const SegmentId> numbers) {
  const auto change = [&](std::vector<SegmentId>& segments) {
    for (SegmentId& segment : segments) segment = numbers[segment.value];
    std::erase(segments, SegmentId::none());
  };
  for (Pressure& pressure : pressures) {
    change(pressure.segments);
    if (spreads(pressure))
      pressure.firstNew -= static_cast<std::uint32_t>(
          std::count(numbers.begin(), numbers.begin() + pressure.firstNew, SegmentId::none()));
  }
  change(absorbing.segments);
  removeUnused();
}

void Loads::onDivision(const ContactSurfaces& surfaces, std::span<const SegmentId> parents) {
  const auto count = static_cast<std::uint32_t>(surfaces.segments());
  assert(parents.size() <= count);
  const auto first = static_cast<std::uint32_t>(count - parents.size());
  const auto inherit = [&](std::vector<SegmentId>& segments) {
    const std::vector<SegmentId> former = segments;
    for (std::size_t i = 0; i < parents.size(); ++i)
      if (std::ranges::count(former, parents[i]) > 0) segments.emplace_back(first + i);
  };
  for (Pressure& pressure : pressures) {
    inherit(pressure.segments);
    // The new segments are no faces of cracks.
    if (pressure.firstNew == first) pressure.firstNew = count;
  }
  inherit(absorbing.segments);
  std::ranges::sort(absorbing.segments);
}

void Loads::spread(const Model& model, const ContactSurfaces& surfaces, const Fracture& fracture) {
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
    yadefrag::spread(pressure, surfaces);
    std::erase_if(pressure.segments, [&](SegmentId segment) {
      return segment.value >= pressure.firstNew && isHeld[segment.value];
    });
  }
}

double Loads::valueOf(const Pressure& pressure, double time) const {
  if (pressure.function == 0) return pressure.value.at(time);
  const auto given = std::ranges::find(givenPressures, pressure.function, &GivenPressure::function);
  if (given == givenPressures.end())
    throw RunError(
        "a pressure is a function of the script, which a saved file does not have; call "
        "FESolver.pressure for it again.");
  return given->value;
}

void Loads::sum(const Model& model, const ContactSurfaces& surfaces, double time) {
  sum_.clear();
  if (pressures.empty()) return;
  sum_ = outerForces;
  sum_.resize(model.nodes.size());
  for (const Pressure& pressure : pressures)
    addPressure(model, surfaces, pressure.segments, valueOf(pressure, time), sum_);
}

}  // namespace yadefrag
