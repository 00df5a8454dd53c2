#pragma once
// Small pieces that have come loose from their body.

#include <cstdint>
#include <span>
#include <vector>

#include "fracture/cohesion.hpp"
#include "fracture/crack_edges.hpp"

namespace yadefrag {

class LoosePieces {
 public:
  /// The pieces with a triangle among `around` whose area (m², stress-free) is below `area`. A
  /// piece is loose if it is not its whole body, no crack holds it to another and no node of it is
  /// held. Costs what is around: no more than twice `area` is walked from any triangle.
  void find(const Model& model, const CrackEdges& edges, const Cohesion& cohesion,
            std::span<const ElementId> around, double area);

  void addTo(Footprint& footprint) const {
    footprint.add(Use::kFracture, triangles, met_, holds_, piece_);
  }

  // What was found.
  std::vector<ElementId> triangles;  ///< of each piece ascending, piece by piece
  std::uint64_t count = 0;           ///< pieces

 private:
  bool grow(const Model& model, const CrackEdges& edges, ElementId start, double area);
  [[nodiscard]] bool isLoose(const Model& model, const CrackEdges& edges, double area) const;
  [[nodiscard]] bool isHeldAt(const CrackEdges& edges, Side side) const;

  // By triangle: the last walk that met it; by edge: is there a crack that holds.
  std::vector<std::uint64_t> met_;
  std::vector<std::uint8_t> holds_;
  std::uint64_t walk_ = 0, firstWalk_ = 0;  // of all; of this call
  std::vector<ElementId> piece_;
};

}  // namespace yadefrag
