#pragma once
// Finds the edges that reach their strength. The stress at a node is the mean over its triangles,
// weighted by area; at an edge it is the mean of its ends. Where triangles of several materials
// meet, only those of the edge's own one or two materials are used: along an interface the stress
// component parallel to it jumps, only the traction on it is continuous. With a fracture energy,
// the traction at the tip of a notch or a crack is used as well (separation.hpp).
//
// With a rate effect an edge is overloaded from the strength of slow tests on, and cracks when its
// traction reaches that strength times the factor of the strain rate. The rate is the mean one of
// the overload: the traction in excess of the strength, over the modulus and the time that it has
// lasted. The rate of one step does not do: at the peak of a pulse it is 0, so that any pulse above
// the strength of slow tests would break the material, and vibrations of the mesh are faster than
// the load.

#include <array>
#include <span>
#include <vector>

#include "core/parallel.hpp"
#include "elements/element_kernel.hpp"
#include "elements/element_state.hpp"
#include "fracture/crack_edges.hpp"
#include "fracture/separation.hpp"

namespace yadefrag {

/// An edge whose traction exceeds its strength in slow tests.
struct Overload {
  EdgeId edge;
  double since;  ///< s, time
};

/// End and length of a step (s).
struct StepTime {
  double end, length;
};

class StrengthCheck {
 public:
  /// The edges at these triangles' nodes that crack now, ascending. If cracks open at once (no
  /// fracture energy), only the most overstressed of all edges that meet at a node cracks: its
  /// opening unloads the others. `overloads`: of materials with a rate effect, by edge, ascending;
  /// those after the last step become those after this one. The same for any number of threads.
  std::vector<EdgeId> overstressed(const Model& model, const CrackEdges& edges,
                                   std::span<const ElementRange> where, const StepTime& step,
                                   std::vector<Overload>& overloads, int threads);
  /// Multiplies strength and energy of the given edges, found by the last call of `overstressed`,
  /// by the factors of their strain rates. Returns true if any changed.
  bool raise(const Model& model, CrackEdges& edges, std::span<const EdgeId> cracks) const;
  /// Edges of triangles whose material has failed get as their strength the largest traction that
  /// acts on one of the triangle's edges: this one then cracks, and softens from there. Triangles
  /// under too much pressure wait. Returns these edges, ascending; lowers `leastStrength`.
  std::vector<EdgeId> weaken(const Model& model, CrackEdges& edges,
                             std::span<const ElementRange> where, const StepTime& step,
                             std::vector<double>& leastStrength);
  /// After bodies were added or removed.
  void prepare(const Model& model, const CrackEdges& edges);
  /// After these edges have cracked. `originals` as in SplitResult.
  void follow(const Model& model, const CrackEdges& edges, std::span<const EdgeId> cracks,
              std::span<const NodeId> originals);

 private:
  using Stress = std::array<double, 3>;
  struct Overstressed {
    double ratio;
    EdgeId edge;
    double factor;  // of the strength, by the strain rate
  };

  struct Weakened {
    EdgeId edge;
    double strength;  // Pa
  };

  /// Constants of a body.
  struct Law {
    Moduli moduli;
    TractionBound bound;
    bool isElastic;  // all of it, of one material
    bool mayHold;    // tips of cracks count, which hold below the strength
    bool isMixed;
  };
  /// The triangles around a node.
  struct Fan {
    std::uint32_t begin = kUnknown;  // in `fans_`
    std::uint32_t count = 0;
    std::uint32_t tested = 0;  // the call in which `isTip` was found
    bool isRing = false, isTip = false;
  };
  static constexpr std::uint32_t kUnknown = 0xffffffff;

  void resize(const Model& model, const CrackEdges& edges);
  void update(const Model& model, const CrackEdges& edges, NodeId node);
  bool isTipAt(const Model& model, const CrackEdges& edges, NodeId node);
  Fan& fanAt(const Model& model, const CrackEdges& edges, NodeId node);
  [[nodiscard]] std::span<const ElementId> elementsOf(const Fan& fan) const {
    return std::span(fans_).subspan(fan.begin, fan.count);
  }
  void listNodes(const Model& model, std::span<const ElementRange> where, int threads);
  void listCorners(const Model& model, ElementId element, std::vector<NodeId>& list);
  void computeStresses(const Model& model, const CrackEdges& edges, int threads);
  void listWeak(const Model& model, const CrackEdges& edges, int threads);
  bool mayCrackAt(const Model& model, const CrackEdges& edges, NodeId node);
  void checkEdges(const Model& model, const CrackEdges& edges, NodeId node);
  [[nodiscard]] Stress computeStress(const Model& model, ElementId element) const;
  const Stress& stressOf(const Model& model, ElementId element);
  const Stress& stressAt(const Model& model, const CrackEdges& edges, NodeId node);
  template <class Counts, class Of>
  std::array<double, 3> meanAt(const Model& model, const CrackEdges& edges, NodeId node,
                               Counts counts, Of of);
  template <class Of>
  std::array<double, 3> meanOfMaterials(const Model& model, const CrackEdges& edges, EdgeId edge,
                                        NodeId node, Of of);
  Stress stressAcross(const Model& model, const CrackEdges& edges, EdgeId edge);
  void weakenAround(const Model& model, const CrackEdges& edges, ElementId element);
  Overstressed compare(const Model& model, const CrackEdges& edges, EdgeId edge);
  double factorAt(const Model& model, const CrackEdges& edges, EdgeId edge, double ratio,
                  const Stress& stress);
  double strainRateAt(const Model& model, const CrackEdges& edges, EdgeId edge,
                      const Stress& stress);
  double tractionAtTip(const Model& model, const CrackEdges& edges, EdgeId edge, NodeId node);
  std::vector<EdgeId> pickApart(const Model& model, const CrackEdges& edges);

  // Checked in this call if the mark is the call's number.
  std::uint32_t call_ = 0;
  std::vector<std::uint32_t> elementSeen_, nodeSeen_, edgeSeen_, nodeTaken_, nodeTested_;
  std::vector<Stress> elementStress_, nodeStress_;  // Pa: xx, yy, xy
  std::vector<Law> laws_;                           // by component
  // Pa, by node: least strength of the edges there that have not cracked; infinite without any.
  std::vector<double> weakest_;
  std::vector<Fan> fanOf_;  // by node, as soon as it has been checked
  std::vector<ElementId> fans_;
  std::vector<ElementId> fan_, around_;
  std::vector<NodeId> nodes_;  // that are checked in this call
  std::vector<NodeId> weak_;   // of these: where edges may crack
  std::vector<PartList<NodeId>> parts_;
  std::vector<Overstressed> found_;
  std::vector<Weakened> weakened_;
  // With a rate effect:
  std::vector<Overload> over_;
  StepTime step_{};
  std::span<const Overload> former_;
};

}  // namespace yadefrag
