#pragma once
// Corners of rigid boundaries: where they are, and which is which when boundaries are made anew.

#include <cstdint>
#include <span>
#include <unordered_map>
#include <vector>

#include "abi/yade.hpp"
#include "core/vec2.hpp"
#include "step/world.hpp"

namespace yadefrag {

/// Where a body is, now or after `dt` (s) at its velocity. Walls do not turn.
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

/// In the order of the world's rigid nodes. Places are the member's own, in its frame.
struct RigidCorner {
  std::uint32_t member;
  std::uint32_t following;    // corner to which its side leads
  yade::Vector3r place, end;  // m, of the corner, and of the end of its side
};

/// What has been there, when boundaries are made anew. A side that is the same begins its motion
/// where it was, and keeps what touches it.
class FormerCorners {
 public:
  /// `bodies`: by member, null for one that is gone or has another shape; `places`: m, by corner.
  FormerCorners(std::span<const RigidCorner> corners, std::span<const yade::Body* const> bodies,
                std::span<const Vec2> places);

  struct Found {
    std::uint32_t number;  ///< of the corner; World::kNoCorner: there is none
    Vec2 place;            ///< m
  };
  /// Of a body's sides that have not been found yet the one nearest to that from `begin` to `end`
  /// (m), if both its ends are at most `farthest` (m) away. Of a wall, which is as long as it needs
  /// to be, the next.
  [[nodiscard]] Found take(const yade::Body& body, Vec2 begin, Vec2 end, double farthest);

 private:
  struct Side {
    std::uint32_t number;
    Vec2 begin, end;  // m
    Vec2 lag;         // m, from where the body has it
  };
  std::unordered_map<const yade::Body*, std::vector<Side>> sides_;
};

}  // namespace yadefrag
