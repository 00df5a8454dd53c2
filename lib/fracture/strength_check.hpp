#pragma once
// Finds the edges that reach their strength. The stress at a node is the mean over its triangles,
// weighted by area; at an edge it is the mean of its ends. Where triangles of several materials
// meet, only those of the edge's own one or two materials are used: along an interface the stress
// component parallel to it jumps, only the traction on it is continuous. With a fracture energy,
// the traction at the tip of a notch or a crack is used as well (tip_pull.hpp).

#include <array>
#include <span>
#include <vector>

#include "core/footprint.hpp"
#include "dynamics/element_kernel.hpp"
#include "fracture/crack_edges.hpp"

namespace yadefrag {

class StrengthCheck {
 public:
  /// The edges at these triangles' nodes that crack now, ascending. If cracks open at once (no
  /// fracture energy), only the most overstressed of all edges that meet at a node cracks: its
  /// opening unloads the others.
  std::vector<EdgeId> overstressed(const Model& model, const CrackEdges& edges,
                                   std::span<const ElementRange> where,
                                   std::span<const double> leastStrength);
  /// Reserves memory for all that may be checked.
  void prepare(const Model& model, const CrackEdges& edges);
  void addTo(Footprint& footprint) const {
    footprint.add(Use::kFracture, elementSeen_, nodeSeen_, edgeSeen_, nodeTaken_, nodeTested_,
                  elementStress_, nodeStress_, isInside_, fan_, around_, found_);
  }

 private:
  using Stress = std::array<double, 3>;
  struct Overstressed {
    double ratio;
    EdgeId edge;
  };

  void checkCorners(const Model& model, const CrackEdges& edges, ElementId element,
                    std::span<const double> leastStrength);
  void checkNode(const Model& model, const CrackEdges& edges, NodeId node,
                 std::span<const double> leastStrength);
  const Stress& stressOf(const Model& model, ElementId element);
  const Stress& stressAt(const Model& model, const CrackEdges& edges, NodeId node);
  template <class Counts>
  Stress meanAt(const Model& model, const CrackEdges& edges, NodeId node, Counts counts);
  Stress stressOfMaterials(const Model& model, const CrackEdges& edges, EdgeId edge, NodeId node);
  double ratioOf(const Model& model, const CrackEdges& edges, EdgeId edge);
  double pullAt(const Model& model, const CrackEdges& edges, EdgeId edge, NodeId node, Vec2 normal);
  std::vector<EdgeId> pickApart(const Model& model, const CrackEdges& edges);

  // Checked in this call if the mark is the call's number.
  std::uint32_t call_ = 0;
  std::vector<std::uint32_t> elementSeen_, nodeSeen_, edgeSeen_, nodeTaken_, nodeTested_;
  std::vector<Stress> elementStress_, nodeStress_;  // Pa: xx, yy, xy
  std::vector<std::uint8_t> isInside_;  // by node whose mean is known: 1 if its fan is a ring
  std::vector<ElementId> fan_, around_;
  std::vector<Overstressed> found_;
};

}  // namespace yadefrag
