#include "elements/strain_smoothing.hpp"

#include <algorithm>

namespace yadefrag {

void StrainSmoothing::rebuild(const ElementChunks& elements) {
  const bool on = std::any_of(
      elements.chunks.begin(), elements.chunks.end(),
      [](const Chunk& chunk) { return chunk.element == ElementKind::kSmoothed && !chunk.yields; });
  gradient_.rebuild(elements, on);
  around_.rebuild(elements, on && !elements.hoops.empty());
  distortion_.resize(on ? elements.lanes.size() : 0);
}

bool StrainSmoothing::sum(InstructionSet set, const ElementChunks& elements, const Chunk& chunk,
                          const Vec2* position, std::vector<ElementRange>& stressed) {
  const ElementLanes* lanes = elements.lanes.data();
  const SmoothedNodes nodes{gradient_.begin(chunk),
                            around_.isOn() ? around_.begin(chunk) : nullptr};
  const bool good = sumGradients(set, chunk, lanes, elements.hoopsIfAny(), position,
                                 distortion_.data(), nodes, stressed);
  gradient_.end(elements, chunk);
  if (around_.isOn()) around_.end(elements, chunk);
  return good;
}

void StrainSmoothing::addForces(InstructionSet set, const ElementChunks& elements,
                                const Chunk& chunk, const std::vector<double>& mass, Room& room,
                                Vec2* force) {
  fetchNodes(elements, chunk, mass, room.mass.data());
  const SmoothedNodes nodes{gradient_.whole(elements, chunk),
                            around_.isOn() ? around_.whole(elements, chunk) : nullptr};
  stressNodes(set, chunk, room.mass.data(), {room.similar.data(), room.distorted.data()}, nodes);
  addSmoothedForces(set, chunk, elements.lanes.data(), elements.hoopsIfAny(), distortion_.data(),
                    nodes, force);
}

}  // namespace yadefrag
