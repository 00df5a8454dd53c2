#pragma once
// Just enough topology to try relinking: triangles whose interior edges crack.

#include <gtest/gtest.h>
#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>
#include <map>
#include <numeric>
#include <set>
#include <utility>
#include <vector>

#include "cut_mesh.hpp"
#include "mesh/triangle_mesh.hpp"
#include "surface/contact_surface.hpp"
#include "surface_checks.hpp"

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

/// One boundary side, its segment, and the entries on it up to the next segment's first.
inline void checkSide(const CutMesh& mesh, SegmentId segment, NodeId first, NodeId last) {
  const ContactSurfaces& s = mesh.surfaces;
  const SegmentId following = s.segmentNext[segment.value];
  ASSERT_TRUE(s.segmentNode[segment.value] == first && s.segmentNode[following.value] == last);
  ASSERT_TRUE(s.nodeSegment[first.value] == segment && s.nodeSegment[last.value] == following);
  ASSERT_EQ(s.segmentPrev[following.value], segment);
  ASSERT_EQ(s.segmentNext[s.segmentPrev[segment.value].value], segment);
  ASSERT_EQ(s.isSmooth(segment) ? 1 : 0, mesh.smooth[first.value]);
  ASSERT_TRUE(piecesFitEnds(s, segment));
  const PieceGeometry geometry(s, mesh.positions);
  EntryId entry = s.segmentEntry[segment.value];
  for (; s.entrySegment[entry.value] == segment; entry = s.next[entry.value]) {
    const EntryId next = s.next[entry.value];
    ASSERT_TRUE(s.prev[next.value] == entry && s.next[s.prev[entry.value].value] == entry);
    ASSERT_EQ(s.component[next.value], s.component[entry.value]);
    ASSERT_TRUE(mesh.loopsOf.contains({s.component[entry.value].value, s.loop[entry.value]}));
    const PieceRange range = pieceRange(s.piece[entry.value]);
    ASSERT_LT(norm(geometry.point(entry, range.begin) - geometry.slave(entry)), 1e-12);
    ASSERT_LT(norm(geometry.point(entry, range.end) - geometry.slave(next)), 1e-12);
  }
  ASSERT_EQ(entry, s.segmentEntry[following.value]);
}

inline std::size_t countCycles(const std::vector<std::size_t>& next) {
  std::vector<bool> seen(next.size());
  std::size_t cycles = 0;
  for (std::size_t i = 0; i < next.size(); ++i) {
    cycles += seen[i] ? 0 : 1;
    for (std::size_t k = i; !seen[k]; k = next[k]) seen[k] = true;
  }
  return cycles;
}

template <class IdType>
std::size_t countLists(const std::vector<IdType>& links) {
  std::vector<std::size_t> next;
  next.reserve(links.size());
  for (const IdType link : links) next.push_back(link.value);
  return countCycles(next);
}

/// Parts that are connected by edges.
inline std::size_t countPieces(const CutMesh& mesh) {
  std::vector<CutMesh::Row> top(mesh.triangles.size());
  std::iota(top.begin(), top.end(), 0);
  const auto find = [&](CutMesh::Row t) {
    while (top[t] != t) t = top[t] = top[top[t]];
    return t;
  };
  std::size_t pieces = top.size();
  mesh.forEachSide(0, [&](CutMesh::Side side) {
    if (mesh.isFace(side)) return;
    const CutMesh::Row a = find(side.triangle), b = find(mesh.at(mesh.across, side).triangle);
    pieces -= a != b ? 1 : 0;
    top[a] = b;
  });
  return pieces;
}

/// All laws, and that the boundary is the triangles' very own.
inline void checkMesh(const CutMesh& mesh) {
  const ContactSurfaces& s = mesh.surfaces;
  checkCrackedLinks(s);
  if (testing::Test::HasFatalFailure()) return;
  checkPiecesJoin(s);
  std::size_t faces = 0;
  mesh.forEachSide(0, [&](CutMesh::Side side) {
    if (!mesh.isFace(side) || testing::Test::HasFatalFailure()) return;
    ++faces;
    const SegmentId segment = mesh.at(mesh.segment, side);
    checkSide(mesh, segment, NodeId(mesh.from(side)), NodeId(mesh.to(side)));
    ASSERT_EQ(s.component[s.segmentEntry[segment.value].value], mesh.owner[side.triangle]);
  });
  if (testing::Test::HasFatalFailure()) return;
  ASSERT_EQ(faces, s.segments());
  // Euler: V − E + F = 2 − boundary lists, for each piece.
  const std::size_t lists = countLists(s.segmentNext);
  ASSERT_EQ(lists, countLists(s.next));
  const std::size_t edges = (3 * mesh.triangles.size() + faces) / 2;
  ASSERT_EQ(mesh.positions.size() + mesh.triangles.size() + lists, edges + 2 * countPieces(mesh));
}

/// Numbers are for ever: what may differ after a relinking is little.
inline void checkOnlyAppended(const ContactSurfaces& before, const ContactSurfaces& after,
                              std::span<const SurfaceSide> sides,
                              std::vector<EntryId> straightened) {
  std::sort(straightened.begin(), straightened.end());
  std::vector<EntryId> expected;
  for (std::size_t e = 0; e < before.entries(); ++e) {
    ASSERT_TRUE(before.entrySegment[e] == after.entrySegment[e] &&
                before.loop[e] == after.loop[e] && before.component[e] == after.component[e]);
    ASSERT_TRUE(before.piece[e] == after.piece[e] ||
                (before.piece[e] == Piece::kArc && after.piece[e] == Piece::kSecondHalf));
    if (before.piece[e] != after.piece[e]) expected.emplace_back(e);
    ASSERT_EQ(weights(before.slave(EntryId(e))).size(), weights(after.slave(EntryId(e))).size());
  }
  ASSERT_EQ(straightened, expected);
  for (std::size_t e = before.entries(); e < after.entries(); ++e) {
    const bool isOld = after.entrySegment[e].value < before.segments();
    ASSERT_EQ(after.piece[e], isOld ? Piece::kFirstHalf : Piece::kSegment);
  }
  std::vector<bool> listed(after.segments());
  for (const SurfaceSide& side : sides)
    if (side.segment != SegmentId::none()) listed[side.segment.value] = true;
  for (std::size_t i = 0; i < before.segments(); ++i) {
    if (listed[i]) continue;
    ASSERT_TRUE(before.segmentNode[i] == after.segmentNode[i] &&
                before.segmentEntry[i] == after.segmentEntry[i] &&
                before.isSmooth(SegmentId(i)) == after.isSmooth(SegmentId(i)) &&
                before.segmentNext[i] == after.segmentNext[i] &&
                before.segmentPrev[i] == after.segmentPrev[i]);
  }
}

}  // namespace yadefrag
