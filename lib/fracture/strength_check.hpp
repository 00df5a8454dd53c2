#pragma once
// Which edges reach their strength: the stress at a node is that of the triangles around it, by
// area; at an edge it is the mean of its ends'. Where triangles of several materials meet, only
// those of the edge's own one or two count: beside an interface the stress along it jumps, and only
// the traction on it does not. Where there is a fracture energy, the pull at the tip of a notch or
// a crack counts, too (tip_pull.hpp).

#include <array>
#include <span>
#include <vector>

#include "core/footprint.hpp"
#include "dynamics/element_kernel.hpp"
#include "fracture/crack_edges.hpp"

namespace yadefrag {

class StrengthCheck {
 public:
  /// The edges at these triangles' nodes that crack now, ascending. Where a crack opens at once, of
  /// all edges that meet at a node only the most overstressed one: its opening unloads the others.
  std::vector<EdgeId> overstressed(const Model& model, const CrackEdges& edges,
                                   std::span<const ElementRange> where,
                                   std::span<const double> leastStrength);
  /// Makes room for all that may be looked at.
  void prepare(const Model& model, const CrackEdges& edges);
  void addTo(Footprint& footprint) const {
    footprint.add(Use::kFracture, elementSeen_, nodeSeen_, edgeSeen_, nodeTaken_, nodeLookedAt_,
                  elementStress_, nodeStress_, fan_, around_, found_);
  }

 private:
  using Stress = std::array<double, 3>;
  struct Overstressed {
    double ratio;
    EdgeId edge;
  };

  void lookAtCorners(const Model& model, const CrackEdges& edges, ElementId element,
                     std::span<const double> leastStrength);
  void lookAround(const Model& model, const CrackEdges& edges, NodeId node,
                  std::span<const double> leastStrength);
  const Stress& stressOf(const Model& model, ElementId element);
  const Stress& stressAt(const Model& model, const CrackEdges& edges, NodeId node);
  template <class Counts>
  Stress meanAt(const Model& model, const CrackEdges& edges, NodeId node, Counts counts);
  Stress stressOfMaterials(const Model& model, const CrackEdges& edges, EdgeId edge, NodeId node);
  double ratioOf(const Model& model, const CrackEdges& edges, EdgeId edge);
  double pullAt(const Model& model, const CrackEdges& edges, EdgeId edge, NodeId node, Vec2 normal);
  std::vector<EdgeId> pickApart(const Model& model, const CrackEdges& edges);

  // Looked at in this call if the mark is the call's number.
  std::uint32_t call_ = 0;
  std::vector<std::uint32_t> elementSeen_, nodeSeen_, edgeSeen_, nodeTaken_, nodeLookedAt_;
  std::vector<Stress> elementStress_, nodeStress_;  // Pa: xx, yy, xy
  std::vector<ElementId> fan_, around_;
  std::vector<Overstressed> found_;
};

}  // namespace yadefrag
