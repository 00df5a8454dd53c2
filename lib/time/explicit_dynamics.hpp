#pragma once
// The explicit time step of all bodies without contact (leapfrog):
//   v* = [(1−d) vⁿ⁻½ + Δv f(xⁿ)/m] / (1+d), d = αΔv/2;  x* = xⁿ + Δt v*,
// where Δv = ½(Δtⁿ⁻¹ + Δtⁿ) is Δt as long as the step does not change.
// Contact then corrects x* and v*, and `finish` computes the work of the whole step.

#include <span>
#include <vector>

#include "core/parallel.hpp"
#include "core/step_times.hpp"
#include "core/tolerances/dynamics.hpp"
#include "core/tolerances/threads.hpp"
#include "elements/element_kernel.hpp"
#include "elements/plastic_flow.hpp"
#include "elements/strain_smoothing.hpp"
#include "mesh/model.hpp"
#include "time/energy_ledger.hpp"

namespace yadefrag {

struct StepSettings {
  double damping = 0;  ///< 1/s, α of the mass-proportional damping
  Vec2 gravity = {};   ///< m/s²
  BulkViscosity viscosity = {};

  [[nodiscard]] double drag(const StepLength& step) const { return damping * step.velocity / 2; }
};

class ExplicitDynamics {
 public:
  explicit ExplicitDynamics(InstructionSet set = widestInstructionSet()) : set_(set) {}

  /// Follows added, removed or renumbered nodes and triangles; `predict` asserts it.
  void rebuild(const Model& model);

  /// Follows a mere split of nodes, at a cost that grows with the number of changed elements: new
  /// nodes were appended, and corners of the `changed` elements became new nodes.
  /// `originals[i]` is the node from which the i-th new node was copied. All later steps have the
  /// same bits as after `rebuild`. Returns the number of chunks of elements that were rebuilt.
  std::size_t follow(const Model& model, std::span<const ElementId> changed,
                     std::span<const NodeId> originals);

  /// Stops the nodes of removed triangles for the rest of the simulation; no work is counted for
  /// that.
  void drop(const Model& model, std::span<const NodeId> nodes);
  /// Reserves memory for this number of nodes, so that the first splits need no allocation.
  void reserve(std::size_t nodes);

  /// Starts the stress check: each step finds brittle elements whose stress is near
  /// (`kStrengthCheck`) the lowest strength (Pa) of their component or above. 0 or infinite: no
  /// check of that component; empty: none at all. Without any check there is no cost. Stays in
  /// force after `rebuild` and `follow`.
  void setStressLimits(std::vector<double> leastStrengthByComponent);
  /// Small ranges, ascending, that contain all elements found stressed in the last step, at its xⁿ.
  [[nodiscard]] std::span<const ElementRange> stressed() const { return stressed_; }

  /// From now on each step reports whether any node became faster than `most` (m/s, up to
  /// `kMostSpeed`). This costs nothing: the step tests the new velocity in any case.
  void setSpeedLimit(double most) { speedLimit_ = most; }
  [[nodiscard]] double speedLimit() const { return speedLimit_; }
  /// True if any node exceeded that speed in the last step.
  [[nodiscard]] bool anyAboveSpeedLimit() const { return anyAboveSpeedLimit_; }

  /// One step; `outerForces` (N, by node) may be empty. These act for Δt, not Δv: their reactions
  /// act on other bodies, which are integrated with steps of Δt, and so momentum is conserved. Held
  /// directions keep their velocity. The result has the same bits for any number of threads. Throws
  /// RunError with the element or node and its position, and changes nothing, if an element is
  /// inverted or not finite at xⁿ, or if a force or a velocity is not finite.
  void predict(Model& model, const StepLength& length, const StepSettings& settings,
               std::span<const Vec2> outerForces, int threads);

  /// The most compressed of the elements that the barrier against collapse acts on, and the part
  /// of its area that is left; none() if there is none.
  struct Flattest {
    ElementId element = ElementId::none();
    double area = tolerance::kBarrierBegin;
  };
  /// Throws RunError if the step so far has inverted an element. `correction` (m): the largest
  /// displacement of a node since `predict`. Elements are checked only if some were flat at xⁿ, or
  /// if a node moves by a large part (`kLargeMove`) of the least height of an element.
  Flattest requireUpright(const Model& model, double dt, double correction) const;
  /// Throws FlatError; `stable` (s): a sufficient step.
  [[noreturn]] void refuseFlat(const Model& model, const Flattest& flattest, double dt,
                               double stable) const;

  /// Contact has changed the velocity of a held node, of a rigid boundary that obeys forces.
  void setHeld(NodeId node, Vec2 velocity) { heldVelocity_[node.value] = velocity; }

  /// Undoes `predict` and all later changes of positions and velocities.
  void undo(Model& model);

