#pragma once
// Bodies that yield and whose volume strain is averaged at the nodes, where nodes split. The parts
// of a node would have other means than the node, since the volume strains of single triangles
// oscillate, without energy, about those of their nodes: the split would create energy. So the
// stress-free volumes of the triangles around are changed such that each part nearly keeps the mean
// of its node. What cannot be kept, as in a fragment of one triangle, is gained or lost.

#include <span>
#include <vector>

#include "fracture/crack_edges.hpp"
#include "mesh/model.hpp"

namespace yadefrag {

class YieldingSplit {
 public:
  /// Before the split, which will crack these edges.
  YieldingSplit(const Model& model, const CrackEdges& edges, std::span<const EdgeId> cracks,
                double dt);
  /// Afterwards; `originals` as in SplitResult. Returns the energy (J) that these bodies have
  /// gained, at the half step.
  double settle(Model& model, std::span<const NodeId> originals, double dt) const;

 private:
  struct Sum;
  [[nodiscard]] std::vector<Sum> sumsOf(const Model& model, std::span<const NodeId> originals,
                                        const std::vector<double>& ratio) const;

  std::vector<ElementId> around_;  // triangles that may change, ascending
  std::vector<ElementId> wide_;    // all at their nodes: those whose energy may change
  std::vector<NodeId> nodes_;      // of which all triangles are among these, ascending
  std::vector<double> mean_;       // of these nodes, J
  double before_ = 0;              // J
};

}  // namespace yadefrag
