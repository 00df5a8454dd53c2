#pragma once
// Everything about cracks: which edges may crack, which have, what still holds them together.

#include <span>
#include <vector>

#include "dynamics/explicit_dynamics.hpp"
#include "fracture/cohesion.hpp"
#include "fracture/crack_edges.hpp"
#include "fracture/node_splitting.hpp"
#include "fracture/strength_check.hpp"

namespace yadefrag {

class Fracture {
 public:
  /// A body has joined the model; nothing happens unless it can crack. Returns edges that are to be
  /// opened now: those of joints without strength.
  std::vector<EdgeId> addBody(const Model& model, ComponentId component,
                              const BrittlePlaces& places = {});
  /// Opens edges that nothing has held so far, and splits nodes; they count as no cracks.
  void open(Model& model, const ContactSurfaces& surfaces, std::span<const EdgeId> joints,
            SplitResult& result);
  /// Two bodies hang together along these sides, as cracks that hold.
  void bond(const Model& model, std::span<const std::array<Side, 2>> sides, double strength,
            double energy, std::span<const Vec2> reference);
  /// A body has left it: its triangles were [first, last).
  void removeBody(const Model& model, ElementId first, ElementId last,
                  std::span<const NodeId> renumberedNodes);

  /// Is there anything that may crack.
  [[nodiscard]] bool isOn() const { return edges.size() != 0; }

  /// Room for what cracks may add, so that the first of them do not wait for it.
  void prepare(Model& model);
  /// Cracks what has reached its strength at the present positions, and splits nodes. True if
  /// `result` has anything in it that others must follow.
  bool crack(Model& model, const ContactSurfaces& surfaces, std::span<const ElementRange> where,
             SplitResult& result);
  /// Notes that the cracks of the last call began at `time` (s).
  void noteStart(double time);
  /// (J) What bodies with smoothed strains gain when nodes split, at the half step: the parts of a
  /// node no longer share a mean strain. `originals` as in SplitResult.
  [[nodiscard]] double splitEnergy(const Model& model, std::span<const NodeId> originals,
                                   double dt) const;
  /// To be called after the reference positions of new nodes are there: cracks that were made hold
  /// as their law says.
  void cohere(const Model& model, std::span<const Vec2> reference);

  [[nodiscard]] std::uint64_t numCracks() const { return numCracks_; }
  void restore(std::uint64_t numCracks) { numCracks_ = numCracks; }

  void addTo(Footprint& footprint) const;

  /// No more edges crack than this, all in all.
  std::uint64_t maxCracks = ~std::uint64_t{0};
  /// (m²) Fragments that come loose and are smaller are taken out; 0: none.
  double minFragmentArea = 0;

  CrackEdges edges;
  /// (s) By edge, when its crack began; -1: it did not, or was there from the start. Later edges
  /// than the last one noted have no value.
  std::vector<double> started;
  std::vector<double> leastStrength;  ///< Pa, by component; follows from the edges
  Cohesion cohesion;

 private:
  StrengthCheck check_;
  std::vector<EdgeId> cracks_;
  std::uint64_t numCracks_ = 0;
};

}  // namespace yadefrag
