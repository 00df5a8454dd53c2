#pragma once
// The forces of all rows (paper §2, eq. 3–8): λ ≥ 0, g + Gλ ≥ 0, λ·(g + Gλ) = 0 for the normal
// forces, with G = Δt² W M⁻¹ Wᵀ; for the tangential ones |τ| ≤ μλ, and no slip if a smaller force
// is sufficient. (Slip forces −μ sgn(v)|λ| as in eq. 8 would make the system unsymmetric, and the
// sign must be known in advance.)
//
// Rows with common nodes are one group; after some sweeps of all, each group is solved alone
// (row_groups.cpp).
//
// Sweeps from row to row (nonlinear block Gauss–Seidel of Moreau and Jean's contact dynamics),
// without a matrix: each row uses the displacements of its nodes by the other rows so far. They
// start from the forces of the last step and stay near them: where rows are redundant or pieces
// jam, exact solutions have large forces that cancel each other, which friction converts into
// energy. A remaining gap is corrected in the next step.
//
// Sweeps alone need thousands of passes where both sides of a joint with different meshes are
// slaves, or along a high stack. Therefore conjugate gradients follow (row_gradients.cpp): they
// move all forces that are within their bounds, up to the first bound that one of them reaches. In
// rubble and in walls of blocks the next bound is near, therefore they are rare.

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "contact/contact_row.hpp"
#include "contact/coupled_forces.hpp"
#include "contact/inertia.hpp"
#include "core/csr.hpp"
#include "core/footprint.hpp"
#include "core/work_list.hpp"

namespace yadefrag {

class RowSweeps {
 public:
  /// Stop criterion: no gap or slip changes by more than `change` (m) in a sweep, or `most` sweeps
  /// of a group; more of them, up to kMostSweeps, while its forces are far from a solution.
  struct Stop {
    double change;
    int most;
  };
  /// Improves the forces of all rows, and those that are coupled to them; returns the largest
  /// change in the last sweep (m). The first rows may be those of former solutions since `clear`,
  /// with the nodes and the normals they had then: only their gaps are read, and they are visited
  /// if these have changed. The result is the same for any number of `threads`.
  double solve(std::span<ContactRow> rows, const Inertia& inertia, Stop stop,
               Coupling* coupling = nullptr, int threads = 1);
  /// Number of sweeps of the last solution: that of the group with most of them.
  [[nodiscard]] int sweeps() const { return count_; }
  /// Number of rows of the last solution.
  [[nodiscard]] std::size_t size() const { return rows_.size(); }
  /// Must be called before the first solution of a step.
  void clear();
  /// Reserves memory for this number of nodes of the model.
  void reserve(std::size_t nodes) { numbers_.reserve(nodes); }
  void addTo(Footprint& footprint, Use use) const {
    footprint.add(use, order_, groups_, rows_, ends_, turns_, nodes_, numbers_, moved_.nodes,
                  moved_.turns, shared_, links_, rowsOfNodes_.values, rowsOfNodes_.offsets, waits_,
                  attempts_, former_, residual_, perResidual_, direction_, response_, along_.nodes,
                  along_.turns);
    waiting_.addTo(footprint, use);
  }

 private:
  /// A row in the form for the sweeps: only the data that they read and write.
  struct SweepRow {
    std::array<double, 5> weight;
    Vec2 normal;
    double gap, slip, friction;
    double normalResponse, tangentResponse;  // m/N: change of gap and slip per force
    double slipPerNormal;                    // m/N: coupling, if a node is held in one direction
    double normalForce, tangentForce;        // N

    [[nodiscard]] Vec2 along() const { return {-normal.y, normal.x}; }
    [[nodiscard]] Vec2 force() const { return normalForce * normal + tangentForce * along(); }
  };
  static constexpr std::uint32_t kNone = 0xffffffff;
  /// Nodes of a row that its forces move, and the rigid body of the last of these, if that is one.
  struct Ends {
    std::array<std::uint32_t, 5> node;  // index among the nodes of all rows
    std::uint32_t count;
    std::uint32_t turn = kNone;  // index in turns_
  };
  /// Rotation of a rigid body in a row.
  struct Turn {
    Vec2 lever;        // m
    double perMoment;  // rad/(N m)
    std::uint32_t number;
  };
  struct Link {
    std::uint32_t node, row;
  };
  /// Displacement of a node, and that per force by axis: a visit of a row needs both.
  struct MovedNode {
    Vec2 shift;     // m
    Vec2 perForce;  // m/N
  };
  /// Displacements of nodes and rotations of rigid bodies (rad), by number.
  struct Motion {
    std::vector<MovedNode> nodes;
    std::vector<double> turns;  // empty without rigid bodies
  };
  /// Normal and tangential part of a row: of a gap and a slip (m), or of two forces (N).
  struct Pair {
    double normal = 0, tangent = 0;
  };
  /// Rows `begin` to `end`, which no other group's forces move.
  struct Group {
    std::uint32_t begin, end;
    std::size_t firstWaiting;  // number of the first row in waiting_, at the begin of a word
    int sweeps = 0;            // of this solution
    double change = 0;         // m, in the last sweep

