#pragma once
// Cracks: the edges that may crack, those that have cracked, and their cohesion.

#include <span>
#include <vector>

#include "fracture/cohesion.hpp"
#include "fracture/crack_edges.hpp"
#include "fracture/strength_check.hpp"
#include "surface/contact_surface.hpp"
#include "time/explicit_dynamics.hpp"

namespace yadefrag {

// --- Changes of the mesh by cracks: the fan of each node at a crack's end is cut, and all its
// parts except one get a new node. Mass, momentum and centre of mass do not change.

/// All changes, from which the arrays by node or triangle are updated.
struct SplitResult {
  std::vector<ElementId> changed;  ///< triangles with a new node, ascending
  std::vector<NodeId> originals;   ///< of each new node, in order: the node from which it was split
  /// All boundary sides at nodes that split or are new on the boundary.
  std::vector<SurfaceSide> sides;
  std::vector<NodeId> onSurface;  ///< old nodes that were inside before and are now on the boundary
};

/// Cracks the edges (ascending, none of them cracked before). An edge whose two ends both remain
/// one node has no visible faces: the mesh around a crack of a single inner edge keeps it closed.
void splitNodes(Model& model, CrackEdges& edges, const ContactSurfaces& surfaces,
                std::span<const EdgeId> cracks, SplitResult& result);

// --- Cracks: the edges that may crack, those that have cracked, and their cohesion.

class Fracture {
 public:
  /// Follows a body that was just added to the model; does nothing unless it can crack. Returns the
  /// edges to be opened now: those of joints without strength.
  std::vector<EdgeId> addBody(const Model& model, ComponentId component,
                              const BrittlePlaces& places = {});
  /// Opens edges without strength, and splits nodes; these do not count as cracks.
  void open(Model& model, const ContactSurfaces& surfaces, std::span<const EdgeId> joints,
            SplitResult& result);
  /// Bonds two bodies along these sides by cohesive cracks.
  void bond(const Model& model, std::span<const std::array<Side, 2>> sides, double strength,
            double energy);
  /// Follows the removal of a body; its triangles were [first, last).
  void removeBody(const Model& model, ElementId first, ElementId last,
                  std::span<const NodeId> renumberedNodes);

  /// True if any edge may crack.
  [[nodiscard]] bool isOn() const { return edges.size() != 0; }

  /// Reserves memory for cracks, so that the first ones need no allocation.
  void prepare(Model& model);
  /// Cracks all edges that have reached their strength at the present positions, and splits nodes.
  /// With a rate effect these edges get the strength and the energy of their strain rate, with a
  /// speed effect the energy of the crack's speed.
  /// Returns true if `result` contains changes that other arrays must follow.
  bool crack(Model& model, const ContactSurfaces& surfaces, std::span<const ElementRange> where,
             const StepTime& step, SplitResult& result, int threads);
  /// Stores `time` (s) as the start of the cracks of the last call.
  void noteStart(double time);
  /// (J) Energy that bodies with smoothed strains gain when nodes split, at the half step: the
  /// parts of a node no longer have a common mean strain. `originals` as in SplitResult.
  [[nodiscard]] double splitEnergy(const Model& model, std::span<const NodeId> originals,
                                   double dt) const;
  /// (J) The same of bodies that yield, in the last call of `crack`.
  [[nodiscard]] double yieldingGain() const { return yieldingGain_; }
  /// Makes the cracks of the last call of `crack` cohesive by their law.
  void applyCohesion(const Model& model);

  /// True if strengths changed in the last call of `crack`.
  [[nodiscard]] bool hasRaised() const { return hasRaised_; }

  /// Edges that got their strength in the last call of `crack`, since their material failed.
  [[nodiscard]] std::span<const EdgeId> weakened() const { return weakened_; }

  [[nodiscard]] std::uint64_t numCracks() const { return numCracks_; }
  void restore(std::uint64_t numCracks) { numCracks_ = numCracks; }

  /// Maximum total number of cracked edges.
  std::uint64_t maxCracks = ~std::uint64_t{0};
  /// (m²) Detached fragments with a smaller area are removed; 0: none.
  double minFragmentArea = 0;

  CrackEdges edges;
  /// (s) By edge, start time of its crack; -1: not cracked, or cracked from the start. Edges after
  /// the last stored one have no value.
  std::vector<double> started;
  /// Edges that a rate effect keeps from cracking, ascending.
  std::vector<Overload> overloads;
  std::vector<double> leastStrength;  ///< Pa, by component; derived from the edges
  Cohesion cohesion;

 private:
  [[nodiscard]] double speedAt(const Model& model, EdgeId edge, double now) const;
  void raiseEnergies(const Model& model, double now);

  StrengthCheck check_;
  std::vector<EdgeId> cracks_, weakened_;
  std::uint64_t numCracks_ = 0;
  bool hasRaised_ = false;
  double yieldingGain_ = 0;  // J
};

}  // namespace yadefrag
