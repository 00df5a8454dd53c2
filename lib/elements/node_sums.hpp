#pragma once
// Nodal values of a chunk: copied to its local numbers and back, and sums over
// its elements. Sums of nodes in several chunks are added in a fixed order.

#include <algorithm>
#include <span>
#include <vector>

#include "elements/element_chunks.hpp"

namespace yadefrag {

template <class T>
void fetchNodes(const ElementChunks& elements, const Chunk& chunk, const std::vector<T>& values,
                T* local) {
  for (std::uint32_t i = chunk.firstNode; i < chunk.lastNode; ++i)
    *local++ = values[elements.nodes[i].value];
}

/// To the nodes, or to partial sums.
template <class T>
void scatter(const ElementChunks& elements, const Chunk& chunk, const T* local,
             std::vector<T>& values, std::vector<T>& partial) {
  for (std::uint32_t i = chunk.firstNode; i < chunk.firstShared; ++i)
    values[elements.nodes[i].value] = *local++;
  for (std::uint32_t i = chunk.firstShared; i < chunk.lastNode; ++i)
    partial[elements.partialOf[i]] = *local++;
}

/// Sums the partial values of a shared node in the order of its chunks.
template <class T>
T reduce(const ElementChunks& elements, const std::vector<T>& partial, std::size_t row) {
  T sum{};
  for (std::uint32_t i = elements.firstPartial[row]; i < elements.firstPartial[row + 1]; ++i)
    sum += partial[i];
  return sum;
}

/// Sums by chunk and local number.
template <class T>
class NodeSums {
 public:
  void rebuild(const ElementChunks& elements, bool on) {
    value_.resize(on ? elements.nodes.size() : 0);
    partial_.assign(on ? elements.partials() : 0, {});
    whole_.resize(partial_.size());
  }
  /// Must be called after a split of nodes. Partial sums that are no longer written must be zero.
  void follow(const ElementChunks& elements, std::span<const std::uint32_t> abandoned) {
    if (!isOn()) return;
    value_.resize(elements.nodes.size());
    partial_.resize(elements.partials());
    whole_.resize(elements.partials());
    for (const std::uint32_t i : abandoned) partial_[i] = {};
  }
  [[nodiscard]] bool isOn() const { return !value_.empty(); }

  /// A chunk's sums, set to 0; its elements are to be added.
  [[nodiscard]] T* begin(const Chunk& chunk) {
    std::fill_n(of(chunk), chunk.lastNode - chunk.firstNode, T{});
    return of(chunk);
  }
  /// After the chunk's elements are added: keeps its part of shared nodes' sums.
  void end(const ElementChunks& elements, const Chunk& chunk) {
    for (std::uint32_t i = chunk.firstShared; i < chunk.lastNode; ++i)
      partial_[elements.partialOf[i]] = value_[i];
  }
  /// After `end` of all chunks, for each row of `ElementChunks::sharedNodes`: its node's whole sum.
  void sumShared(const ElementChunks& elements, std::size_t row) {
    std::fill(whole_.begin() + elements.firstPartial[row],
              whole_.begin() + elements.firstPartial[row + 1], reduce(elements, partial_, row));
  }
  /// After `sumShared` of all rows: the chunk's whole sums.
  [[nodiscard]] T* whole(const ElementChunks& elements, const Chunk& chunk) {
    for (std::uint32_t i = chunk.firstShared; i < chunk.lastNode; ++i)
      value_[i] = whole_[elements.partialOf[i]];
    return of(chunk);
  }
  [[nodiscard]] T* of(const Chunk& chunk) { return value_.data() + chunk.firstNode; }

 private:
  std::vector<T> value_;            // by chunk and local number
  std::vector<T> partial_, whole_;  // by number of the partial sum
};

}  // namespace yadefrag
