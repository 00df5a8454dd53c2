#pragma once
// Contact of all surfaces within one step: local search, then the Lagrangian correction of
// positions and velocities, repeated while new penetrations occur.

#include <cstdint>
#include <span>
#include <vector>

#include "contact/candidates.hpp"
#include "contact/contact_row.hpp"
#include "contact/contact_settings.hpp"
#include "contact/coupled_forces.hpp"
#include "contact/inertia.hpp"
#include "contact/local_search.hpp"
#include "contact/pairs_of_slaves.hpp"
#include "contact/row_sweeps.hpp"
#include "contact/touch.hpp"
#include "core/stage_times.hpp"
#include "core/step_length.hpp"
#include "mesh/model.hpp"
#include "surface/contact_surface.hpp"

namespace yadefrag {

/// Data of the step for contact. Spans are by node.
struct ContactStep {
  StepLength length;
  double drag;                   ///< αΔt/2
  double move;                   ///< m, largest displacement of a surface node
  double reach;                  ///< m, twice the largest displacement of a surface node
  double shortest;               ///< m, shortest segment
  double deepest;                ///< m, maximum depth of contact with a smooth master
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
  void takeBack();

  /// After entries were renumbered: `numbers` by former number; none() of removed ones. Contacts
  /// are kept: a deep one would be lost otherwise.
  void renumber(std::span<const EntryId> numbers);
  /// Follows added nodes.
  void resize(std::size_t nodes);
  /// Reserves memory for this number of nodes.
  void reserve(std::size_t nodes);

  /// Deletes the contacts of removed pieces of surfaces; `correct` asserts that there are none.
  void removeGone(const ContactSurfaces& surfaces);

  /// Tolerates overlaps at `positions` (m, by node) of masters that approached their slaves by a
  /// change of shape: these overlaps are reduced over many steps, not in one.
  void allowOverlaps(const ContactSurfaces& surfaces, std::span<const Vec2> positions,
                     std::span<const EntryId> masters);

  /// In the order of their detection.
  [[nodiscard]] const std::vector<ContactRow>& rows() const { return rows_; }
  /// (N) By node, in the last step.
  [[nodiscard]] ContactForces forces() const { return ContactForces{forces_}; }
  /// (m) Largest correction of a node in the last step.
  [[nodiscard]] double largestCorrection() const { return now_.largestCorrection; }
  [[nodiscard]] double maxPenetration() const { return now_.maxPenetration; }
  /// Number of sweeps over the rows, in all detections of the last step.
  [[nodiscard]] int sweeps() const { return now_.sweeps; }

  Candidates candidates;
  std::vector<Touch> touches;  ///< by pair
  /// (m) Largest correction of the last step; the next step's first scan reaches farther than it.
  double lastCorrection = 0;

 private:
  /// Statistics of a step.
  struct Figures {
    double largestCorrection = 0;  // m
    double maxPenetration = 0;     // m
    int sweeps = 0;
  };

  void makeRoom(std::size_t nodes);
  void reset();
  void begin();
  void clearForces();
  void scan(const Model& model, const ContactSurfaces& surfaces, const ContactStep& step,
            double reach, double moved = 0);
  double solve(Model& model, const ContactStep& step);
  [[nodiscard]] double deepestTouch(const ContactSurfaces& surfaces,
                                    std::span<const Vec2> before) const;
  bool hasRow(const ContactSurfaces& surfaces, const PieceGeometry& before, SlaveMaster pair) const;
  static bool isThroughItself(const ContactSurfaces& surfaces, const PieceGeometry& before,
                              SlaveMaster pair, const ContactStep& step);
  void releaseOpposed(const Model& model, const ContactSurfaces& surfaces, std::size_t first);
  bool addRows(const Model& model, const ContactSurfaces& surfaces, const ContactStep& step);
  void joinRigid(ContactRow& row, const Nodes& nodes, const ContactStep& step);
  [[nodiscard]] bool isOfRigid(NodeId node, const ContactStep& step) const;
  void startRow(ContactRow& row, const Model& model, const PieceGeometry& before,
                const Touch* former, const ContactStep& step) const;
  [[nodiscard]] static double frictionOf(SlaveMaster pair, const Model& model,
                                         const ContactSurfaces& surfaces);
  [[nodiscard]] static bool isHeldByCohesion(const ContactRow& row, const CoupledForces* cohesion);
  [[nodiscard]] double slipOf(const ContactRow& row, const Model& model,
                              const ContactStep& step) const;
  void updateGaps(const Model& model, const ContactSurfaces& surfaces, const ContactStep& step);
  void move(Model& model, const ContactStep& step);
  void moveRigid(Model& model, const ContactStep& step, double& largest, double& farthest);
  [[nodiscard]] bool mayHaveEntered(const ContactStep& step) const;
  void rescan(const Model& model, const ContactSurfaces& surfaces, const ContactStep& step);
  void releaseUnsolved();
  void touch(NodeId node);
  void sumForces();
  void finish(Model& model, const ContactStep& step);

  double deepest_ = 0;  // m, of the touches at the begin of the step
  LocalSearch search_;
  RowSweeps sweeps_;
  std::vector<Active> actives_;
  std::vector<ContactRow> rows_;  // by detection, then by pair
  Figures now_;
  PairsOfSlaves pairs_;                  // of the rows
  std::vector<Vec2> forces_;             // N, by node
  std::vector<Vec2> displacement_;       // m, by node: the correction u so far
  std::vector<NodeId> touched_;          // nodes with a row
  std::vector<std::uint8_t> isTouched_;  // by node
  struct RigidLoad {
    Vec2 force = {};      // N
    double moment = 0;    // N m, about the centre of mass
    bool hasRow = false;  // the body moves with the correction
  };
  std::vector<RigidLoad> rigidLoads_;  // by rigid body
  double inexact_ = 0;                 // m, possible error of the sweeps
  double sinceScan_ = 0;               // m, upper bound of corrections since the last scan
  double sinceSearch_ = 0;             // m, the same since the last search for actives
  // Of the previous step, for `takeBack`; `touches` only after the step has set its own.
  std::vector<ContactRow> formerRows_;
  std::vector<Touch> formerTouches_;
  double formerCorrection_ = 0;  // m
  Figures former_;
  bool isFinished_ = false;
};

}  // namespace yadefrag
