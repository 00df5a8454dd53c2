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
// start from the forces of the last step and stay near them: where rows are redundant or
// fragments jam, exact solutions have large forces that cancel each other, which friction converts
// into energy. A remaining gap is corrected in the next step.
//
// Thousands of sweeps would be needed along a high stack, or where two bodies with different meshes
// touch along their sides and both are slaves. Therefore conjugate gradients follow
// (row_gradients.hpp): they change all forces that are within their bounds, until the first of them
// reaches a bound. In rubble and in walls of blocks the next bound is near; there they are tried
// rarely.

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "contact/contact_row.hpp"
#include "contact/coupled_forces.hpp"
#include "contact/inertia.hpp"
#include "contact/row_gradients.hpp"
#include "contact/row_system.hpp"
#include "core/csr.hpp"
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
  [[nodiscard]] std::size_t size() const { return system_.rows.size(); }
  /// Must be called before the first solution of a step.
  void clear();
  /// Reserves memory for this number of nodes of the model.
  void reserve(std::size_t nodes) { system_.numbers.reserve(nodes); }

 private:
  struct Link {
    std::uint32_t node, row;
  };
  /// Rows that no other group's forces move.
  struct Group : RowRange {
    std::size_t firstWaiting;  // number of the first row in waiting_, at the begin of a word
    int sweeps = 0;            // of this solution
    double change = 0;         // m, in the last sweep

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

  void update(std::span<const ContactRow> rows, double tolerance);
  void makeOneGroup();
  void divide();
  [[nodiscard]] Csr<std::uint32_t> findGroups() const;
  void findWaiting();
  void keepWaiting();
  void countSweeps();

  template <class Count>
  double relax(RowSystem::Row& row, const RowSystem::Ends& ends, Count count);
  double sweepAll(Stop stop, Coupling* coupling, int threads);
  double sweepGroups(int until, Stop stop, int threads);
  void sweepGroup(Group& group, int until, Stop stop);
  double sweep(const Group& group, bool forwards, double tolerance);
  void share(const Coupling* coupling, std::size_t modelNodes);
  double sweepCoupled(Coupling& coupling, double tolerance, bool last = false);

  void descendIfDue(const Group& group, double tolerance);
  bool descend(const Group& group, double tolerance);

  RowSystem system_;           // its rows are in the order of the groups
  std::vector<Group> groups_;  // one of all rows until they are divided
  bool isDivided_ = false;
  // By row.
  std::vector<std::uint32_t> order_;  // number of the row by its detection
  std::vector<std::uint8_t> waits_;   // 1: to be visited in the next sweep
  std::vector<Attempts> attempts_;    // by detection; of the group whose first row it is
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
  RowGradients gradients_;
};

}  // namespace yadefrag
