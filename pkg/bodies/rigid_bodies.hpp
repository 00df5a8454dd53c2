#pragma once
// YADE's Wall, Box and Facet as rigid boundaries for contact with finite-element bodies. They move
// as YADE's bodies do, and contact forces are applied to these.
//
// In a step the boundary moves from its position to the position that YADE's body will reach
// without contact with finite-element bodies. If it obeys forces (rigid_movers.hpp), contact
// changes its velocity in the step, and NewtonIntegrator makes the same change from the forces that
// are given to the body: momentum and energy are conserved exactly. Changes that were unknown
// before the step (forces of engines after FESolver, the integrator's damping) follow in the next
// step.

#include <cstdint>
#include <string>
#include <vector>

#include <boost/serialization/vector.hpp>

#include "bodies/entry_bodies.hpp"
#include "bodies/node_forces.hpp"
#include "bodies/rigid_movers.hpp"
#include "bodies/rigid_outlines.hpp"
#include "core/step_times.hpp"
#include "step/world.hpp"
#include "yade/any_archive.hpp"
#include "yade/yade.hpp"

namespace yadefrag {

class RigidBodies {
 public:
  /// Adds new bodies and removes those no longer in the scene. Makes all boundaries again if one of
  /// them has another shape, enters or leaves the plane, is displaced from the position to which it
  /// would have moved, separates from the next one, or begins or ceases to obey forces. `wanted`:
  /// false removes all. `newton`: the integrator that will move the bodies in this step, or null.
  /// Returns true if boundaries were made. Throws InputError if a new one overlaps a finite-element
  /// body: there are then no boundaries.
  bool follow(yade::Scene& scene, World& world, EntryBodies& entries, bool wanted,
              const yade::NewtonIntegrator* newton);
  /// Sets the velocities and the inertia for the next step.
  void giveVelocities(yade::Scene& scene, World& world, const yade::NewtonIntegrator* newton);
  /// Adds the forces of the last step to YADE's bodies, with their moments.
  void giveForces(yade::Scene& scene, const World& world, const StepLength& length,
                  ContactReactions& given) const;
  /// Gives a message if a smooth body rests on them with two points beside an arc that enters.
  void warnOfArcs(const World& world);

  [[nodiscard]] bool any() const { return !corners_.empty(); }
  /// True if any of them obeys forces.
  [[nodiscard]] bool anyMovable(const yade::Scene& scene) const;
  /// Messages about them since the last call; each is given once.
  [[nodiscard]] std::vector<std::string> takeSentences();

  void archive(AnyArchive& archive, const World& world);

 private:
  using Vector3r = yade::Vector3r;
  static constexpr yade::Body::id_t kHeld = RigidPart::kHeld;
  struct Member {
    yade::Body::id_t id;
    yade::shared_ptr<yade::Body> body = {};  // null after loading, until it has been found
    std::vector<double> form = {};
    bool isNew = true;  // or its shape changed: it must not overlap a body
    /// It was out of the plane when it was last checked; it may come back.
    bool isOut = false;
    /// The body that moves it by forces, itself or its clump; `kHeld` if forces do not move it.
    yade::Body::id_t mover = kHeld;
    Vector3r position = Vector3r::Zero();  // m
    yade::Quaternionr orientation = yade::Quaternionr::Identity();
  };

  void findBodies(const yade::Scene& scene, const yade::NewtonIntegrator* newton);
  bool takeNew(const yade::Scene& scene, int mask);
  [[nodiscard]] bool holds(const yade::Scene& scene, const World& world,
                           const yade::NewtonIntegrator* newton);
  [[nodiscard]] bool areInPlace(const World& world, double dt) const;
  [[nodiscard]] static bool comesBack(Member& member);
  void build(yade::Scene& scene, World& world, EntryBodies& entries,
             const yade::NewtonIntegrator* newton);
  [[nodiscard]] std::vector<RigidPart> parts(const yade::Scene& scene, bool axisymmetric,
                                             std::vector<std::uint32_t>& memberOf,
                                             const yade::NewtonIntegrator* newton);
  void startMoving(const yade::Scene& scene, World& world) const;
  [[nodiscard]] FormerCorners formerCorners(const yade::Scene& scene, const World& world) const;
  void addCorners(const RigidOutline& outline, const std::vector<std::uint32_t>& memberOf);
  void remove(yade::Scene& scene, World& world, EntryBodies& entries);
  [[nodiscard]] bool slideWalls(World& world);
  [[nodiscard]] const RigidCorner& cornerOf(const World& world, EntryId entry) const;
  void warnOfUnmoved();
  void warnOfMoments(const Member& member, const yade::Body& mover,
                     const yade::NewtonIntegrator& newton);

  std::vector<Member> members_;
  std::vector<RigidCorner> corners_;
  std::size_t seen_ = 0;  // number of the scene's bodies at the last check
  RigidMovers movers_;
  std::vector<std::string> sentences_;
  bool reportedFlat_ = false, reportedMoment_ = false, reportedArc_ = false;
};

}  // namespace yadefrag
