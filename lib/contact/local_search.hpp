#pragma once
// From candidates to actives (paper §5): a scan of all candidates that leaves the few which are
// near, then, for each slave, the masters it is active on (joint_rules.hpp).

#include <cmath>
#include <cstdint>
#include <span>
#include <vector>

#include "contact/candidates.hpp"
#include "contact/joint_rules.hpp"
#include "contact/touch.hpp"
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

/// What entry by the path has to know of the step before.
struct PathStart {
  std::span<const Vec2> positions;  ///< m, xⁿ, by node; of surface nodes only
  std::span<const Touch> touches;   ///< by pair
  double depth;                     ///< m, at which a slave is behind a line
};

class LocalSearch {
 public:
  /// Null: entry by flags. Must outlive the next `findActives`.
  void startFrom(const PathStart* start) { start_ = start; }
  /// First phase (§5.1) at `positions` (m, by node). A candidate is near if its slave is inside the
  /// master's line or within `reach` (m) of it, beside the piece by no more than a few `reach`.
  /// Outside flags of all that are not near are brought up to date. No surface node has moved by
  /// more than `moved` (m) since the last scan: rows too far away to become near by all the ways
  /// since they were looked at are left alone. Infinite: nothing is known.
  void scan(Candidates& candidates, const ContactSurfaces& surfaces,
            std::span<const Vec2> positions, double reach, int threads, double moved = INFINITY);

  /// Second phase (§5.2, §5.3): the actives at `positions`, by slave, then master. None is deeper
  /// in a smooth master than `deepest` (m), whatever the halo is; but what is deeper than the halo
  /// at a search, as a penalty may leave it, is no candidate at all. Slaves `known`
  /// (ascending) to be active on all masters that they are near to are left out, and, if there is
  /// one, so are those of whom no node is in `moved` (flags by node), which were looked at before.
  void findActives(const Candidates& candidates, const ContactSurfaces& surfaces,
                   std::span<const Vec2> positions, double deepest, std::vector<Active>& actives,
                   std::span<const SlaveMaster> known = {},
                   std::span<const std::uint8_t> moved = {});

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
                        std::uint32_t row, ChordOf chordOfEntry, std::vector<Near>& found);
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
              std::span<const SlaveMaster> known, std::span<const std::uint8_t> moved);
  template <class Geometry>
  void tryRow(const Candidates& candidates, const ContactSurfaces& surfaces,
              const Geometry& geometry, std::span<const Near> row, double deepest);

  template <class Geometry>
  void tryRowByPath(const Candidates& candidates, const ContactSurfaces& surfaces,
                    const Geometry& geometry, std::span<const Near> row, double deepest);

  const PathStart* start_ = nullptr;
  double way_ = 0;    // m, of the fastest node since the candidates were found
  double reach_ = 0;  // m, of the last scan
  std::vector<Near> near_;
  std::vector<std::vector<Near>> nearByPart_;
  std::vector<Chord> chords_;  // by entry; empty where few are needed
  std::vector<Trial> trials_;
  JointRules rules_;
};

}  // namespace yadefrag