  /// Computes the work of gravity, loads, external forces, damping, viscosity and prescribed
  /// motion, after the correction of the velocities. `contactForces` (N, by node; empty: none) are
  /// used only for the reactions of held nodes: contact computes its own work. No cost if none of
  /// these acts.
  void finish(const Model& model, const StepLength& length, const StepSettings& settings,
              std::span<const Vec2> outerForces, std::span<const Vec2> contactForces,
              EnergyLedger& ledger, int threads = 1) const;

  /// (J) Energy that this step adds to kinetic plus strain energy because its length differs from
  /// that of the last one: ¼(Δtⁿ⁻¹ − Δtⁿ) Σ f·(vⁿ⁺½ − vⁿ⁻½), exact for small strains. Call after
  /// the correction of the velocities.
  [[nodiscard]] double energyOfChange(const Model& model, const StepLength& length) const;

  /// True if no node with a mass was held in the last step, nor since the last `rebuild`.
  [[nodiscard]] bool holdsNone() const { return heldNodes_.empty(); }
  /// (N) Reactions by node, 0 in directions that are not held: the force, in addition to all others
  /// on the node, that the prescribed motion requires. Call after `finish`, with the same
  /// arguments. Values of nodes that are not held are not changed; those of new nodes are 0.
  void measureReactions(const Model& model, const StepLength& length, const StepSettings& settings,
                        std::span<const Vec2> outerForces, std::span<const Vec2> contactForces,
                        std::vector<Vec2>& reactions) const;

  /// (m) xⁿ and (m/s) vⁿ⁻½ by node, valid between `predict` and the next change of the model:
  /// contact computes work with v̄ = ½(previous + present).
  [[nodiscard]] std::span<const Vec2> previousPosition() const { return previousPosition_; }
  [[nodiscard]] std::span<const Vec2> previousVelocity() const { return previousVelocity_; }
  /// True if in the last step a node moved by a large part (`kLargeMove`) of the least height of an
  /// element.
  [[nodiscard]] bool anyLargeMove() const { return anyLargeMove_; }
  /// (N) Elastic and viscous forces f(xⁿ) by node, of the last step.
  [[nodiscard]] std::span<const Vec2> internalForces() const { return force_; }
  /// Bodies that yield; of the last step.
  [[nodiscard]] const PlasticFlow& flow() const { return flow_; }
  PlasticFlow& flow() { return flow_; }

 private:
  struct Update;
  struct Works;
  /// Data of one thread.
  struct alignas(tolerance::kThreadsApart) Scratch {
    std::vector<Vec2> values;
    std::vector<ElementRange> stressed, flat;
    StrainSmoothing::Room room;
  };

  /// From which a second thread saves time.
  static std::size_t elementsPerThread() {
    return tolerance::kElementsPerItem * leastItemsPerThread();
  }
  void collectStressed();
  void smoothStrains(Model& model, std::size_t part, std::size_t parts, PartErrors& errors);
  void sumChunk(Model& model, std::size_t chunk, const BulkViscosity& viscosity, std::size_t part);
  void sumForces(Model& model, std::size_t chunk, std::size_t part, const Vec2* position,
                 Vec2* force);
  void handleFlat(const Model& model, const Chunk& chunk, Scratch& scratch);
  void addBarrierForces(const Model& model, const Chunk& chunk, Vec2* force) const;
  Vec2 applyHeld(const Nodes& nodes, std::size_t node, Vec2& velocity);
  void exchangeHeld(Nodes& nodes);
  void sumShared(const BulkViscosity& viscosity, NodeId begin, NodeId end);
  template <bool kForced>
  void move(Nodes& nodes, const Update& update, std::size_t begin, std::size_t end);
  void step(Model& model, const Update& update, const BulkViscosity& viscosity);
  [[noreturn]] static void refuseElement(const Model& model);
  [[noreturn]] void refuseNode(Model& model);

  InstructionSet set_;
  ElementChunks elements_;
  StrainSmoothing smoothing_;
  PlasticFlow flow_;
  std::vector<Vec2> force_, partialForce_;  // N, total
  std::vector<Vec2> viscousForce_,
      partialViscous_;  // of the viscosity only; empty if it is off
  // Each step writes into these arrays and then swaps them with the model's: the previous state is
  // kept without a copy.
  std::vector<Vec2> previousPosition_, previousVelocity_;
  std::vector<NodeId> heldNodes_;
  std::vector<Vec2> heldVelocity_;     // of held nodes in the last step; empty if none was held
  std::vector<Scratch> scratch_;       // one per thread
  std::vector<double> leastStrength_;  // Pa, by component
  std::vector<ElementRange> stressed_;
  double speedLimit_ = tolerance::kMostSpeed;  // m/s
  double leastHeight_ = 0;                     // m, of all elements, stress-free
  bool watching_ = false;
  bool badElement_ = false, badNode_ = false, anyAboveSpeedLimit_ = false, anyLargeMove_ = false;
};

}  // namespace yadefrag
