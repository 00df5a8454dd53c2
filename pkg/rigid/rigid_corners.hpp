#pragma once
// Corners of rigid boundaries: their positions, and their identification when boundaries are made
// again.

#include <cstdint>
#include <span>
#include <unordered_map>
#include <vector>

#include "abi/yade.hpp"
#include "core/vec2.hpp"
#include "step/world.hpp"

namespace yadefrag {

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

}  // namespace yadefrag
