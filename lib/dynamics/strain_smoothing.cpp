#include "dynamics/strain_smoothing.hpp"

#include <algorithm>
#include <cmath>

#include "dynamics/chunk_nodes.hpp"

namespace yadefrag {

void StrainSmoothing::rebuild(const ElementChunks& elements) {
  const bool on = std::any_of(
      elements.chunks.begin(), elements.chunks.end(),
      [](const Chunk& chunk) { return chunk.element == ElementKind::kSmoothed && !chunk.yields; });
  gradient_.resize(on ? elements.nodes.size() : 0);
  partialGradient_.assign(on ? elements.partials() : 0, {});
  wholeGradient_.resize(partialGradient_.size());
  distortion_.resize(on ? elements.lanes.size() : 0);
}

/// Partial sums that are no longer written must be zero.
void StrainSmoothing::follow(const ElementChunks& elements,
                             std::span<const std::uint32_t> abandoned) {
  if (!isOn()) return;
  gradient_.resize(elements.nodes.size());
  partialGradient_.resize(elements.partials());
  wholeGradient_.resize(elements.partials());
  for (const std::uint32_t i : abandoned) partialGradient_[i] = {};
}

bool StrainSmoothing::sum(InstructionSet set, const ElementChunks& elements, const Chunk& chunk,
                          const Vec2* position, std::vector<ElementRange>& stressed) {
  SplitGradient* nodes = gradient_.data() + chunk.firstNode;
  std::fill_n(nodes, chunk.lastNode - chunk.firstNode, SplitGradient{});
  const ElementLanes* lanes = elements.lanes.data();
  const bool good =
      std::isfinite(chunk.squaredStressLimit)
          ? sumGradients(set, chunk, lanes, position, distortion_.data(), nodes, stressed)
          : sumGradients(set, chunk, lanes, position, distortion_.data(), nodes);
  for (std::uint32_t i = chunk.firstShared; i < chunk.lastNode; ++i)
    partialGradient_[elements.partialOf[i]] = gradient_[i];
  return good;
}

/// Each chunk of the node gets the whole sum.
void StrainSmoothing::sumShared(const ElementChunks& elements, std::size_t row) {
  const std::uint32_t begin = elements.firstPartial[row];
  const std::uint32_t end = elements.firstPartial[row + 1];
  SplitGradient sum;
  for (std::uint32_t i = begin; i < end; ++i) sum += partialGradient_[i];
  std::fill(wholeGradient_.begin() + begin, wholeGradient_.begin() + end, sum);
}

void StrainSmoothing::addForces(InstructionSet set, const ElementChunks& elements,
                                const Chunk& chunk, const std::vector<double>& mass, Room& room,
                                Vec2* force) {
  for (std::uint32_t i = chunk.firstShared; i < chunk.lastNode; ++i)
    gradient_[i] = wholeGradient_[elements.partialOf[i]];
  fetchNodes(elements, chunk, mass, room.mass.data());
  SplitGradient* nodes = gradient_.data() + chunk.firstNode;
  stressNodes(set, chunk, room.mass.data(), {room.similar.data(), room.distorted.data()}, nodes);
  addSmoothedForces(set, chunk, elements.lanes.data(), distortion_.data(), nodes, force);
}

}  // namespace yadefrag
