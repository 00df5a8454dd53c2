#pragma once
// The rows of a step, with only the data that its solution reads and writes, and the displacements
// that their forces cause: u = Δt² M⁻¹ Wᵀ λ (paper §2, eq. 5 to 7).

#include <array>
#include <cstdint>
#include <vector>

#include "contact/contact_row.hpp"
#include "contact/inertia.hpp"

namespace yadefrag {

struct RowSystem {
  static constexpr std::uint32_t kNone = 0xffffffff, kFew = 3;
  struct Row {
    std::array<double, 5> weight;
    Vec2 normal;
    double gap, slip;  ///< m, without the forces; the gap is that above the tolerated one
    double friction;
    double normalResponse, tangentResponse;  ///< m/N: change of gap and slip per force
    double slipPerNormal;                    ///< m/N: coupling, if a node is held in one direction
    double normalForce, tangentForce;        ///< N
    /// m/N: change of the next row's gap per normal force of this one, and the reverse, if both
    /// are solved together; else 0.
    double cross = 0;
    /// Those that the forces move: index in `nodes`. With less than three of them the first one
    /// fills the rest, with weight 0: most rows have three, and the loops a constant length.
    std::array<std::uint32_t, 5> node;
    std::uint32_t count = 0;
    /// Index in `turns` if the last node is a rigid body.
    std::uint32_t turn = kNone;

    [[nodiscard]] Vec2 along() const { return {-normal.y, normal.x}; }
    [[nodiscard]] Vec2 force() const { return normalForce * normal + tangentForce * along(); }
  };
  /// Rotation of a rigid body in a row.
  struct Turn {
    Vec2 lever;        ///< m
    double perMoment;  ///< rad/(N m)
    std::uint32_t number;
  };
  /// Displacement of a node, and that per force by axis: a visit of a row needs both.
  struct MovedNode {
    Vec2 shift;     ///< m
    Vec2 perForce;  ///< m/N
  };

  void clear();
  Row& add(const ContactRow& row, const Inertia& inertia);
  /// The last two rows are solved together.
  void linkLast();
  /// Computes the displacements by the forces of all rows.
  void pushAll();
  /// Adds the displacements by a force (N) of a row.
  void push(const Row& row, Vec2 force);
  /// (m) Displacement of a row's slave relative to its master.
  [[nodiscard]] Vec2 relativeMotion(const Row& row) const;
  /// (m) Displacement of a node; 0 without a row.
  [[nodiscard]] Vec2 shiftOf(NodeId node) const {
    const std::uint32_t number = node.value < numbers.size() ? numbers[node.value] : kNone;
    return number < nodes.size() && nodes[number] == node ? moved[number].shift : Vec2{};
  }

  std::vector<Row> rows;
  std::vector<Turn> turns;             ///< of rows on rigid bodies
  std::vector<NodeId> nodes;           ///< nodes and rigid bodies with a row
  std::vector<std::uint32_t> numbers;  ///< by node: index in `nodes`; valid for these only
  // By number: index in `nodes`.
  std::vector<MovedNode> moved;
  std::vector<double> turned;  ///< rad; empty without rigid bodies

 private:
  void addEnd(Row& row, NodeId number, double weight, const Inertia& inertia);
  void addRigid(Row& row, const ContactRow::RigidPart& part, const Inertia& inertia);
  std::uint32_t numberOf(NodeId node, const Inertia& inertia);
};

/// Calls `visit(number, weight)` for a row's nodes.
template <class Visit>
void forNodes(const RowSystem::Row& row, Visit visit) {
  for (std::uint32_t k = 0; k < RowSystem::kFew; ++k) visit(row.node[k], row.weight[k]);
  for (std::uint32_t k = RowSystem::kFew; k < row.count; ++k) visit(row.node[k], row.weight[k]);
}

inline void RowSystem::push(const Row& row, Vec2 force) {
  forNodes(row, [&](std::uint32_t number, double weight) {
    MovedNode& node = moved[number];
    node.shift += weight * Vec2{node.perForce.x * force.x, node.perForce.y * force.y};
  });
  if (row.turn == kNone) return;
  const Turn& turn = turns[row.turn];
  turned[turn.number] += turn.perMoment * cross(turn.lever, force);
}

inline Vec2 RowSystem::relativeMotion(const Row& row) const {
  Vec2 relative;
  forNodes(row,
           [&](std::uint32_t number, double weight) { relative += weight * moved[number].shift; });
  if (row.turn == kNone) return relative;
  const Turn& turn = turns[row.turn];
  return relative + turned[turn.number] * Vec2{-turn.lever.y, turn.lever.x};
}

}  // namespace yadefrag
