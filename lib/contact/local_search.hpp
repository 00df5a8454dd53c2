#pragma once
// From candidates to actives (paper §5): a scan of all candidates that leaves the few which are
// near, then, for each slave, the masters it is active on (joint_rules.hpp).

#include <cmath>
#include <cstdint>
#include <span>
#include <vector>

#include "contact/candidates.hpp"
#include "contact/joint_rules.hpp"
#include "contact/path_rules.hpp"
#include "surface/piece_geometry.hpp"

namespace yadefrag {

/// A slave that penetrates a master now, and where.
struct Active {
  SlaveMaster pair;
  Foot foot;
};

/// The chord of a piece at the scan's positions.
struct Chord {
  Vec2 begin, end;
  double inverse;  ///< 1/m, of its length
  double bulge;    ///< m, of an arc over it: near an arc is near its chord by that much more
};

class LocalSearch {
 public:
  /// First phase (§5.1) at `positions` (m, by node). A candidate is near if its slave is within
  /// `reach` (m) of the master's line, or inside it by no more than `deepest` (m) and `reach`, and
  /// beside the piece by no more than a few `reach`. With flags, depth is no bound, and those of
  /// all that are not near are brought up to date. No surface node has moved by more than `moved`
  /// (m) since the last scan: rows too far away to become near by all the ways since they were
  /// looked at are left alone. Infinite: nothing is known.
  void scan(Candidates& candidates, const ContactSurfaces& surfaces,
            std::span<const Vec2> positions, double reach, int threads, double moved = INFINITY,
            double deepest = INFINITY);

  /// Second phase (§5.2, §5.3): the actives at `positions`, by slave, then master. None is deeper
  /// in a smooth master than `deepest` (m), whatever the halo is; but what is deeper than the halo
  /// at a search, as a penalty may leave it, is no candidate at all. Slaves `known`
  /// (ascending) to be active on all masters that they are near to are left out, and, if there is
  /// one, so are those of whom no node is in `moved` (flags by node), which were looked at before.
  /// Entry is by the path from `start`, or by the candidates' flags without one.
  void findActives(const Candidates& candidates, const ContactSurfaces& surfaces,
                   std::span<const Vec2> positions, double deepest, std::vector<Active>& actives,
                   std::span<const SlaveMaster> known = {},
                   std::span<const std::uint8_t> moved = {}, const PathStart* start = nullptr);

  /// Outside flags of the near ones after the step, in which `touched` (ascending) were active:
  /// those stay outside, however rounding has placed them, and so do those that were outside and
  /// are inside by no more than `left` (m).
  void settle(Candidates& candidates, const ContactSurfaces& surfaces,
              std::span<const Vec2> positions, std::span<const SlaveMaster> touched,
              double left = 0) const;

  [[nodiscard]] bool anyNear() const { return !near_.empty(); }
  void addTo(Footprint& footprint) const {
    footprint.add(Use::kSearch, near_, nearByPart_, chords_, trials_);
    rules_.addTo(footprint);
  }

 private:
  struct Near {
    std::uint32_t row;
    std::uint32_t candidate;
  };
  /// What `scan` does with one slave; returns how far everything may move before it is near.
  template <class Geometry, class ChordOf>
  static double scanRow(Candidates& candidates, const Geometry& geometry, double reach,
                        double deepest, std::uint32_t row, ChordOf chordOfEntry,
                        std::vector<Near>& found);
  template <class Geometry>
  int scanRows(Candidates& candidates, const Geometry& geometry, double reach, int threads);
  template <class Geometry>
  void findChords(const Candidates& candidates, const ContactSurfaces& surfaces,
                  const Geometry& geometry, int threads);
  static bool hasMoved(const Candidates& candidates, const ContactSurfaces& surfaces,
                       std::span<const Near> row, std::span<const std::uint8_t> moved);

  template <class Geometry>
  void tryAll(const Candidates& candidates, const ContactSurfaces& surfaces,
              const Geometry& geometry, double deepest, std::vector<Active>& actives,
              std::span<const SlaveMaster> known, std::span<const std::uint8_t> moved,
              const PathStart* start);
  template <class Geometry>
  void tryRow(const Candidates& candidates, const ContactSurfaces& surfaces,
              const Geometry& geometry, std::span<const Near> row, double deepest,
              const PathStart* start);
  template <class Geometry>
  void takeTrials(const Candidates& candidates, const ContactSurfaces& surfaces,
                  const Geometry& geometry, std::span<const Near> row);

  double way_ = 0;      // m, of the fastest node since the candidates were found
  double reach_ = 0;    // m, of the last scan
  double deepest_ = 0;  // m, of the last scan
  std::vector<Near> near_;
  std::vector<std::vector<Near>> nearByPart_;
  std::vector<Chord> chords_;  // by entry; empty where few are needed
  std::vector<Trial> trials_;
  JointRules rules_;
};

}  // namespace yadefrag
