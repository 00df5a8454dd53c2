#pragma once
// Smoothed strains in a step: between the two passes over the chunks, nodes of several chunks get
// their sums, in a fixed order. Costs nothing where no body has them.

#include <span>
#include <vector>

#include "core/footprint.hpp"
#include "dynamics/smoothed_kernel.hpp"

namespace yadefrag {

class StrainSmoothing {
 public:
  /// Of one thread.
  struct Room {
    std::vector<double> mass, similar, distorted;
    void resize(std::size_t count) {
      mass.resize(count), similar.resize(count), distorted.resize(count);
    }
  };

  void rebuild(const ElementChunks& elements);
  /// After nodes split.
  void follow(const ElementChunks& elements, std::span<const std::uint32_t> abandoned);
  [[nodiscard]] bool isOn() const { return !distortion_.empty(); }

  /// First pass, of one chunk; positions by local number. False if an element is bad.
  bool sum(InstructionSet set, const ElementChunks& elements, const Chunk& chunk,
           const Vec2* position, std::vector<ElementRange>& stressed);
  /// Then nodes of several chunks.
  void sumShared(const ElementChunks& elements, std::size_t row);
  /// Second pass, of one chunk; `mass` (kg) by node.
  void addForces(InstructionSet set, const ElementChunks& elements, const Chunk& chunk,
                 const std::vector<double>& mass, Room& room, Vec2* force);

  void addTo(Footprint& footprint) const {
    footprint.add(Use::kSmoothing, gradient_, partialGradient_, wholeGradient_, distortion_);
  }

 private:
  // Sums by thirds of volumes (m³), by chunk and local number; later stresses (Pa).
  std::vector<SplitGradient> gradient_;
  // Of nodes in several chunks: a chunk's part, and the whole, both by number of the partial sum.
  std::vector<SplitGradient> partialGradient_, wholeGradient_;
  std::vector<DistortionLanes> distortion_;
};

}  // namespace yadefrag
