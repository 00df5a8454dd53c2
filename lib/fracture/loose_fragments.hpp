#pragma once
// Small fragments that are detached from their body.

#include <cstdint>
#include <span>
#include <vector>

#include "fracture/cohesion.hpp"
#include "fracture/crack_edges.hpp"

namespace yadefrag {

class LooseFragments {
 public:
  /// Finds the fragments with a triangle among `around` whose area (m², stress-free) is below
  /// `area`. A fragment is detached if it is not its whole body, no cohesive crack connects it to
  /// another fragment, and none of its nodes is held. The cost depends on `around` only: from each
  /// triangle at most twice `area` is visited.
  void find(const Model& model, const CrackEdges& edges, const Cohesion& cohesion,
            std::span<const ElementId> around, double area);

  // Results.
  std::vector<ElementId> triangles;  ///< of each fragment, ascending, one after the other
  std::uint64_t count = 0;           ///< number of fragments

 private:
  bool grow(const Model& model, const CrackEdges& edges, ElementId start, double area);
  [[nodiscard]] bool isLoose(const Model& model, const CrackEdges& edges, double area) const;
  [[nodiscard]] bool isHeldAt(const CrackEdges& edges, Side side) const;

  // By triangle: the last walk that visited it; by edge: true for a cohesive crack.
  std::vector<std::uint64_t> met_;
  std::vector<std::uint8_t> holds_;
  std::uint64_t walk_ = 0, firstWalk_ = 0;  // numbers of the last walk, of this call's first
  std::vector<ElementId> fragment_;
};

}  // namespace yadefrag
