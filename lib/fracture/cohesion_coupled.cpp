// Cohesion: sweeps over the tractions at nodes that contact moves, too.

#include <algorithm>
#include <cassert>

#include "core/tolerances/fracture.hpp"
#include "fracture/cohesion.hpp"

namespace yadefrag {

std::uint32_t Cohesion::groupOf(NodeId node) const {
  assert(groupOf_.size() == points_.size() && node.value < firstAt_.size());
  const std::uint32_t i = firstAt_[node.value];
  if (i >= points_.size() || (points_[i].here != node && points_[i].there != node)) return kNoGroup;
  return groupOf_[i];
}

void Cohesion::begin(std::span<const Vec2> position) {
  start_.clear();
  for (const Point& point : points_)
    start_.push_back({position[point.here.value], position[point.there.value]});
  const auto nodeOf = [&](std::size_t i) {
    return i % 2 == 0 ? points_[i / 2].here : points_[i / 2].there;
  };
  fillRows(
      pointsAt_, points_.size(), 2 * points_.size(),
      [&](std::size_t i) { return firstAt_[nodeOf(i).value]; },
      [](std::size_t i) { return static_cast<std::uint32_t>(i / 2); });
  waiting_.clear(points_.size());
  improved_.clear();
  isCoupled_ = true;
}

void Cohesion::noteMoved(NodeId node) {
  for (const std::uint32_t i : pointsAt_.row(firstAt_[node.value])) waiting_.add(i);
}

/// Visits all points that wait; after a change that `matters` the others at its nodes wait.
template <class Matters>
double Cohesion::improve(std::vector<Vec2>& position, Matters matters) {
  double most = 0;
  waiting_.visitUp([&](std::size_t i) {
    Point& point = points_[i];
    relax(position, point);
    most = std::max(most, moved(point));
    improved_.push_back(static_cast<std::uint32_t>(i));
    if (!matters(point)) return;
    noteMoved(point.here), noteMoved(point.there);
    if (point.isEven) waiting_.remove(i);
  });
  return most;
}

double Cohesion::sweep(std::vector<Vec2>& position, double tolerance) {
  return improve(position, [&](const Point& point) { return moved(point) > tolerance; });
}

double Cohesion::converge(std::vector<Vec2>& position) {
  for (const std::uint32_t i : improved_) waiting_.add(i);
  for (int sweep = 0; sweep < tolerance::kCohesionSweeps; ++sweep) {
    double worst = 0;
    improve(position, [&](const Point& point) {
      const double change = norm(point.change) / point.strength;
      worst = std::max(worst, change);
      return change > tolerance::kCohesionChange;
    });
    if (worst <= tolerance::kCohesionChange) break;
  }
  double most = 0;
  for (std::size_t i = 0; i < points_.size(); ++i)
    most = std::max({most, norm(position[points_[i].here.value] - start_[i][0]),
                     norm(position[points_[i].there.value] - start_[i][1])});
  return most;
}

}  // namespace yadefrag
