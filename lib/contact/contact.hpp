#pragma once
// Contact of all surfaces within one step: detection, then the Lagrangian correction of positions
// and velocities.

#include <cstdint>
#include <span>
#include <vector>

#include "contact/candidates.hpp"
#include "contact/contact_row.hpp"
#include "contact/inertia.hpp"
#include "contact/pass_rule.hpp"
#include "contact/row_finder.hpp"
#include "contact/row_sweeps.hpp"
#include "core/step_times.hpp"
#include "mesh/model.hpp"
#include "surface/contact_surface.hpp"

namespace yadefrag {

/// Data of the step for contact. Spans are by node.
struct ContactStep {
  StepLength length;
  double drag;                   ///< αΔt/2
  double move;                   ///< m, upper bound of the displacements of surface nodes
  double shortest;               ///< m, shortest segment
  std::span<const Vec2> before;  ///< m, xⁿ; of surface nodes only
  int threads;
  const RigidMasses& rigid;  ///< rigid boundaries that obey forces
  const tolerance::Contact& constants;
  StageTimes* times = nullptr;       ///< null: not measured
  CoupledForces* coupled = nullptr;  ///< cohesion; null: none
};

/// Forces by node; 0 everywhere before the first contact, without an allocated array.
struct ContactForces {
  std::span<const Vec2> known;  ///< N; empty before the first contact

  Vec2 operator[](std::size_t node) const { return known.empty() ? Vec2{} : known[node]; }
  [[nodiscard]] auto begin() const { return known.begin(); }
  [[nodiscard]] auto end() const { return known.end(); }
};

class Contact {
 public:
  /// From the predicted x* and v* of `model` to xⁿ⁺¹ and vⁿ⁺½.
  void correct(Model& model, const ContactSurfaces& surfaces, const ContactStep& step);
  /// Undoes the last `correct`, complete or ended by an exception, except for positions and
  /// velocities. Allocates no memory.
  void undo();

  /// After entries were renumbered: `numbers` by former number; none() of removed ones. Forces of
  /// contacts are kept.
  void renumber(std::span<const EntryId> numbers);
  /// Follows added nodes.
  void resize(std::size_t nodes);
  /// Reserves memory for this number of nodes.
  void reserve(std::size_t nodes);

  /// Deletes the contacts of removed pieces of surfaces; `correct` asserts that there are none.
  void removeGone(const ContactSurfaces& surfaces);

  /// Those that carry a force, in the order of their detection.
  [[nodiscard]] const std::vector<ContactRow>& rows() const { return rows_; }
  /// (N) By node, in the last step.
  [[nodiscard]] ContactForces forces() const { return ContactForces{forces_}; }
  /// (m) Bound of the correction of a node in the last step, with that of the coupled forces.
  [[nodiscard]] double largestCorrection() const { return now_.largestCorrection; }
  /// (m) The deepest penetration of a row that the last step has left.
  [[nodiscard]] double maxPenetration() const { return now_.maxPenetration; }
  /// Number of sweeps over the rows in the last step.
  [[nodiscard]] int sweeps() const { return now_.sweeps; }

  Candidates candidates;
  std::vector<StoredContact> touches;  ///< of the rows of the last step, in their order

 private:
  /// Statistics of a step.
  struct Figures {
    double largestCorrection = 0;  // m
    double maxPenetration = 0;     // m
    int sweeps = 0;
  };

  void makeRoom(std::size_t nodes);
  void reset();
  void begin(const ContactStep& step);
  void clearForces();
  void detect(const Model& model, const ContactSurfaces& surfaces, const ContactStep& step);
  void makeRows(const Model& model, const ContactSurfaces& surfaces, const ContactStep& step);
  void solve(Model& model, const ContactSurfaces& surfaces, const ContactStep& step);
  [[nodiscard]] double gapReached(const NearRow& near, const Nodes& nodes,
                                  const ContactSurfaces& surfaces) const;
  void measureGaps(const Nodes& nodes, const ContactSurfaces& surfaces, int threads);
  void keepRows(const Model& model, const ContactSurfaces& surfaces, const ContactStep& step);
  [[nodiscard]] ContactRow rowOf(const NearRow& near, const ContactSurfaces& surfaces,
                                 const Nodes& nodes, const ContactStep& step) const;
  void balanceFriction(NearRow& near, const RowSystem::Row& solved,
                       const PieceGeometry& before) const;
  [[nodiscard]] double toleratedGap(const RowSystem::Row& row, double before,
                                    const ContactStep& step) const;
  void findRigid(ContactRow& row, const Nodes& nodes, const ContactStep& step) const;
  [[nodiscard]] bool isOfRigid(NodeId node, const ContactStep& step) const;
  void measureFriction(const Model& model);
  [[nodiscard]] double frictionOf(SlaveMaster pair, const ContactSurfaces& surfaces) const;
  [[nodiscard]] static bool isHeldByCohesion(const ContactRow& row, const CoupledForces* cohesion);
  void indexTouches(std::size_t entries);
  [[nodiscard]] const StoredContact* storedContactOf(SlaveMaster pair) const;
  void move(Model& model, const ContactStep& step);
  void moveRigid(Model& model, const ContactStep& step, double& largest);
  void sumForces();
  void finish(const ContactStep& step);

  // m, bound of what each surface node has moved so far, undone steps included.
  double travelled_ = 0;
  double move_ = 0;  // m, largest displacement of a surface in this step, relative to the mean
  RowFinder finder_;
  RowSweeps sweeps_;
  std::vector<NearRow> near_;   // those of `sweeps_`
  std::vector<double> perRow_;  // m, scratch, of these
  std::vector<PartList<ContactRow>> rowParts_;
  PairsOfSlaves pairs_;           // of `touches`, at the begin of the step
  std::vector<double> friction_;  // by component
  std::vector<ContactRow> rows_;
  Figures now_;
  std::vector<Vec2> forces_;             // N, by node
  std::vector<NodeId> touched_;          // nodes with a row
  std::vector<std::uint8_t> isTouched_;  // by node
  struct RigidLoad {
    Vec2 force = {};      // N
    double moment = 0;    // N m, about the centre of mass
    bool hasRow = false;  // the body moves with the correction
  };
  std::vector<RigidLoad> rigidLoads_;  // by rigid body
  // Of the previous step, for `undo`; `touches` only after the step has set its own.
  std::vector<ContactRow> formerRows_;
  std::vector<StoredContact> formerTouches_;
  Figures former_;
  bool isFinished_ = false;
};

}  // namespace yadefrag
