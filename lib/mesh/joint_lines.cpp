#include "mesh/joint_lines.hpp"

#include <fmt/format.h>

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_2_algorithms.h>

#include <algorithm>
#include <set>
#include <string>

#include "core/errors.hpp"
#include "core/tolerances/mesh.hpp"

namespace yadefrag {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Loop = std::vector<Vec2>;

struct Line {
  Vec2 begin, end;

  [[nodiscard]] Vec2 along() const { return end - begin; }
  /// Position along the line, from 0 to 1, of the line's point nearest to p.
  [[nodiscard]] double shareOf(Vec2 p) const {
    return std::clamp(dot(p - begin, along()) / dot(along(), along()), 0., 1.);
  }
  [[nodiscard]] double distanceTo(Vec2 p) const { return norm(p - begin - shareOf(p) * along()); }
};

[[noreturn]] void refuse(std::size_t joint, const Line& line, const char* right) {
  throw InputError(fmt::format("joints[{}] from ({:g}, {:g}) to ({:g}, {:g}) {}.", joint,
                               line.begin.x, line.begin.y, line.end.x, line.end.y, right));
}

class Cutter {
 public:
  Cutter(const Polygon& polygon, const JointLines& joints, const SizeField& size) : size_(size) {
    loops_.push_back(&polygon.outline);
    for (const Loop& hole : polygon.holes) loops_.push_back(&hole);
    for (const Loop* loop : loops_)
      for (std::size_t i = 0; i < loop->size(); ++i) {
        cut_.points.push_back((*loop)[i]);
        edges_.push_back({(*loop)[i], (*loop)[(i + 1) % loop->size()]});
      }
    for (const auto& [begin, end] : joints) {
      if (!isFinite(begin) || !isFinite(end))
        refuse(joints_.size(), {begin, end}, "must have finite ends");
      if (begin == end) refuse(joints_.size(), {begin, end}, "must have two different ends");
      joints_.push_back({begin, end});
    }
  }

  CutLines cut() {
    const auto numVertices = static_cast<std::uint32_t>(cut_.points.size());
    for (const Line& joint : joints_) addPoint(joint.begin), addPoint(joint.end);
    for (std::size_t i = 0; i < joints_.size(); ++i) {
      for (const Line& edge : edges_) addCrossing(joints_[i], edge);
      for (std::size_t k = i + 1; k < joints_.size(); ++k) addCrossing(joints_[i], joints_[k]);
    }
    std::size_t edge = 0;
    std::uint32_t vertex = 0;
    for (const Loop* loop : loops_) {
      auto& corners = cut_.loops.emplace_back();
      for (std::uint32_t i = 0; i < loop->size(); ++i) {
        corners.push_back({vertex++, i});
        for (const std::uint32_t point : pointsOn(edges_[edge++], numVertices))
          corners.push_back({point, i});
      }
    }
    for (std::size_t i = 0; i < joints_.size(); ++i) addPieces(i);
    return std::move(cut_);
  }

 private:
  [[nodiscard]] double near(Vec2 p) const { return tolerance::kJointMeets * size_.at(p); }

  void addPoint(Vec2 p) {
    const double reach = near(p);
    const bool known = std::any_of(cut_.points.begin(), cut_.points.end(),
                                   [&](Vec2 other) { return norm(p - other) <= reach; });
    if (!known) cut_.points.push_back(p);
  }

  void addCrossing(const Line& a, const Line& b) {
    const double sine = cross(a.along(), b.along());
    if (sine == 0) return;  // parallel lines meet at the end of one of them
    const double share = cross(b.begin - a.begin, b.along()) / sine;
    const Vec2 p = a.begin + std::clamp(share, 0., 1.) * a.along();
    if (b.distanceTo(p) <= near(p)) addPoint(p);
  }

  /// The points on a line, from its begin to its end, out of the points with numbers from `first`
  /// on.
  [[nodiscard]] std::vector<std::uint32_t> pointsOn(const Line& line, std::uint32_t first) const {
    std::vector<std::uint32_t> found;
    for (std::uint32_t i = first; i < cut_.points.size(); ++i)
      if (line.distanceTo(cut_.points[i]) <= near(cut_.points[i])) found.push_back(i);
    std::sort(found.begin(), found.end(), [&](std::uint32_t a, std::uint32_t b) {
      return line.shareOf(cut_.points[a]) < line.shareOf(cut_.points[b]);
    });
    return found;
  }

  void addPieces(std::size_t joint) {
    const std::size_t before = cut_.pieces.size();
    const std::vector<std::uint32_t> on = pointsOn(joints_[joint], 0);
    bool isOnEarlier = false;
    for (std::size_t i = 1; i < on.size(); ++i) {
      const std::uint32_t a = on[i - 1], b = on[i];
      if (!isInside((cut_.points[a] + cut_.points[b]) * .5)) continue;
      if (taken_.insert(std::minmax(a, b)).second)
        cut_.pieces.push_back({{a, b}, static_cast<std::uint32_t>(joint)});
      else
        isOnEarlier = true;
    }
    if (cut_.pieces.size() == before && !isOnEarlier)
      refuse(joint, joints_[joint], "must run inside the outline");
  }

  /// True if p is inside and not on an edge.
  [[nodiscard]] bool isInside(Vec2 p) const {
    const double reach = near(p);
    if (std::any_of(edges_.begin(), edges_.end(),
                    [&](const Line& edge) { return edge.distanceTo(p) <= reach; }))
      return false;
    for (std::size_t i = 0; i < loops_.size(); ++i)
      if (surrounds(*loops_[i], p) != (i == 0)) return false;
    return true;
  }

  static bool surrounds(const Loop& loop, Vec2 p) {
    std::vector<Kernel::Point_2> points;
    points.reserve(loop.size());
    for (const Vec2 corner : loop) points.emplace_back(corner.x, corner.y);
    return CGAL::bounded_side_2(points.begin(), points.end(), Kernel::Point_2(p.x, p.y),
                                Kernel()) == CGAL::ON_BOUNDED_SIDE;
  }

  const SizeField& size_;
  std::vector<const Loop*> loops_;
  std::vector<Line> edges_, joints_;
  CutLines cut_;
  std::set<std::pair<std::uint32_t, std::uint32_t>> taken_;
};

}  // namespace

CutLines cutAtJoints(const Polygon& polygon, const JointLines& joints, const SizeField& size) {
  return Cutter(polygon, joints, size).cut();
}

}  // namespace yadefrag
