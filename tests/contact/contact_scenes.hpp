#pragma once
// Surfaces of given points, and rows of contact.

#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <span>
#include <vector>

#include "contact/candidates.hpp"
#include "contact/row_sweeps.hpp"
#include "core/checks.hpp"
#include "mesh/shapes.hpp"
#include "surface/piece_geometry.hpp"

namespace yadefrag::test {

struct SurfaceScene {
  ContactSurfaces surfaces;
  std::vector<Vec2> at;  ///< m, by node
  std::uint32_t components = 0;

  /// A body of one loop (material on the left), smooth nodes only if given; its first entry.
  EntryId addBody(const std::vector<Vec2>& points, std::vector<std::uint8_t> smooth = {}) {
    const EntryId first(surfaces.entries());
    std::vector<NodeId> nodes;
    for (const Vec2 point : points) {
      nodes.emplace_back(at.size());
      at.push_back(point);
    }
    smooth.resize(points.size(), 0);
    surfaces.addLoop(nodes, smooth, ComponentId(std::size_t{components++}));
    return first;
  }

  [[nodiscard]] PieceGeometry geometry() const { return {surfaces, at}; }
};

inline EntryId operator+(EntryId entry, std::size_t by) { return EntryId(entry.value + by); }

/// Which nodes are smooth. 0: none, 1: all, 2: some.
inline constexpr int kSmoothKinds[] = {0, 1, 2};
inline std::vector<std::uint8_t> smoothFlags(Random& random, std::size_t count, int kind) {
  std::vector<std::uint8_t> smooth(count);
  for (std::uint8_t& flag : smooth)
    flag = static_cast<std::uint8_t>(kind == 2 ? random() % 2 : static_cast<std::uint64_t>(kind));
  return smooth;
}
/// Nodes of mass 1, free.
inline Nodes plainNodes(std::size_t count) {
  Nodes nodes;
  nodes.position.resize(count);
  nodes.velocity.resize(count);
  nodes.mass.assign(count, 1);
  nodes.held.assign(count, kFree);
  nodes.component.resize(count);
  return nodes;
}

inline constexpr double kDt = 1e-3;

/// (m) The last change. The rows have their forces then.
inline double solveRows(RowSweeps& sweeps, std::span<ContactRow> rows, const Inertia& inertia,
                        RowSweeps::Stop stop) {
  sweeps.clear();
  for (const ContactRow& row : rows) sweeps.add(row, inertia);
  const double change = sweeps.begin(stop, nullptr, nullptr);
  for (std::size_t r = 0; r < rows.size(); ++r) {
    rows[r].normalForce = sweeps.row(r).normalForce;
    rows[r].tangentForce = sweeps.row(r).tangentForce;
  }
  return change;
}

inline double solveAll(std::span<ContactRow> rows, const Nodes& nodes, double drag = 0,
                       RowSweeps::Stop stop = {1e-17, 10000}) {
  RowSweeps sweeps;
  return solveRows(sweeps, rows, {nodes, kDt, drag}, stop);
}

/// Node `slave` on the segment of nodes a and b at ξ.
inline ContactRow onSegment(std::size_t slave, std::size_t a, std::size_t b, double xi, double gap,
                            double friction = 0, double slip = 0) {
  ContactRow row;
  row.normal = {0, 1};
  row.gap = gap;
  row.friction = friction;
  row.slip = slip;
  row.add({{NodeId(slave), {}, {}}, {1, 0, 0}, 1}, 1);
  row.add({{NodeId(a), NodeId(b), {}}, {1 - xi, xi, 0}, 2}, -1);
  return row;
}

/// (m) What the rows' forces move a node by: u = Δt² F/[m(1+d)].
inline std::vector<Vec2> displacements(const std::vector<ContactRow>& rows, const Nodes& nodes,
                                       double drag = 0) {
  std::vector<Vec2> u(nodes.size());
  for (const ContactRow& row : rows)
    for (int k = 0; k < row.count; ++k) {
      const std::uint32_t n = row.node[k].value;
      const double rate = kDt * kDt / (nodes.mass[n] * (1 + drag));
      const Vec2 by = rate * row.weight[k] * row.force();
      if ((nodes.held[n] & kHeldX) == 0) u[n].x += by.x;
      if ((nodes.held[n] & kHeldY) == 0) u[n].y += by.y;
    }
  return u;
}

inline double gapAfter(const ContactRow& row, const std::vector<Vec2>& u) {
  return row.gap + dot(relative(row, u), row.normal);
}
inline double slipAfter(const ContactRow& row, const std::vector<Vec2>& u) {
  return row.slip + dot(relative(row, u), row.tangent());
}

/// Two faces of unequal meshes of `a` and `b` segments, all nodes of which are slaves.
inline std::vector<ContactRow> bothFaces(std::size_t a, std::size_t b) {
  std::vector<ContactRow> rows;
  const auto add = [&](std::size_t n, std::size_t others, std::size_t own, std::size_t other,
                       double normal) {
    for (std::size_t i = 0; i <= n; ++i) {
      const double at = double(i) / double(n) * double(others);
      const std::size_t k = std::min(others - 1, static_cast<std::size_t>(at));
      rows.push_back(onSegment(own + i, other + k, other + k + 1, at - double(k), 0));
      rows.back().normal = {0, normal};
    }
  };
  add(a, b, 0, a + 1, 1);
  add(b, a, a + 1, 0, -1);
  return rows;
}

}  // namespace yadefrag::test
