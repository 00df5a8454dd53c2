#include "rigid/rigid_corners.hpp"

#include <algorithm>
#include <cmath>

namespace yadefrag {

using yade::Quaternionr;

bool isWall(const yade::Body& body) {
  return dynamic_cast<const yade::Wall*>(body.shape.get()) != nullptr;
}

RigidPose::RigidPose(const yade::Body& body, double dt)
    : position(body.state->se3.position + dt * body.state->vel) {
  if (isWall(body)) return;
  orientation = body.state->se3.orientation;
  const double angle = dt * body.state->angVel.norm();
  if (angle > 0)
    orientation =
        Quaternionr(Eigen::AngleAxis<double>(angle, body.state->angVel.normalized())) * orientation;
}

FormerCorners::FormerCorners(std::span<const RigidCorner> corners,
                             std::span<const yade::Body* const> bodies,
                             std::span<const Vec2> places) {
  for (std::uint32_t i = 0; i < corners.size(); ++i) {
    const yade::Body* body = bodies[corners[i].member];
    if (!body) continue;
    const yade::Vector3r here = RigidPose(*body).place(corners[i].place);
    sides_[body].push_back(
        {i, places[i], places[corners[i].following], places[i] - Vec2{here[0], here[1]}});
  }
}

FormerCorners::Found FormerCorners::take(const yade::Body& body, Vec2 begin, Vec2 end,
                                         double farthest) {
  const auto known = sides_.find(&body);
  if (known == sides_.end() || known->second.empty()) return {World::kNoCorner, begin};
  std::vector<Side>& sides = known->second;
  const auto away = [&](const Side& side) {
    return std::max(norm(side.begin - begin), norm(side.end - end));
  };
  const bool wall = isWall(body);
  const auto nearest = wall ? sides.begin() : std::ranges::min_element(sides, {}, away);
  if (!wall && !(away(*nearest) <= farthest)) return {World::kNoCorner, begin};
  const Found found{nearest->number, wall ? begin + nearest->lag : nearest->begin};
  sides.erase(nearest);
  return found;
}

}  // namespace yadefrag
