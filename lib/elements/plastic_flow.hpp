#pragma once
// Bodies that yield, in a step: damage and flow.

#include <span>
#include <vector>

#include "elements/element_kernel.hpp"
#include "elements/node_sums.hpp"
#include "elements/plastic_kernel.hpp"
#include "elements/plastic_return.hpp"
#include "mesh/model.hpp"

namespace yadefrag {

// --- Damage of materials that yield, in a step (mesh/plastic_material.hpp): it follows the flow of
// each triangle. Triangles that have failed are listed, so that cracks look at their edges.

/// Stress after the return, and the flow that led to it.
struct FlowStep {
  double strain;       ///< Δp
  double temperature;  ///< K, before
  double mean, mises;  ///< Pa, of τ; mean and von Mises' stress; of a cone before the return
  double volume;       ///< τ/σ: J, or det F of a cone
  double resistance;   ///< factor of the failure strain and of the spall stress
};

/// The damage after a step of Δt (s), from that before it; at most 1.
[[nodiscard]] double damageAfter(const PlasticMaterial& m, double damage, const FlowStep& step,
                                 double dt);

class PlasticDamage {
 public:
  void rebuild(const Model& model);
  /// Before each step.
  void begin(std::size_t threads);
  /// Of a triangle that is about to fail or has flowed.
  void add(Model& model, const PlasticMaterial& m, std::uint32_t element, const FlowStep& step,
           double dt, std::size_t thread);
  /// Undoes the changes of the last step.
  void undo(Model& model);
  /// Appends the triangles that have failed.
  void appendFailed(std::vector<ElementRange>& ranges) const;

 private:
  struct Former {
    std::uint32_t element;
    double damage;
  };
  struct Thread {
    std::vector<Former> former;
    std::vector<std::uint32_t> failed;  // in the last step
  };

  std::vector<std::uint32_t> failed_;  // before it, ascending
  std::vector<Thread> threads_;
};

// --- Bodies that yield, in a step: the state of their triangles follows the positions xⁿ, at which
// the forces are computed. With ElementKind::kSmoothed the volume ratio is averaged at the nodes
// (Bonet and Burton 1998, Commun. Numer. Meth. Eng. 14, 437): a node has the pressure of its
// triangles' whole volume, and a triangle the mean pressure of its nodes. Linear triangles, which
// would lock in flow without change of volume, do not lock then. No cost if no body yields.
//
// Where flow changes the volume (frictional materials), volumes are averaged twice: triangles open
// by as much as if their neighbours opened as they do, and the pressures of the volumes after that
// determine the rest of the flow and the forces. These are then the exact gradient of the energy,
// no triangle is left above the yield surface, and the plastic work is the stress times the strain
// of the flow.

class PlasticFlow {
 public:
  /// (1/m²) Squares of the steepest gradients: when the critical step was last computed, and of the
  /// triangles that flowed in the last step.
  struct Steepness {
    double known = 0, last = 0;
  };

  void rebuild(const Model& model, const ElementChunks& elements);
  /// Must be called after a split of nodes.
  void follow(const ElementChunks& elements, std::span<const std::uint32_t> abandoned);
  [[nodiscard]] bool isOn() const { return !yield_.empty(); }
  [[nodiscard]] bool isSmoothing() const { return now_.isOn(); }
  /// True if volumes of some bodies are averaged again after the flow.
  [[nodiscard]] bool isOpening() const { return before_.isOn(); }

  /// Before each step of `threads` threads; `dt` (s): the step that led to the positions.
  void begin(const ElementChunks& elements, int threads, double dt);
  /// First pass, for one smoothed chunk; positions by local number.
  void sum(InstructionSet set, Model& model, const ElementChunks& elements, const Chunk& chunk,
           const Vec2* position, std::size_t thread);
  /// After the first pass, for each row of `ElementChunks::sharedNodes`: that node's whole sums.
  void sumShared(const ElementChunks& elements, std::size_t row);
  /// If the flow of the chunk changes its volume: sums the volumes that follow; `sumShared` must be
  /// called again.
  void open(InstructionSet set, Model& model, const ElementChunks& elements, std::size_t chunk,
            const Vec2* position);
  /// Second pass, for one chunk: forces (N) by local number. False if an element is flat.
  bool addForces(InstructionSet set, Model& model, const ElementChunks& elements, std::size_t chunk,
                 const Vec2* position, Vec2* force, std::size_t thread);

  /// (J) Work that the triangles have dissipated in the last step, up to the positions xⁿ.
  [[nodiscard]] double dissipation() const;
  /// Undoes the changes of the last step.
  void undo(Model& model);
  /// True if flow has made triangles so much flatter that the critical step must be computed anew;
  /// then `noteSteepest`.
  [[nodiscard]] bool isSteeper() const { return isSteeper(steepness()); }
  void noteSteepest(const Model& model);
  [[nodiscard]] static bool isSteeper(const Steepness& steepness);
  [[nodiscard]] Steepness steepness() const;
  void restore(const Steepness& steepness);
  /// Appends the triangles whose material has failed.
  void appendFailed(std::vector<ElementRange>& ranges) const { damage_.appendFailed(ranges); }

 private:
  void addDamage(Model& model, const ElementChunks& elements, const Chunk& chunk,
                 const Vec2* position, std::size_t thread, std::size_t first);
  [[nodiscard]] PlasticChunk inputOf(Model& model, const ElementChunks& elements,
                                     const Chunk& chunk);
  void setYield(const Component& body, const PlasticState& state, std::size_t element);

  std::vector<double> yield_;    // Pa, by triangle
  std::vector<double> thermal_;  // factor of the temperature in it
  // m³, a third of V·J of each triangle, then pressures (Pa): at xⁿ before flow, at xⁿ⁻¹, and at
  // xⁿ after flow that changes volumes.
  NodeSums<double> now_, before_, opened_;
  std::vector<double> opening_;     // by triangle, volume strain of the last flow
  std::vector<double> dissipated_;  // J, by chunk
  std::vector<FlowRoom> threads_;
  PlasticDamage damage_;
  double dt_ = 0;
  double squaredSteepest_ = 0;
  double restored_ = 0;  // Steepness::last before the first step
};

}  // namespace yadefrag
