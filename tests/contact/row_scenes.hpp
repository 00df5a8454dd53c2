#pragma once
// Rows of nodes on segments, and what their forces do.

#include <cstddef>
#include <span>
#include <vector>

#include "contact/contact_scenes.hpp"
#include "contact/row_sweeps.hpp"

namespace yadefrag::test {

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
