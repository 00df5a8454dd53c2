#pragma once
// From candidates to actives (paper §5): a scan of all candidates selects the few near pairs; then,
// for each slave, the masters are determined on which it is active (path_rules.hpp).

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <span>
#include <vector>

#include "contact/candidates.hpp"
#include "contact/pairs_of_slaves.hpp"
#include "contact/path_rules.hpp"
#include "core/tolerances/threads.hpp"
#include "surface/piece_geometry.hpp"

namespace yadefrag {

/// A slave that penetrates a master at present, and its foot.
struct Active {
  SlaveMaster pair;
  Foot foot;
};

/// The chord of a piece at the positions of the scan.
struct Chord {
  Vec2 begin, end;
  double inverse;  ///< 1/m, inverse of its length
  double bulge;    ///< m, height of an arc over its chord: added to distances from the chord
};

class LocalSearch {
 public:
  /// First phase (§5.1) at `positions` (m, by node). A candidate is near if its slave is within
  /// `reach` (m) of the master's line, or inside it by no more than that plus the largest depth at
  /// the start, and beside the piece by no more than a few `reach`. `moved` (m): upper bound of the
  /// displacement of surface nodes since the last scan; infinite: unknown. Rows that cannot have
  /// become near by all displacements since their last check are skipped.
  void scan(Candidates& candidates, const ContactSurfaces& surfaces,
            std::span<const Vec2> positions, const PathStart& start, double reach, int threads,
            double moved = INFINITY);

  /// Second phase (§5.2, §5.3): the actives at `positions`, by slave, then master. Depths in a
  /// smooth master beyond `deepest` (m) are ignored, for any width of the halo. Excluded are slaves
  /// `known` to be active on all their near masters, and pairs that a displacement of
  /// at most `moved` (m) since the scan cannot have brought into penetration. After the first call
  /// for a scan, slaves may be excluded if neither they nor their near masters have moved since the
  /// last call.
  void findActives(const Candidates& candidates, const ContactSurfaces& surfaces,
                   std::span<const Vec2> positions, double deepest, std::vector<Active>& actives,
                   const PairsOfSlaves& known = {}, double moved = INFINITY);

  [[nodiscard]] bool anyNear() const { return !near_.empty(); }

 private:
  struct Near {
    std::uint32_t row;
    std::uint32_t candidate;
    bool canEnter;  ///< false: the slave was behind the piece at xⁿ, without contact
    double clear;   ///< m, displacement of all nodes up to which the slave is in front of the piece
  };
  /// The arguments of `findActives`.
  struct Query {
    const Candidates& candidates;
    const ContactSurfaces& surfaces;
    double deepest;
    const PairsOfSlaves& known;
    double moved;
    std::span<const std::uint8_t> mayDiffer;  ///< by entry; empty: all are tried
    [[nodiscard]] EntryId slaveOf(const Near& near) const { return candidates.slaves[near.row]; }
  };
  /// Results of one thread, and its memory.
  struct alignas(tolerance::kThreadsApart) Part {
    std::vector<Near> near;
    std::vector<Active> actives;
    std::vector<Trial> trials;
  };

  template <class Geometry>
  void findChords(const Candidates& candidates, const ContactSurfaces& surfaces,
                  const Geometry& geometry);
  template <class Geometry>
  void findPoints(const Geometry& geometry, std::size_t count, std::vector<Vec2>& points) const;
  template <class Geometry>
  void scanRows(Candidates& candidates, const ContactSurfaces& surfaces, const Geometry& geometry,
                std::size_t begin, std::size_t end, Part& part) const;
  /// Scans one slave; returns the displacement of all nodes before which it cannot be near.
  template <class Geometry, class ChordOf>
  double scanRow(const Candidates& candidates, const Geometry& geometry, std::uint32_t row,
                 ChordOf chordOfEntry, std::vector<Near>& found) const;
  template <class Geometry>
  bool findEnterable(const Candidates& candidates, const Geometry& before,
                     std::span<const Touch> touches, std::span<Near> row) const;
  void findMoved(const ContactSurfaces& surfaces, std::span<const Vec2> positions);
  [[nodiscard]] bool mustTry(const Query& query, std::span<const Near> row) const;
  [[nodiscard]] std::size_t beginOfRow(std::size_t at) const;
  template <class Geometry>
  void tryRows(const Query& query, const Geometry& geometry, std::size_t from, std::size_t to,
               Part& part) const;
  template <class Geometry>
  void tryRow(const Query& query, const Geometry& geometry, std::span<const Touch> touches,
              std::span<const Near> row, Part& part) const;

  double way_ = 0;      // m, distance travelled by the fastest node since the candidates were found
  double deepest_ = 0;  // m, largest of the scans since then
  double reach_ = 0;    // m, of the last scan
  PathStart start_;     // of the last scan
  std::vector<Near> near_;
  std::vector<Part> parts_;  // by thread
  int threads_ = 1;
  // By entry; empty if only few are needed. Points (m): the slaves', at xⁿ and at present.
  std::vector<Chord> chords_;
  std::vector<Vec2> pointsBefore_, points_;
  // By entry: position of its node (m) at the last detection, and 1 if the entry or a neighbour has
  // moved since then. The second is empty if all slaves are tried.
  std::vector<Vec2> triedAt_;
  std::vector<std::uint8_t> moved_;
};

}  // namespace yadefrag
