#pragma once
// Contact of all surfaces within one step: local search, then the Lagrangian correction of
// positions and velocities, repeated while anything newly penetrates.

#include <cstdint>
#include <span>
#include <vector>

#include "contact/candidates.hpp"
#include "contact/contact_row.hpp"
#include "contact/contact_settings.hpp"
#include "contact/correction.hpp"
#include "contact/local_search.hpp"
#include "contact/touch.hpp"
#include "core/stage_times.hpp"
#include "core/step_length.hpp"
#include "mesh/model.hpp"
#include "surface/contact_surface.hpp"

namespace yadefrag {

/// The step that contact is part of. Spans are by node.
struct ContactStep {
  StepLength length;
  double drag;                   ///< αΔt/2
  double move;                   ///< m, largest displacement of a surface node
  double reach;                  ///< m, twice the largest displacement of a surface node
  double shortest;               ///< m, shortest segment
  double deepest;                ///< m, a smooth master holds nothing deeper
  std::span<const Vec2> before;  ///< m, xⁿ; of surface nodes only
  int threads;
  bool rubble;                  ///< do faces of cracks take part
  StageTimes* times = nullptr;  ///< null: not measured
};

/// By node; 0 everywhere as long as nothing has ever touched, without an array that says so.
struct ContactForces {
  std::span<const Vec2> known;  ///< N; empty if nothing has ever touched

  Vec2 operator[](std::size_t node) const { return known.empty() ? Vec2{} : known[node]; }
  [[nodiscard]] auto begin() const { return known.begin(); }
  [[nodiscard]] auto end() const { return known.end(); }
};

class Contact {
 public:
  /// From the predicted x* and v* of `model` to xⁿ⁺¹ and vⁿ⁺½.
  void correct(Model& model, const ContactSurfaces& surfaces, const ContactSettings& settings,
               const ContactStep& step);
  /// Undoes the last `correct`, whether it came to its end or threw, but for positions and
  /// velocities. Needs no memory.
  void takeBack();

  /// After nodes or entries were renumbered or added: candidates and touches are void.
  void reset();
  /// After entries got new numbers, by former number; none() of those that are gone. What touched
  /// goes on to touch: contact that is deep, as a penalty leaves it, would be lost else.
  void renumber(std::span<const EntryId> numbers);
  /// After nodes were added.
  void resize(std::size_t nodes);
  /// Room for so many nodes.
  void reserve(std::size_t nodes);

  /// After pieces of surfaces are gone: nothing touches them any more.
  void removeGone(const ContactSurfaces& surfaces);

  /// Masters that came nearer to their slaves because they changed their form, and single pairs
  /// (ascending) that became outside, at `positions` (m, by node): what they overlap by is let out
  /// in time, not pushed out in one step.
  void allowOverlaps(const ContactSurfaces& surfaces, std::span<const Vec2> positions,
                     std::span<const EntryId> masters, std::span<const SlaveMaster> pairs);

  [[nodiscard]] const std::vector<ContactRow>& rows() const { return rows_; }
  /// (N) By node, of the last step.
  [[nodiscard]] ContactForces forces() const { return ContactForces{forces_}; }
  /// (m) Of a node, in the last step.
  [[nodiscard]] double largestCorrection() const { return now_.largestCorrection; }
  [[nodiscard]] double maxPenetration() const { return now_.maxPenetration; }
  /// Largest residual of the last step's systems, relative to their largest gap.
  [[nodiscard]] double residual() const { return now_.residual; }

  /// Sweeps over the rows of the largest swept group, in all detections of the last step.
  [[nodiscard]] int sweeps() const { return now_.sweeps; }

  void addTo(Footprint& footprint) const;

  Candidates candidates;
  std::vector<Touch> touches;  ///< by pair

 private:
  /// What a step says of itself.
  struct Figures {
    double largestCorrection = 0;  // m
    double maxPenetration = 0;     // m
    double residual = 0;
    int sweeps = 0;
  };

  void makeRoom(std::size_t nodes);
  void begin();
  void clearForces();
  void scan(const Model& model, const ContactSurfaces& surfaces, const ContactStep& step,
            double reach, double moved = 0);
  void solve(const Model& model, const ContactSettings& settings, const ContactStep& step,
             bool anyNew);
  [[nodiscard]] double deepestTouch(const ContactSurfaces& surfaces,
                                    std::span<const Vec2> before) const;
  template <class Test>
  [[nodiscard]] bool anyRowOf(EntryId slave, Test test) const;
  bool hasRow(const ContactSurfaces& surfaces, const PieceGeometry& before, SlaveMaster pair) const;
  bool isThroughItself(const ContactSurfaces& surfaces, const PieceGeometry& before,
                       SlaveMaster pair, const ContactStep& step) const;
  bool contradicts(const ContactSurfaces& surfaces, const ContactRow& row) const;
  bool addRows(const Model& model, const ContactSurfaces& surfaces, const ContactStep& step);
  void startRow(ContactRow& row, const Model& model, const ContactSurfaces& surfaces,
                const PieceGeometry& before, const Active& active, const ContactStep& step) const;
  void updateGaps(const Model& model, const ContactSurfaces& surfaces, const ContactStep& step);
  void move(Model& model, const ContactStep& step);
  void lookAgain(const Model& model, const ContactSurfaces& surfaces, const ContactStep& step);
  void releaseUnsolved();
  void touch(NodeId node);
  void sumForces();
  void finish(Model& model, const ContactSurfaces& surfaces, const ContactStep& step);

  Entry entry_ = Entry::kPath;
  double deepest_ = 0;  // m, of the touches at the step's start
  LocalSearch search_;
  Lagrange lagrange_;
  std::vector<Active> actives_;
  std::vector<ContactRow> rows_;  // by pair; within a detection its own come after the others
  std::size_t formerCount_ = 0;   // of the others
  Figures now_;
  std::vector<SlaveMaster> known_;       // of the rows
  std::vector<Vec2> forces_;             // N, by node
  std::vector<Vec2> displacement_;       // m, by node: the correction u so far
  std::vector<NodeId> touched_;          // nodes of a row
  std::vector<std::uint8_t> isTouched_;  // by node
  double inexact_ = 0;                   // m, by how much sweeps may be wrong
  double sinceScan_ = 0;                 // m, by no more have corrections moved a node since then
  // Of the step before, for `takeBack`; touches once the step has some of its own.
  std::vector<ContactRow> formerRows_;
  std::vector<Touch> formerTouches_;
  std::vector<std::uint8_t> formerOutside_;
  Figures former_;
  bool hasBegun_ = false, isFinished_ = false;
};

}  // namespace yadefrag
