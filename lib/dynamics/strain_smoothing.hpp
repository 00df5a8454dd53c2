#pragma once
// Smoothed strains in a step: between the two passes over the chunks the sums of nodes in several
// chunks are added, in a fixed order. No cost if no body has smoothed strains.

#include <span>
#include <vector>

#include "dynamics/node_sums.hpp"
#include "dynamics/smoothed_kernel.hpp"

namespace yadefrag {

class StrainSmoothing {
 public:
  /// Memory of one thread.
  struct Room {
    std::vector<double> mass, similar, distorted;
    void resize(std::size_t count) {
      mass.resize(count), similar.resize(count), distorted.resize(count);
    }
  };

  void rebuild(const ElementChunks& elements);
  /// Must be called after a split of nodes.
  void follow(const ElementChunks& elements, std::span<const std::uint32_t> abandoned) {
    gradient_.follow(elements, abandoned);
  }
  [[nodiscard]] bool isOn() const { return !distortion_.empty(); }

  /// First pass, for one chunk; positions by local number. Returns false if an element is flat,
  /// inverted or not finite.
  bool sum(InstructionSet set, const ElementChunks& elements, const Chunk& chunk,
           const Vec2* position, std::vector<ElementRange>& stressed);
  /// Then the sums of nodes in several chunks.
  void sumShared(const ElementChunks& elements, std::size_t row) {
    gradient_.sumShared(elements, row);
  }
  /// Second pass, for one chunk; `mass` (kg) by node.
  void addForces(InstructionSet set, const ElementChunks& elements, const Chunk& chunk,
                 const std::vector<double>& mass, Room& room, Vec2* force);

 private:
  NodeSums<SplitGradient> gradient_;  // with a third of the volumes (m³), then stresses (Pa)
  std::vector<DistortionLanes> distortion_;
};

}  // namespace yadefrag
