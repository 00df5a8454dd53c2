#include "dynamics/node_volumes.hpp"

#include <algorithm>

namespace yadefrag {

void NodeVolumes::rebuild(const ElementChunks& elements, bool on) {
  value_.resize(on ? elements.nodes.size() : 0);
  partial_.assign(on ? elements.partials() : 0, 0);
  whole_.resize(partial_.size());
}

void NodeVolumes::follow(const ElementChunks& elements, std::span<const std::uint32_t> abandoned) {
  if (!isOn()) return;
  value_.resize(elements.nodes.size());
  partial_.resize(elements.partials());
  whole_.resize(elements.partials());
  for (const std::uint32_t i : abandoned) partial_[i] = 0;
}

double* NodeVolumes::begin(const Chunk& chunk) {
  double* nodes = value_.data() + chunk.firstNode;
  std::fill_n(nodes, chunk.lastNode - chunk.firstNode, 0.);
  return nodes;
}

void NodeVolumes::end(const ElementChunks& elements, const Chunk& chunk) {
  for (std::uint32_t i = chunk.firstShared; i < chunk.lastNode; ++i)
    partial_[elements.partialOf[i]] = value_[i];
}

void NodeVolumes::sumShared(const ElementChunks& elements, std::size_t row) {
  const std::uint32_t begin = elements.firstPartial[row], end = elements.firstPartial[row + 1];
  double sum = 0;
  for (std::uint32_t i = begin; i < end; ++i) sum += partial_[i];
  std::fill(whole_.begin() + begin, whole_.begin() + end, sum);
}

const double* NodeVolumes::toPressures(const ElementChunks& elements, const Chunk& chunk,
                                       const std::vector<double>& mass, double bulk) {
  for (std::uint32_t i = chunk.firstShared; i < chunk.lastNode; ++i)
    value_[i] = whole_[elements.partialOf[i]];
  const double halfBulk = bulk / 2;
  for (std::uint32_t i = chunk.firstNode; i < chunk.lastNode; ++i) {
    const double own = mass[elements.nodes[i].value];
    const double ratio = value_[i] * chunk.density / own;
    value_[i] = own > 0 ? halfBulk * (ratio - 1 / ratio) : 0;
  }
  return of(chunk);
}

}  // namespace yadefrag
