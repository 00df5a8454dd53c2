#pragma once
// Volumes of the triangles at each node, of bodies that yield with averaged volumes; sums of nodes
// in several chunks are added in a fixed order.

#include <vector>

#include "dynamics/element_chunks.hpp"

namespace yadefrag {

class NodeVolumes {
 public:
  void rebuild(const ElementChunks& elements, bool on);
  /// Must be called after a split of nodes.
  void follow(const ElementChunks& elements, std::span<const std::uint32_t> abandoned);
  [[nodiscard]] bool isOn() const { return !value_.empty(); }

  /// Values of a chunk by local number, set to 0; a third of V·J of each triangle is to be added.
  [[nodiscard]] double* begin(const Chunk& chunk);
  /// Afterwards.
  void end(const ElementChunks& elements, const Chunk& chunk);
  /// Then, for each row of `ElementChunks::sharedNodes`.
  void sumShared(const ElementChunks& elements, std::size_t row);
  /// Then replaces a chunk's volumes by U'(J) (Pa); by local number.
  const double* toPressures(const ElementChunks& elements, const Chunk& chunk,
                            const std::vector<double>& mass, double bulk);
  /// The chunk's values by local number.
  [[nodiscard]] const double* of(const Chunk& chunk) const {
    return value_.data() + chunk.firstNode;
  }

 private:
  std::vector<double> value_;            // m³, then Pa; by chunk and local number
  std::vector<double> partial_, whole_;  // m³, by number of the partial sum
};

}  // namespace yadefrag
