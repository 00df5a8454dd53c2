#include "meshing/mesh_stages.hpp"

#include <algorithm>
#include <cmath>
#include <deque>
#include <map>

#include "core/random_bits.hpp"
#include "core/tolerances/mesh.hpp"
#include "meshing/spacing_grid.hpp"

namespace yadefrag {
namespace {

const double kHeight = std::sqrt(.75);  // height of an equilateral triangle of side 1

/// A node of the advancing front: positions of new nodes are proposed around it.
struct Source {
  Vec2 position;
  Vec2 direction;      // unit vector along its row; not used for scattered nodes
  double spacing = 0;  // desired edge length here
};

double distanceToSegment(Vec2 p, Vec2 a, Vec2 b) {
  const Vec2 edge = b - a;
  const double t = std::clamp(dot(p - a, edge) / dot(edge, edge), 0., 1.);
  return norm(p - a - t * edge);
}

/// True if the line from p to q leaves the body through the edge a → b, which has the body on its
/// left. p may lie on the edge, up to rounding.
bool leaves(Vec2 p, Vec2 q, Vec2 a, Vec2 b) {
  const Vec2 edge = b - a;
  return cross(edge, q - a) < 0 && cross(edge, p - a) > -tolerance::kOnEdge * dot(edge, edge) &&
         (cross(q - p, a - p) > 0) != (cross(q - p, b - p) > 0);
}

class Front {
 public:
  Front(const DividedBoundary& boundary, const SizeField& size, MeshLayout layout)
      : boundary_(boundary),
        size_(size),
        isScattered_(layout.nodes == NodeLayout::kScattered),
        random_(layout.seed),
        nodeGrid_(size.largest()),
        edgeGrid_(size.largest()) {
    boundary_.forEachEdge([&](std::uint32_t a, std::uint32_t b) {
      after_.push_back(b);
      length_.push_back(norm(boundary_.nodes[b] - boundary_.nodes[a]));
    });
    low_ = high_ = boundaryNode(0);
    before_.resize(after_.size());
    for (std::uint32_t i = 0; i < after_.size(); ++i) before_[after_[i]] = i;
  }

  std::vector<Vec2> fill() {
    registerBoundary();
    if (isScattered_) {
      for (std::uint32_t i = 0; i < after_.size(); ++i)
        scatterFrom({boundaryNode(i), {}, spacingAt(i)});
      for (const Source& source : onJoints_) scatterFrom(source);
    } else {
      proposeFromEdges();
      proposeFromJoints();
      proposeFromNodes();
      for (const Source& source : onJoints_) proposeFrom(source);
    }
    while (!queue_.empty()) {
      auto& sources = queue_.begin()->second;
      const Source source = sources.front();
      sources.pop_front();
      if (sources.empty()) queue_.erase(queue_.begin());
      isScattered_ ? scatterFrom(source) : proposeFrom(source);
    }
    return std::move(inside_);
  }

 private:
  [[nodiscard]] Vec2 boundaryNode(std::uint32_t i) const { return boundary_.nodes[i]; }
  [[nodiscard]] double spacingAt(std::uint32_t i) const {
    return (length_[before_[i]] + length_[i]) / 2;
  }

  void registerBoundary() {
    for (std::uint32_t i = 0; i < after_.size(); ++i) {
      const Vec2 p = boundaryNode(i);
      low_ = {std::min(low_.x, p.x), std::min(low_.y, p.y)};
      high_ = {std::max(high_.x, p.x), std::max(high_.y, p.y)};
      nodes_.push_back(p);
      nodeGrid_.insert(nodes_.back(), spacingAt(i), i);
      edgeGrid_.insert((p + boundaryNode(after_[i])) * .5, length_[i], i);
    }
    registerJoints();
  }

  /// The nodes on joints are after those of the loops, and their sides after the loops' edges.
  void registerJoints() {
    const std::size_t first = after_.size();
    onJoints_.resize(boundary_.nodes.size() - first);
    std::vector<double> sides(onJoints_.size());
    for (std::uint32_t k = 0; k < boundary_.joints.size(); ++k) {
      const auto [a, b, joint] = boundary_.joints[k];
      const Vec2 along = boundaryNode(b) - boundaryNode(a);
      const double length = norm(along);
      edgeGrid_.insert((boundaryNode(a) + boundaryNode(b)) * .5, length,
                       static_cast<std::uint32_t>(first + k));
      for (const std::uint32_t node : {a, b}) {
        if (node < first) continue;
        Source& source = onJoints_[node - first];
        const double count = sides[node - first]++;
        source = {boundaryNode(node), along * (1 / length),
                  (count * source.spacing + length) / (count + 1)};
      }
    }
    for (std::uint32_t i = 0; i < onJoints_.size(); ++i) {
      nodes_.push_back(onJoints_[i].position);
      nodeGrid_.insert(nodes_.back(), onJoints_[i].spacing, static_cast<std::uint32_t>(first + i));
    }
  }

  /// Desired edge length at `there`, which has this distance from a point with desired length
  /// `spacing`.
  [[nodiscard]] double grown(double spacing, double distance, Vec2 there) const {
    const double change = tolerance::kEdgeGrowth * distance;
    return std::clamp(size_.at(there), spacing - change, spacing + change);
  }

