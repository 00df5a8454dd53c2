#pragma once
// The explicit time step of all bodies without contact (leapfrog):
//   v* = [(1−d) vⁿ⁻½ + Δv f(xⁿ)/m] / (1+d), d = αΔv/2;  x* = xⁿ + Δt v*,
// where Δv = ½(Δtⁿ⁻¹ + Δtⁿ) is Δt as long as the step does not change.
// Contact then corrects x* and v*, and `finish` books the works of the whole step.

#include <span>
#include <vector>

#include "core/parallel.hpp"
#include "core/step_length.hpp"
#include "core/tolerances/dynamics.hpp"
#include "dynamics/element_kernel.hpp"
#include "dynamics/energy_ledger.hpp"
#include "dynamics/strain_smoothing.hpp"
#include "mesh/model.hpp"

namespace yadefrag {

struct StepSettings {
  double damping = 0;  ///< 1/s, α of the mass-proportional damping
  Vec2 gravity = {};   ///< m/s²
  BulkViscosity viscosity = {};

  [[nodiscard]] double drag(const StepLength& step) const { return damping * step.velocity / 2; }
};

class ExplicitDynamics {
 public:
  explicit ExplicitDynamics(InstructionSet set = bestInstructionSet()) : set_(set) {}

  /// To be called after nodes or triangles came, went or were renumbered, before the next step.
  void rebuild(const Model& model);

  /// The same where nodes only split, at a cost that grows with the number of changed elements: new
  /// nodes were appended, and corners of the `changed` elements became new nodes. `originals[i]` is
  /// what the i-th new node was copied from. All later steps have the same bits as after `rebuild`.
  /// Returns how many chunks of elements were built anew.
  std::size_t follow(const Model& model, std::span<const ElementId> changed,
                     std::span<const NodeId> originals);

  /// Nodes of dropped triangles stay where they are from now on; no work is booked for that.
  void drop(std::span<const NodeId> nodes);
  /// Room for so many nodes, so that the first that split do not wait for it.
  void reserve(std::size_t nodes);

  /// From now on, steps look for brittle elements that are stressed nearly (`kStrengthLook`) up to
  /// the lowest strength (Pa) of their component; 0 or infinite: not watched; empty: none is. That
  /// costs nothing where nothing is watched. Holds on through `rebuild` and `follow`.
  void watchStress(std::vector<double> leastStrengthByComponent);
  /// Small ranges, ascending, that hold all elements found stressed in the last step, at its xⁿ.
  [[nodiscard]] std::span<const ElementRange> stressed() const { return stressed_; }

  /// From now on each step tells whether any node became faster than `most` (m/s, up to
  /// `kAnySpeed`), which costs nothing: it takes the place of another look at the new velocity.
  void watchSpeed(double most) { speedLimit_ = most; }
  [[nodiscard]] double speedLimit() const { return speedLimit_; }
  /// In the last step.
  [[nodiscard]] bool anyFaster() const { return anyFaster_; }

  /// One step; `outerForces` (N, by node) may be empty. They act for Δt, not Δv: so does what they
  /// push back on, which others integrate with steps of Δt, and momentum is kept. Held directions
  /// keep their velocity. The result has the same bits for any number of threads. Throws RunError
  /// with element or node and place, and changes nothing, where an element is inverted or not
  /// finite at xⁿ, or a force or a velocity is not finite.
  void predict(Model& model, const StepLength& length, const StepSettings& settings,
               std::span<const Vec2> outerForces, int threads);

  /// Throws RunError where the step so far has turned an element inside out; `correction` (m): the
  /// most that a node was moved by since `predict`. Elements are looked at only if some were flat
  /// at xⁿ, or if a node moves by a good part of the least height of an element.
  void requireUpright(const Model& model, double dt, double correction) const;

  /// Undoes `predict` and all that has happened to positions and velocities since.
  void takeBack(Model& model);

