#pragma once
// Positions of rigid boundaries, and the motion of those that obey forces.

#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <unordered_map>
#include <vector>

#include "contact/inertia.hpp"
#include "core/vec2.hpp"
#include "step/world.hpp"
#include "yade/yade.hpp"

namespace yadefrag {

// --- Corners of rigid boundaries: their positions, and their identification when boundaries are
// made again.

/// Position and orientation of a body, at present or after `dt` (s) at its velocity. Walls do not
/// rotate.
struct RigidPose {
  yade::Vector3r position;
  yade::Quaternionr orientation = yade::Quaternionr::Identity();

  explicit RigidPose(const yade::Body& body, double dt = 0);
  [[nodiscard]] yade::Vector3r place(const yade::Vector3r& local) const {
    return position + orientation * local;
  }
  [[nodiscard]] yade::Vector3r local(const yade::Vector3r& place) const {
    return orientation.conjugate() * (place - position);
  }
};

[[nodiscard]] bool isWall(const yade::Body& body);

/// In the order of the world's rigid nodes. Positions are in the frame of the member.
struct RigidCorner {
  std::uint32_t member;
  std::uint32_t following;    // corner at the end of its side
  yade::Vector3r place, end;  // m, position of the corner and of the end of its side
};

/// The former corners, for making boundaries again. An unchanged side begins its motion at its
/// former position, and keeps its contacts.
class FormerCorners {
 public:
  /// `bodies`: by member, null if the body was removed or its shape changed; `places`: m, by
  /// corner.
  FormerCorners(std::span<const RigidCorner> corners, std::span<const yade::Body* const> bodies,
                std::span<const Vec2> places);

  struct Found {
    std::uint32_t number;  ///< number of the corner; World::kNoCorner: none
    Vec2 place;            ///< m
  };
  /// Finds, out of a body's sides not found yet, the one nearest to the side from `begin` to `end`
  /// (m), if both its ends are at most `farthest` (m) away. For a wall, whose length is arbitrary,
  /// the next side.
  [[nodiscard]] Found take(const yade::Body& body, Vec2 begin, Vec2 end, double farthest);

 private:
  struct Side {
    std::uint32_t number;
    Vec2 begin, end;  // m
    Vec2 lag;         // m, distance from the position given by the body
  };
  std::unordered_map<const yade::Body*, std::vector<Side>> sides_;
};

// --- YADE's rigid bodies that obey forces: their motion in a step as NewtonIntegrator will compute
// it from the forces known so far, and their inertia for the forces of contact, which are added in
// the step.

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
