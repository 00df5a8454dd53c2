#include "meshing/joint_lines.hpp"

#include <fmt/core.h>

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_2_algorithms.h>

#include <algorithm>
#include <map>
#include <set>
#include <string>

#include "core/errors.hpp"
#include "core/tolerances/mesh.hpp"
#include "meshing/joint_network.hpp"

namespace yadefrag {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Loop = std::vector<Vec2>;

[[noreturn]] void refuse(std::size_t joint, const std::array<Vec2, 2>& line, const char* right) {
  throw InputError(fmt::format("joints[{}] from ({:g}, {:g}) to ({:g}, {:g}) {}.", joint, line[0].x,
                               line[0].y, line[1].x, line[1].y, right));
}

void check(const JointLines& joints) {
  for (std::size_t i = 0; i < joints.size(); ++i) {
    if (!isFinite(joints[i][0]) || !isFinite(joints[i][1]))
      refuse(i, joints[i], "must have finite ends");
    if (joints[i][0] == joints[i][1]) refuse(i, joints[i], "must have two different ends");
  }
}

class Cutter {
 public:
  Cutter(const Polygon& polygon, const JointLines& joints, const SizeField& size, double tolerance)
      : joints_(joints), size_(size) {
    loops_.push_back(&polygon.outline);
    for (const Loop& hole : polygon.holes) loops_.push_back(&hole);
    JointNetwork network(loops_, joints, size, tolerance);
    network.join();
    points_ = network.points();
    onEdges_ = network.pointsOnEdges();
    chains_ = network.chains();
    joined_ = network.joined();
    edges_ = network.edges();
  }

  CutLines cut() {
    CutLines result;
    std::size_t edge = 0;
    std::uint32_t vertex = 0;
    for (const Loop* loop : loops_) {
      auto& corners = result.loops.emplace_back();
      for (std::uint32_t i = 0; i < loop->size(); ++i) {
        corners.push_back({vertex++, i});
        for (const std::uint32_t point : onEdges_[edge]) corners.push_back({point, i});
        ++edge;
      }
    }
    for (std::size_t i = 0; i < joints_.size(); ++i) {
      requireInside(i);
      addPieces(result, i);
    }
    result.points = std::move(points_);
    result.joined = joined_;
    return result;
  }

 private:
  void addPieces(CutLines& result, std::size_t joint) {
    const std::vector<std::uint32_t>& chain = chains_[joint];
    for (std::size_t i = 1; i < chain.size(); ++i) {
      const std::uint32_t a = chain[i - 1], b = chain[i];
      if (!isInside((points_[a] + points_[b]) * .5)) continue;
      if (taken_.insert(std::minmax(a, b)).second)
        result.pieces.push_back({{a, b}, static_cast<std::uint32_t>(joint)});
    }
  }

  /// A joint inside may vanish in an earlier one, in an edge or in a point, to which it is joined.
  void requireInside(std::size_t joint) const {
    const JointNetwork::Line line{joints_[joint][0], joints_[joint][1]};
    std::vector<double> shares{0, 1};
    for (const JointNetwork::Line& edge : edges_) {
      const double sine = cross(line.along(), edge.along());
      if (sine != 0) shares.push_back(cross(edge.begin - line.begin, edge.along()) / sine);
    }
    std::sort(shares.begin(), shares.end());
    for (std::size_t i = 1; i < shares.size(); ++i) {
      const double middle = (shares[i - 1] + shares[i]) / 2;
      if (middle > 0 && middle < 1 && isInside(line.begin + middle * line.along())) return;
    }
    refuse(joint, joints_[joint], "must run inside the outline");
  }

  /// True if p is inside and not on an edge.
  [[nodiscard]] bool isInside(Vec2 p) const {
    const double reach = tolerance::kJointMeets * size_.at(p);
    if (std::any_of(edges_.begin(), edges_.end(),
                    [&](const JointNetwork::Line& edge) { return edge.distanceTo(p) <= reach; }))
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

  const JointLines& joints_;
  const SizeField& size_;
  std::vector<const Loop*> loops_;
  std::vector<Vec2> points_;
  std::vector<std::vector<std::uint32_t>> onEdges_, chains_;
  std::vector<JointNetwork::Line> edges_;
  JoinedTraces joined_;
  std::set<std::pair<std::uint32_t, std::uint32_t>> taken_;
};

}  // namespace

CutLines cutAtJoints(const Polygon& polygon, const JointLines& joints, const SizeField& size,
                     double tolerance) {
  check(joints);
  return Cutter(polygon, joints, size, tolerance).cut();
}

}  // namespace yadefrag