  /// Books the works of gravity, loads, outer forces, damping, viscosity and prescribed motion,
  /// once the velocities are corrected. `contactForces` (N, by node, empty: none) serve only to
  /// find the reactions of held nodes: contact books its own work. Costs nothing where none of
  /// these act.
  void finish(const Model& model, const StepLength& length, const StepSettings& settings,
              std::span<const Vec2> outerForces, std::span<const Vec2> contactForces,
              EnergyLedger& ledger, int threads = 1) const;

  /// Was no node held in the last step, nor since the last `rebuild`?
  [[nodiscard]] bool holdsNone() const { return heldNodes_.empty(); }
  /// (N) By node, 0 in directions that are not held: what is needed, over all forces that act on
  /// the node, to move it as it is prescribed. Arguments as those of `finish`, after it. Values of
  /// nodes that are not held are left as they are, or 0 if they are new.
  void measureReactions(const Model& model, const StepLength& length, const StepSettings& settings,
                        std::span<const Vec2> outerForces, std::span<const Vec2> contactForces,
                        std::vector<Vec2>& reactions) const;

  /// (m) xⁿ and (m/s) vⁿ⁻½ by node, between `predict` and the next change of the model:
  /// v̄ = ½(previous + present) is what contact books with.
  [[nodiscard]] std::span<const Vec2> previousPosition() const { return previousPosition_; }
  [[nodiscard]] std::span<const Vec2> previousVelocity() const { return previousVelocity_; }
  /// In the last step, did a node move by a good part of the least height of an element.
  [[nodiscard]] bool anySwift() const { return anySwift_; }
  /// (N) Elastic and viscous forces f(xⁿ) by node, of the last step.
  [[nodiscard]] std::span<const Vec2> internalForces() const { return force_; }
  void addTo(Footprint& footprint) const;

 private:
  struct Update;
  struct Works;
  /// Of one thread.
  struct alignas(64) Scratch {
    std::vector<Vec2> values;
    std::vector<ElementRange> stressed, flat;
    StrainSmoothing::Room room;
  };

  void smoothStrains(const Model& model, std::size_t part, std::size_t parts, PartErrors& errors);
  void sumChunk(const Model& model, const Chunk& chunk, const BulkViscosity& viscosity,
                Scratch& scratch);
  void lookAtFlat(const Model& model, const Chunk& chunk, Scratch& scratch);
  Vec2 holdBack(const Nodes& nodes, std::size_t node, Vec2& velocity);
  void letGo(Nodes& nodes);
  void sumShared(const BulkViscosity& viscosity, NodeId begin, NodeId end);
  template <bool kForced>
  void move(Nodes& nodes, const Update& update, std::size_t begin, std::size_t end);
  void step(Model& model, const Update& update, const BulkViscosity& viscosity);
  [[noreturn]] static void refuseElement(const Model& model);
  [[noreturn]] void refuseNode(Model& model);

  InstructionSet set_;
  ElementChunks elements_;
  StrainSmoothing smoothing_;
  std::vector<Vec2> force_, partialForce_;  // of all: N
  std::vector<Vec2> viscousForce_,
      partialViscous_;  // of the viscosity alone; empty while it is off
  // Each step writes into these, and then exchanges them for the model's: the state before it stays
  // at hand without a copy.
  std::vector<Vec2> previousPosition_, previousVelocity_;
  std::vector<NodeId> heldNodes_;
  std::vector<Vec2> heldVelocity_;     // of held nodes in the last step; empty if none was held
  std::vector<Scratch> scratch_;       // one per thread
  std::vector<double> leastStrength_;  // Pa, by component
  std::vector<ElementRange> stressed_;
  double speedLimit_ = tolerance::kAnySpeed;  // m/s
  double leastHeight_ = 0;                    // m, of all elements, stress-free
  bool watching_ = false;
  bool badElement_ = false, badNode_ = false, anyFaster_ = false, anySwift_ = false;
};

}  // namespace yadefrag
