#pragma once
// Nodal values of a chunk: copied to its local numbers, and back to the nodes or to partial sums.

#include <vector>

#include "dynamics/element_chunks.hpp"

namespace yadefrag {

template <class T>
void fetchNodes(const ElementChunks& elements, const Chunk& chunk, const std::vector<T>& values,
                T* local) {
  for (std::uint32_t i = chunk.firstNode; i < chunk.lastNode; ++i)
    *local++ = values[elements.nodes[i].value];
}

template <class T>
void handOut(const ElementChunks& elements, const Chunk& chunk, const T* local,
             std::vector<T>& values, std::vector<T>& partial) {
  for (std::uint32_t i = chunk.firstNode; i < chunk.firstShared; ++i)
    values[elements.nodes[i].value] = *local++;
  for (std::uint32_t i = chunk.firstShared; i < chunk.lastNode; ++i)
    partial[elements.partialOf[i]] = *local++;
}

/// Sums the partial values of a shared node in the order of its chunks.
template <class T>
void addUp(const ElementChunks& elements, const std::vector<T>& partial, std::size_t row,
           std::vector<T>& values) {
  T sum{};
  for (std::uint32_t i = elements.firstPartial[row]; i < elements.firstPartial[row + 1]; ++i)
    sum += partial[i];
  values[elements.sharedNodes[row].value] = sum;
}

}  // namespace yadefrag