  void proposeFromEdges() {
    for (std::uint32_t i = 0; i < after_.size(); ++i) {
      const Vec2 a = boundaryNode(i);
      const Vec2 along = (boundaryNode(after_[i]) - a) * (1 / length_[i]);
      const Vec2 middle = a + along * (length_[i] / 2);
      const double spacing = grown(length_[i], length_[i], middle);
      const double height = kHeight * (length_[i] + spacing) / 2;
      propose(middle, middle - rightOf(along) * height, along, spacing);
    }
  }

  /// Proposes nodes on both sides of each joint.
  void proposeFromJoints() {
    for (const auto& [a, b, joint] : boundary_.joints) {
      const Vec2 from = boundaryNode(a), edge = boundaryNode(b) - from;
      const double length = norm(edge);
      const Vec2 along = edge * (1 / length), middle = from + edge * .5;
      const double spacing = grown(length, length, middle);
      const Vec2 across = rightOf(along) * (kHeight * (length + spacing) / 2);
      propose(middle, middle - across, along, spacing);
      propose(middle, middle + across, along, spacing);
    }
  }

  /// Proposes fans of nodes at corners of more than 90°, where edges alone leave gaps.
  void proposeFromNodes() {
    for (std::uint32_t i = 0; i < after_.size(); ++i) {
      const Vec2 p = boundaryNode(i);
      const Vec2 in = boundaryNode(before_[i]) - p;
      const Vec2 out = boundaryNode(after_[i]) - p;
      double angle = std::atan2(cross(out, in), dot(out, in));
      if (angle <= 0) angle += 2 * M_PI;
      const int parts = static_cast<int>(std::lround(angle * 3 / M_PI));
      const double step = grown(spacingAt(i), spacingAt(i), p);
      for (int k = 1; k < parts; ++k) {
        const double turn = angle * k / parts;
        const Vec2 unit = out * (1 / norm(out));
        const Vec2 direction = unit * std::cos(turn) - rightOf(unit) * std::sin(turn);
        propose(p, p + direction * ((spacingAt(i) + step) / 2), direction, step);
      }
    }
  }

  void proposeFrom(const Source& source) {
    Vec2 direction = source.direction;
    const double spacing = grown(source.spacing, source.spacing, source.position);
    for (int k = 0; k < 6; ++k) {
      propose(source.position, source.position + direction * ((source.spacing + spacing) / 2),
              source.direction, spacing);
      direction = direction * .5 - rightOf(direction) * kHeight;
    }
  }

  /// Proposes random points at one to two radii from the source.
  void scatterFrom(const Source& source) {
    const double farthest = 2 * tolerance::kNodeClearance * source.spacing;
    for (int k = 0; k < tolerance::kNodeTries; ++k) {
      Vec2 way;
      do way = {random_.symmetric(), random_.symmetric()};
      while (dot(way, way) > 1 || dot(way, way) < .25);
      const Vec2 to = source.position + way * farthest;
      propose(source.position, to, {}, grown(source.spacing, norm(way) * farthest, to));
    }
  }

  void propose(Vec2 from, Vec2 to, Vec2 direction, double spacing) {
    if (to.x < low_.x || to.y < low_.y || to.x > high_.x || to.y > high_.y) return;
    const double clear = tolerance::kNodeClearance * spacing;
    if (nodeGrid_.any(to, spacing, clear, 0, [&](std::uint32_t i) {
          const Vec2 d = nodes_[i] - to;
          return dot(d, d) < clear * clear;
        }))
      return;
    if (edgeGrid_.any(to, spacing, norm(to - from), .5, [&](std::uint32_t i) {
          const bool isJoint = i >= after_.size();
          const Vec2 a = boundaryNode(isJoint ? boundary_.joints[i - after_.size()][0] : i);
          const Vec2 b = boundaryNode(isJoint ? boundary_.joints[i - after_.size()][1] : after_[i]);
          return distanceToSegment(to, a, b) < tolerance::kBoundaryClearance * spacing ||
                 (!isJoint && leaves(from, to, a, b));
        }))
      return;
    nodeGrid_.insert(to, spacing, static_cast<std::uint32_t>(nodes_.size()));
    nodes_.push_back(to);
    inside_.push_back(to);
    // Fine regions first: if a coarse front came first it would leave no room for fine nodes.
    const int octave = static_cast<int>(std::lround(2 * std::log2(spacing / size_.largest())));
    queue_[octave].push_back({to, direction, spacing});
  }

  const DividedBoundary& boundary_;
  const SizeField& size_;
  bool isScattered_;
  RandomSequence random_;
  Vec2 low_, high_;  // bounding box of the boundary; stops a front that leaves by rounding
  std::vector<std::uint32_t> after_, before_;  // boundary nodes
  std::vector<double> length_;    // length of the edge that starts at each boundary node
  std::vector<Source> onJoints_;  // nodes on joints
  std::vector<Vec2> nodes_;       // of the boundary, then those on joints, then those inside
  std::vector<Vec2> inside_;
  SpacingGrid nodeGrid_;
  SpacingGrid edgeGrid_;
  std::map<int, std::deque<Source>> queue_;
};

}  // namespace

std::vector<Vec2> fillInterior(const DividedBoundary& boundary, const SizeField& size,
                               MeshLayout layout) {
  return Front(boundary, size, layout).fill();
}

}  // namespace yadefrag
