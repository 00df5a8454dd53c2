#pragma once
// Just enough topology to try relinking: triangles whose interior edges crack.

#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>
#include <map>
#include <set>
#include <utility>
#include <vector>

#include "mesh/triangle_mesh.hpp"
#include "surface/relink.hpp"

namespace yadefrag {

class CutMesh {
 public:
  using Row = std::uint32_t;
  static constexpr Row kOutside = std::numeric_limits<Row>::max();

  struct Side {
    Row triangle = kOutside;
    Row corner = 0;  ///< where it begins
    friend bool operator==(Side, Side) = default;
  };
  template <class T>
  using BySide = std::vector<std::array<T, 3>>;

  ContactSurfaces surfaces;
  std::vector<Vec2> positions;
  BySide<Row> triangles;
  BySide<Side> across;
  BySide<std::uint8_t> cracked;
  BySide<SegmentId> segment;              ///< none() inside
  std::vector<ComponentId> owner;         ///< by triangle
  std::vector<std::vector<Row>> fans;     ///< by node: its triangles, ascending
  std::vector<std::uint8_t> smooth;       ///< by node, as it should be
  std::set<std::pair<Row, Row>> loopsOf;  ///< component and loop, as they were made

  /// `isSmooth(node)` for its boundary nodes. Its loops are found from the triangles alone.
  template <class Smooth>
  void addBody(const TriangleMesh& mesh, ComponentId component, Smooth isSmooth) {
    const auto firstNode = static_cast<Row>(positions.size());
    const auto firstTriangle = static_cast<Row>(triangles.size());
    positions.insert(positions.end(), mesh.nodes.begin(), mesh.nodes.end());
    fans.resize(positions.size());
    smooth.resize(positions.size(), 0);
    std::map<std::pair<Row, Row>, Side> sides;
    for (const auto& corners : mesh.triangles) {
      const auto t = static_cast<Row>(triangles.size());
      triangles.push_back({firstNode + corners[0], firstNode + corners[1], firstNode + corners[2]});
      for (Row c = 0; c < 3; ++c) {
        fans[triangles[t][c]].push_back(t);
        sides[{from({t, c}), to({t, c})}] = {t, c};
      }
      owner.push_back(component);
    }
    across.resize(triangles.size());
    cracked.resize(triangles.size());
    segment.resize(triangles.size(), {SegmentId::none(), SegmentId::none(), SegmentId::none()});
    std::map<Row, Side> leaving;
    forEachSide(firstTriangle, [&](Side side) {
      const auto other = sides.find({to(side), from(side)});
      if (other != sides.end())
        at(across, side) = other->second;
      else
        leaving[from(side)] = side;
    });
    addLoops(leaving, component, isSmooth);
  }

  [[nodiscard]] Row from(Side side) const { return triangles[side.triangle][side.corner]; }
  [[nodiscard]] Row to(Side side) const { return triangles[side.triangle][(side.corner + 1) % 3]; }
  template <class T>
  static T& at(BySide<T>& values, Side side) {
    return values[side.triangle][side.corner];
  }
  template <class T>
  static const T& at(const BySide<T>& values, Side side) {
    return values[side.triangle][side.corner];
  }

  [[nodiscard]] bool isFace(Side side) const {
    const Side other = at(across, side);
    return other.triangle == kOutside || from(side) != to(other) || to(side) != from(other);
  }

  template <class Visit>
  void forEachSide(Row firstTriangle, Visit visit) const {
    for (Row t = firstTriangle; t < triangles.size(); ++t)
      for (Row c = 0; c < 3; ++c) visit(Side{t, c});
  }

  /// The side that runs from a to b.
  [[nodiscard]] Side sideAt(Vec2 a, Vec2 b) const {
    Side found;
    forEachSide(0, [&](Side side) {
      if (norm(positions[from(side)] - a) + norm(positions[to(side)] - b) < 1e-6) found = side;
    });
    return found;
  }

  /// Cracks edges, doubles nodes, and lists the input of `relink`. The new segments' numbers
  /// are foreseen.
  std::vector<SurfaceSide> crack(const std::vector<Side>& edges) {
    std::vector<Row> ends;
    for (const Side edge : edges) {
      at(cracked, edge) = at(cracked, at(across, edge)) = 1;
      ends.push_back(from(edge));
      ends.push_back(to(edge));
    }
    std::sort(ends.begin(), ends.end());
    ends.erase(std::unique(ends.begin(), ends.end()), ends.end());
    std::vector<Row> doubled;
    for (const Row node : ends) split(node, doubled);
    std::vector<SurfaceSide> listed;
    std::vector<Side> seen;
    std::size_t number = surfaces.segments();
    for (const Row node : doubled) {
      smooth[node] = 0;
      for (const Row t : fans[node])
        for (const Row c : {cornerOf(t, node), (cornerOf(t, node) + 2) % 3}) {
          const Side side{t, c};
          if (!isFace(side) || std::ranges::find(seen, side) != seen.end()) continue;
          seen.push_back(side);
          listed.push_back({at(segment, side), NodeId(from(side)), NodeId(to(side)), owner[t]});
          if (at(segment, side) == SegmentId::none()) at(segment, side) = SegmentId(number++);
        }
    }
    return listed;
  }

 private:
  template <class Smooth>
  void addLoops(std::map<Row, Side> leaving, ComponentId component, Smooth isSmooth) {
    while (!leaving.empty()) {
      std::vector<NodeId> nodes;
      std::vector<std::uint8_t> flags;
      std::vector<Side> sides;
      for (auto next = leaving.begin(); next != leaving.end();) {
        sides.push_back(next->second);
        nodes.emplace_back(next->first);
        smooth[next->first] = isSmooth(next->first) ? 1 : 0;
        flags.push_back(smooth[next->first]);
        leaving.erase(next);
        next = leaving.find(to(sides.back()));
      }
      loopsOf.insert({component.value, surfaces.addLoop(nodes, flags, component)});
      for (const Side side : sides) at(segment, side) = surfaces.nodeSegment[from(side)];
    }
  }

  [[nodiscard]] Row cornerOf(Row triangle, Row node) const {
    const auto& corners = triangles[triangle];
    return static_cast<Row>(std::ranges::find(corners, node) - corners.begin());
  }

  /// The part of a node's fan that is connected with a triangle.
  [[nodiscard]] std::vector<Row> groupOf(Row triangle, Row node) const {
    std::vector<Row> group{triangle};
    for (std::size_t i = 0; i < group.size(); ++i) {
      const Row corner = cornerOf(group[i], node);
      for (const Row c : {corner, (corner + 2) % 3}) {
        const Side side{group[i], c};
        const Row other = at(across, side).triangle;
        if (other != kOutside && !at(cracked, side) &&
            std::ranges::find(group, other) == group.end())
          group.push_back(other);
      }
    }
    std::sort(group.begin(), group.end());
    return group;
  }

  void split(Row node, std::vector<Row>& doubled) {
    std::vector<Row> rest = fans[node];
    bool first = true;
    while (!rest.empty()) {
      const std::vector<Row> group = groupOf(rest.front(), node);
      std::erase_if(rest, [&](Row t) { return std::ranges::find(group, t) != group.end(); });
      if (first && rest.empty()) return;
      const Row number = first ? node : static_cast<Row>(positions.size());
      doubled.push_back(number);
      if (!first) {
        positions.push_back(positions[node]);
        smooth.push_back(0);
        fans.emplace_back();
        for (const Row t : group) triangles[t][cornerOf(t, node)] = number;
      }
      fans[number] = group;
      first = false;
    }
  }
};

}  // namespace yadefrag