    [[nodiscard]] std::uint32_t size() const { return end - begin; }
    [[nodiscard]] std::size_t waitingOf(std::uint32_t row) const {
      return firstWaiting + (row - begin);
    }
    [[nodiscard]] WorkList::Range words() const {
      const std::size_t first = firstWaiting / WorkList::kPerWord;
      return {first, first + WorkList::wordsFor(size())};
    }
  };
  /// When conjugate gradients are tried: sweeps of a group in former solutions of the step that
  /// divided the rows, between two attempts, and, with those of this solution, at the next one.
  struct Attempts {
    int former = 0, between = 0, next = 0;
  };

  void add(const ContactRow& row, const Inertia& inertia);
  void addEnd(SweepRow& swept, Ends& ends, NodeId number, double weight, const Inertia& inertia);
  void addRigid(SweepRow& swept, Ends& ends, const ContactRow::RigidPart& part,
                const Inertia& inertia);
  std::uint32_t numberOf(NodeId node, const Inertia& inertia);
  void update(std::span<const ContactRow> rows, double tolerance);
  void makeOneGroup();
  void divide();
  [[nodiscard]] Csr<std::uint32_t> findGroups() const;
  void findWaiting();
  void keepWaiting();
  void countSweeps();
  void pushAll();

  template <class Count>
  void push(const SweepRow& row, const Ends& ends, Count count, Vec2 force, Motion& motion) const;
  void push(const SweepRow& row, const Ends& ends, Vec2 force, Motion& motion) const;
  /// (m) Displacement of a row's slave relative to its master.
  template <class Count>
  [[nodiscard]] Vec2 relativeMotion(const SweepRow& row, const Ends& ends, Count count,
                                    const Motion& motion) const;
  template <class Count>
  double relax(SweepRow& row, const Ends& ends, Count count);
  double sweepAll(Stop stop, Coupling* coupling, int threads);
  double sweepGroups(int until, Stop stop, int threads);
  void sweepGroup(Group& group, int until, Stop stop);
  double sweep(const Group& group, bool forwards, double tolerance);
  void share(const Coupling* coupling, std::size_t modelNodes);
  double sweepCoupled(Coupling& coupling, double tolerance, bool last = false);

  void makeRoomForGradients();
  void descendIfDue(const Group& group, double tolerance);
  bool descend(const Group& group, double tolerance);
  double findResiduals(const Group& group);
  void turnDirection(const Group& group, double kept);
  double findResponses(const Group& group);
  [[nodiscard]] double scaledSquare(const Group& group) const;
  [[nodiscard]] double stepToBound(const Group& group) const;
  double advance(const Group& group, double step);

  std::vector<Group> groups_;  // one of all rows until they are divided
  bool isDivided_ = false;
  // By row, in the order of the groups.
  std::vector<SweepRow> rows_;
  std::vector<Ends> ends_;
  std::vector<std::uint32_t> order_;    // number of the row by its detection
  std::vector<std::uint8_t> waits_;     // 1: to be visited in the next sweep
  std::vector<Attempts> attempts_;      // by detection; of the group whose first row it is
  std::vector<Turn> turns_;             // of rows on rigid bodies
  std::vector<NodeId> nodes_;           // nodes and rigid bodies with a row
  std::vector<std::uint32_t> numbers_;  // by node: index in nodes_; valid for these only
  Motion moved_;                        // by the forces
  /// A node that coupled forces move, too.
  struct SharedNode {
    std::uint32_t number;
    NodeId node;
    Vec2 byOthers = {};   // m, part of the displacement
    Vec2 byContact = {};  // m, the rest, at the last sweep of the other forces
    Vec2 at = {};         // m, position then
    bool isKnown = false;
  };
  std::vector<SharedNode> shared_;
  std::vector<Link> links_;
  Csr<std::uint32_t> rowsOfNodes_;  // by number: numbers in waiting_
  WorkList waiting_;  // rows with a node that another row has moved by more than the tolerance
  int count_ = 0;     // sweeps of this solution
  // Of conjugate gradients, by row; 0 for forces at a bound. Empty before they are needed.
  std::vector<Pair> former_;       // N, forces at the begin
  std::vector<Pair> residual_;     // m, what is left of gap and slip, with the sign of a force
  std::vector<Pair> perResidual_;  // N/m, force that removes it in this row alone
  std::vector<Pair> direction_;    // N
  std::vector<Pair> response_;     // m, to the forces `direction_`
  Motion along_;                   // by these forces
};

template <class Count>
void RowSweeps::push(const SweepRow& row, const Ends& ends, Count count, Vec2 force,
                     Motion& motion) const {
  for (std::uint32_t k = 0; k < count; ++k) {
    MovedNode& node = motion.nodes[ends.node[k]];
    node.shift += row.weight[k] * Vec2{node.perForce.x * force.x, node.perForce.y * force.y};
  }
  if (ends.turn == kNone) return;
  const Turn& turn = turns_[ends.turn];
  motion.turns[turn.number] += turn.perMoment * cross(turn.lever, force);
}

inline void RowSweeps::push(const SweepRow& row, const Ends& ends, Vec2 force,
                            Motion& motion) const {
  push(row, ends, ends.count, force, motion);
}

template <class Count>
Vec2 RowSweeps::relativeMotion(const SweepRow& row, const Ends& ends, Count count,
                               const Motion& motion) const {
  Vec2 moved;
  for (std::uint32_t k = 0; k < count; ++k)
    moved += row.weight[k] * motion.nodes[ends.node[k]].shift;
  if (ends.turn == kNone) return moved;
  const Turn& turn = turns_[ends.turn];
  return moved + motion.turns[turn.number] * Vec2{-turn.lever.y, turn.lever.x};
}

}  // namespace yadefrag
