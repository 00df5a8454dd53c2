#pragma once
// YADE's rigid bodies that obey forces: their motion in a step as NewtonIntegrator will compute it
// from the forces known so far, and their inertia for the forces of contact, which are added in the
// step.

#include <map>
#include <optional>
#include <vector>

#include "abi/yade.hpp"
#include "contact/inertia.hpp"

namespace yadefrag {

/// The body that moves `body`: its clump, or itself.
[[nodiscard]] const yade::Body& moverOf(const yade::Scene& scene, const yade::Body& body);

/// True if `newton` (may be null) moves the body by the forces in the plane z = 0.
[[nodiscard]] bool obeysForces(const yade::NewtonIntegrator* newton, const yade::Body& mover);

/// True if NewtonIntegrator would divide by zero: a direction is free, but has no mass or inertia.
[[nodiscard]] bool lacksInertia(const yade::State& state);

/// (kg m²) The moment of inertia about z of a body that NewtonIntegrator rotates by another one: if
/// rotations are blocked it uses the third of the principal moments, whose axes YADE sorts. No
/// value if the two are the same.
[[nodiscard]] std::optional<double> neglectedMoment(const yade::NewtonIntegrator& newton,
                                                    const yade::Body& mover);

/// Motion of a body in a step, without contact with finite-element bodies.
struct FreeMotion {
  double dt;                ///< s
  yade::Vector3r centre;    ///< m, before the step
  yade::Vector3r velocity;  ///< m/s, in the step
  yade::Vector3r spin;      ///< rad/s
  Vec2 mobility;            ///< 1/kg, by direction
  double turning;           ///< 1/(kg m²), about z

  /// (m) Position after the step of a point of the body.
  [[nodiscard]] yade::Vector3r place(const yade::Vector3r& before) const;
  [[nodiscard]] RigidMass mass() const;
};

class RigidMovers {
 public:
  [[nodiscard]] FreeMotion motionOf(yade::Scene& scene, const yade::NewtonIntegrator& newton,
                                    const yade::Body& mover);
  /// Must be called after members of clumps may have changed.
  void forget() { members_.clear(); }

 private:
  const std::vector<yade::Body::id_t>& membersOf(const yade::Scene& scene, const yade::Body& clump);

  std::map<yade::Body::id_t, std::vector<yade::Body::id_t>> members_;  // by clump
  std::size_t known_ = 0;  // number of the scene's bodies when members were found
};

}  // namespace yadefrag
