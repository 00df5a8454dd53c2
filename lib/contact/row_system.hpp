#pragma once
// The rows of a solution, with only the data that it reads and writes, and the displacements that
// their forces cause: u = Δt² M⁻¹ Wᵀ λ (paper §2, eq. 5 to 7).

#include <array>
#include <cstdint>
#include <vector>

#include "contact/contact_row.hpp"
#include "contact/inertia.hpp"

namespace yadefrag {

/// Rows that are next to each other.
struct RowRange {
  std::uint32_t begin, end;
  [[nodiscard]] std::uint32_t size() const { return end - begin; }
};

struct RowSystem {
  struct Row {
    std::array<double, 5> weight;
    Vec2 normal;
    double gap, slip, friction;
    double normalResponse, tangentResponse;  ///< m/N: change of gap and slip per force
    double slipPerNormal;                    ///< m/N: coupling, if a node is held in one direction
    double normalForce, tangentForce;        ///< N

    [[nodiscard]] Vec2 along() const { return {-normal.y, normal.x}; }
    [[nodiscard]] Vec2 force() const { return normalForce * normal + tangentForce * along(); }
  };
  static constexpr std::uint32_t kNone = 0xffffffff;
  /// Nodes of a row that its forces move, and the rigid body of the last of these, if that is one.
  struct Ends {
    std::array<std::uint32_t, 5> node;  ///< index among the nodes of all rows
    std::uint32_t count;
    std::uint32_t turn = kNone;  ///< index in `turns`
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
  /// Displacements of nodes and rotations of rigid bodies (rad), by number.
  struct Motion {
    std::vector<MovedNode> nodes;
    std::vector<double> turns;  ///< empty without rigid bodies
  };

  void clear();
  void add(const ContactRow& row, const Inertia& inertia);
  /// Computes the displacements by the forces of all rows.
  void pushAll();
  /// Adds the displacements by a force (N) of a row to `motion`.
  template <class Count>
  void push(const Row& row, const Ends& of, Count count, Vec2 force, Motion& motion) const;
  void push(const Row& row, const Ends& of, Vec2 force, Motion& motion) const {
    push(row, of, of.count, force, motion);
  }
  /// (m) Displacement of a row's slave relative to its master.
  template <class Count>
  [[nodiscard]] Vec2 relativeMotion(const Row& row, const Ends& of, Count count,
                                    const Motion& motion) const;

  // By row.
  std::vector<Row> rows;
  std::vector<Ends> ends;
  std::vector<Turn> turns;             ///< of rows on rigid bodies
  std::vector<NodeId> nodes;           ///< nodes and rigid bodies with a row
  std::vector<std::uint32_t> numbers;  ///< by node: index in `nodes`; valid for these only
  Motion moved;                        ///< by the forces

 private:
  void addEnd(Row& row, Ends& of, NodeId number, double weight, const Inertia& inertia);
  void addRigid(Row& row, Ends& of, const ContactRow::RigidPart& part, const Inertia& inertia);
  std::uint32_t numberOf(NodeId node, const Inertia& inertia);
};

template <class Count>
void RowSystem::push(const Row& row, const Ends& of, Count count, Vec2 force,
                     Motion& motion) const {
  for (std::uint32_t k = 0; k < count; ++k) {
    MovedNode& node = motion.nodes[of.node[k]];
    node.shift += row.weight[k] * Vec2{node.perForce.x * force.x, node.perForce.y * force.y};
  }
  if (of.turn == kNone) return;
  const Turn& turn = turns[of.turn];
  motion.turns[turn.number] += turn.perMoment * cross(turn.lever, force);
}

template <class Count>
Vec2 RowSystem::relativeMotion(const Row& row, const Ends& of, Count count,
                               const Motion& motion) const {
  Vec2 relative;
  for (std::uint32_t k = 0; k < count; ++k)
    relative += row.weight[k] * motion.nodes[of.node[k]].shift;
  if (of.turn == kNone) return relative;
  const Turn& turn = turns[of.turn];
  return relative + motion.turns[turn.number] * Vec2{-turn.lever.y, turn.lever.x};
}

}  // namespace yadefrag
