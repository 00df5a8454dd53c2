#pragma once
// Joints that end at, cross, or nearly meet each other and the edges of a polygon, joined at common
// points.

#include <algorithm>
#include <cstdint>
#include <map>
#include <set>
#include <utility>
#include <vector>

#include "meshing/joint_lines.hpp"
#include "meshing/size_field.hpp"
#include "meshing/spacing_grid.hpp"

namespace yadefrag {

/// Points that are nearer than the tolerance become one. Each joint is a chain of points; a chain
/// that passes a point within the tolerance bends to it. Bent chains may pass other points and
/// cross other chains: that is repeated until nothing changes (iterated snap rounding, Halperin and
/// Packer 2002, Comput. Geom. 23, 209, with the given points instead of a grid).
class JointNetwork {
 public:
  struct Line {
    Vec2 begin, end;

    [[nodiscard]] Vec2 along() const { return end - begin; }
    /// Position along the line, from 0 to 1, of the foot of p; outside of that beyond the ends.
    [[nodiscard]] double footOf(Vec2 p) const {
      return dot(p - begin, along()) / dot(along(), along());
    }
    [[nodiscard]] Vec2 nearest(Vec2 p) const {
      return begin + std::clamp(footOf(p), 0., 1.) * along();
    }
    [[nodiscard]] double distanceTo(Vec2 p) const { return norm(p - nearest(p)); }
  };
  using Chain = std::vector<std::uint32_t>;

  /// `loops`: the outline, then the holes. `tolerance`: see cutAtJoints.
  JointNetwork(const std::vector<const std::vector<Vec2>*>& loops, const JointLines& joints,
               const SizeField& size, double tolerance);

  void join();

  /// Vertices of the loops come first.
  [[nodiscard]] const std::vector<Vec2>& points() const { return points_; }
  [[nodiscard]] const std::vector<Line>& edges() const { return edges_; }
  /// The points within each edge, in their order.
  [[nodiscard]] std::vector<Chain> pointsOnEdges() const;
  /// By joint; a chain of one point has vanished.
  [[nodiscard]] const std::vector<Chain>& chains() const { return chains_; }
  [[nodiscard]] const JoinedTraces& joined() const { return joined_; }

 private:
  /// A side of a chain or a part of an edge, from the smaller to the larger point.
  using Side = std::pair<std::uint32_t, std::uint32_t>;

  [[nodiscard]] double reachAt(Vec2 p) const;
  [[nodiscard]] Line lineOf(Side side) const { return {points_[side.first], points_[side.second]}; }
  std::uint32_t pointAt(Vec2 p);
  std::uint32_t newPoint(Vec2 p);
  void count(Vec2 p, std::uint32_t point);
  void addCrossings();
  void addCrossing(const Line& a, const Line& b);
  void startChains();
  [[nodiscard]] std::vector<Side> chainSides() const;
  [[nodiscard]] std::vector<Side> edgeSides() const;
  bool bend();
  void meet(Side a, Side b, bool isEdge);
  void pass(Side side, std::uint32_t point);
  bool applyInsertions();

  const SizeField& size_;
  double tolerance_;
  std::vector<Line> edges_, joints_;
  std::vector<Vec2> points_;
  std::vector<std::pair<std::uint32_t, std::uint32_t>> onEdge_;  // edge, point
  std::vector<Chain> chains_;
  SpacingGrid grid_;
  std::map<Side, std::set<std::uint32_t>> insertions_;
  JoinedTraces joined_;
  std::set<std::uint32_t> places_;  // points at which joints were joined
};

}  // namespace yadefrag
