#pragma once
// Contact forces by sweeps from row to row (nonlinear block Gauss–Seidel of Moreau and Jean's
// contact dynamics), without a matrix: each row uses the displacements of its nodes by the other
// rows so far. Used in rubble, and for large groups with friction.
//
// In rubble and in dry stacks each row has common nodes with a dozen others, many rows are
// redundant, and each normal force changes a bound of friction. Exact solutions for given bounds
// then take a hundred times longer (36 blocks that touch exactly: 149 ms a step instead of 1.3).
// Where pieces jam, exact solutions also have large forces that cancel each other, which friction
// converts into energy. Sweeps that start from the forces of the last step stay near them; the
// remaining gap is corrected in the next step.

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
  /// Stop criterion: no gap or slip changes by more than `change` (m) in a sweep, or `most` sweeps.
  struct Stop {
    double change;
    int most;
  };
  /// Improves the forces of all rows, and those that are coupled to them; returns the largest
  /// change in the last sweep (m). Rows that were swept before (`swept`) have the nodes and the
  /// normal they had then: only their gaps are read, and they are visited if these have changed.
  double solve(std::span<ContactRow> rows, const Inertia& inertia, Stop stop,
               Coupling* coupling = nullptr);
  /// The same for the rows `members` only.
  double solve(std::span<ContactRow> rows, std::span<const std::uint32_t> members,
               const Inertia& inertia, Stop stop);
  /// Number of sweeps of the last solution.
  [[nodiscard]] int sweeps() const { return count_; }
  /// Reserves memory for this number of nodes of the model.
  void reserve(std::size_t nodes) { numbers_.reserve(nodes); }
  void addTo(Footprint& footprint, Use use) const {
    footprint.add(use, rows_, ends_, turns_, nodes_, numbers_, displacement_, rotation_, shared_,
                  links_, rowsOfNodes_.values, rowsOfNodes_.offsets);
    waiting_.addTo(footprint, use);
  }

 private:
  /// A row in the form for the sweeps: only the data that they read and write.
  struct SweepRow {
    std::array<double, 5> weight;
    std::array<Vec2, 5> perForce;  // m/N, by axis: displacement of the node per force
    Vec2 normal;
    double gap, slip, friction;
    double normalResponse, tangentResponse;  // m/N: change of gap and slip per force
    double slipPerNormal;                    // m/N: coupling, if a node is held in one direction
    double normalForce, tangentForce;        // N
    std::uint32_t place;                     // index among all rows
  };
  static constexpr std::uint32_t kNone = 0xffffffff;
  /// Nodes of a row, and the rigid body of the last of these, if that is one.
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

  void clear(std::size_t nodes);
  void add(const ContactRow& row, std::uint32_t place, const Inertia& inertia);
  void update(const ContactRow& row, std::uint32_t place, double tolerance);
  void pushAll();
  void addEnd(SweepRow& swept, Ends& ends, NodeId number, double weight, const Inertia& inertia);
  void addRigid(SweepRow& swept, Ends& ends, const ContactRow::RigidPart& part,
                const Inertia& inertia);
  std::uint32_t numberOf(NodeId node);
  template <class Count>
  void push(const SweepRow& row, const Ends& ends, Count count, Vec2 force);
  template <class Count>
  double relax(SweepRow& row, const Ends& ends, Count count);
  double finish(std::span<ContactRow> rows, Stop stop, Coupling* coupling);
  double sweep(bool forwards, double tolerance);
  void share(const Coupling* coupling, std::size_t modelNodes);
  double sweepCoupled(Coupling& coupling, double tolerance, bool last = false);
  void findRowsOfNodes();

  std::vector<SweepRow> rows_;
  std::vector<Ends> ends_;              // nodes of the rows
  std::vector<Turn> turns_;             // of rows on rigid bodies
  std::vector<NodeId> nodes_;           // nodes and rigid bodies with a row
  std::vector<std::uint32_t> numbers_;  // by node: index in nodes_; valid for these only
  std::vector<Vec2> displacement_;      // m, by number
  std::vector<double> rotation_;        // rad, by number; empty without rigid bodies
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
  Csr<std::uint32_t> rowsOfNodes_;  // by number
  WorkList waiting_;  // rows with a node that another row has moved by more than the tolerance
  int count_ = 0;
};

}  // namespace yadefrag
