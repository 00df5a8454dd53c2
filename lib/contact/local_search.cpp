#include "contact/local_search.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/parallel.hpp"
#include "core/tolerances/contact.hpp"

namespace yadefrag {

namespace {

/// True if no end of an arc is shared with a straight piece.
template <class Geometry>
bool isArcAmongArcs(const ContactSurfaces& surfaces, const Geometry& geometry, EntryId entry) {
  return geometry.isArc(entry) && geometry.isArc(surfaces.next[entry.value]) &&
         geometry.isArc(surfaces.prev[entry.value]);
}

/// Position of a point relative to the chord of a piece.
struct Beside {
  double gap;      ///< m
  double beyond;   ///< m, distance past an end; negative: over the piece
  double inverse;  ///< 1/m, inverse of the chord's length

  /// (m/m) Change of the gap, and of an arc's height, per largest displacement of all points, as
  /// long as the gap is open: beside its ends a chord moves more than its ends do.
  [[nodiscard]] double leverage(bool arc) const {
    return (arc ? 4 : 2) + 2 * (std::max(0., beyond) + std::abs(gap)) * inverse;
  }
};

Beside besideChord(const Chord& chord, Vec2 point) {
  const Vec2 along = chord.end - chord.begin;
  const Vec2 from = point - chord.begin;
  const double at = dot(along, from) * chord.inverse;
  const double past = dot(along, point - chord.end) * chord.inverse;
  return {cross(from, along) * chord.inverse, std::max(-at, past), chord.inverse};
}

template <class Geometry>
Chord chordOf(const Geometry& geometry, EntryId entry) {
  const PieceEnds ends = geometry.ends(entry);
  return {ends.begin, ends.end, 1 / norm(ends.end - ends.begin),
          geometry.isArc(entry) ? geometry.bulge(entry, ends) : 0};
}

}  // namespace

void LocalSearch::scan(Candidates& candidates, const ContactSurfaces& surfaces,
                       std::span<const Vec2> positions, const PathStart& start, double reach,
                       int threads, double moved) {
  start_ = start;
  reach_ = reach;
  threads_ = threads;
  const std::size_t rows = candidates.slaves.size();
  // Where slaves may be deeper than before, fewer are too deep to be near.
  way_ += moved + std::max(0., start.deepest - deepest_);
  deepest_ = std::max(deepest_, start.deepest);
  if (candidates.idleDistance.size() != rows || !std::isfinite(way_))
    candidates.idleDistance.assign(rows, 0), way_ = 0, deepest_ = start.deepest;
  near_.clear();
  triedAt_.clear();
  parts_.resize(static_cast<std::size_t>(std::max(threads, 1)));
  const int parts = withGeometry(surfaces, positions, [&](const auto& geometry) {
    findChords(candidates, surfaces, geometry);
    return forEachPart(rows, threads, [&](std::size_t begin, std::size_t end, int part) {
      scanRows(candidates, surfaces, geometry, begin, end, parts_[static_cast<std::size_t>(part)]);
    });
  });
  for (int part = 0; part < parts; ++part) {
    const auto& found = parts_[static_cast<std::size_t>(part)].near;
    near_.insert(near_.end(), found.begin(), found.end());
  }
}

template <class Geometry>
void LocalSearch::scanRows(Candidates& candidates, const ContactSurfaces& surfaces,
                           const Geometry& geometry, std::size_t begin, std::size_t end,
                           Part& part) const {
  const auto chord = [&](EntryId entry) {
    return chords_.empty() ? chordOf(geometry, entry) : chords_[entry.value];
  };
  const Geometry before(surfaces, start_.positions, pointsBefore_);
  part.near.clear();
  TouchCursor touches(start_.touches);
  for (std::size_t r = begin; r < end; ++r) {
    if (candidates.idleDistance[r] > way_ + reach_) continue;
    const std::size_t first = part.near.size();
    const auto row = static_cast<std::uint32_t>(r);
    candidates.idleDistance[r] = way_ + scanRow(candidates, geometry, row, chord, part.near);
    if (part.near.size() > first &&
        !findEnterable(candidates, before, touches.of(candidates.slaves[r]),
                       std::span(part.near).subspan(first)))
      part.near.resize(first);
  }
}

/// A slave that was behind a straight piece at xⁿ cannot enter it, unless it was in contact.
/// Returns true if it can enter any.
template <class Geometry>
bool LocalSearch::findEnterable(const Candidates& candidates, const Geometry& before,
                                std::span<const Touch> touches, std::span<Near> row) const {
  const EntryId slave = candidates.slaves[row.front().row];
  const Vec2 point = before.slave(slave);
  bool any = false;
  for (Near& near : row) {
    const EntryId master = candidates.masters[near.candidate];
    if (before.isArc(master)) {
      any = true;
      continue;
    }
    const PieceEnds ends = before.ends(master);
    const Vec2 along = ends.end - ends.begin;
    // Twice the depth, since the piece may be longer at the end of the step. If the piece rotates
    // in the step, a slave may leave and enter again by less than the product of two relative
    // displacements, each at most twice the reach.
    const double inside = cross(along, point - ends.begin) - 4 * reach_ * reach_;
    near.canEnter = inside <= 2 * start_.depth * norm(along) || touchOn(touches, master) != nullptr;
    any = any || near.canEnter;
  }
  return any;
}

/// Computes the chords of all pieces if many slaves must be checked: in rubble nearly all must be,
/// and each piece is the master of several.
template <class Geometry>
void LocalSearch::findChords(const Candidates& candidates, const ContactSurfaces& surfaces,
                             const Geometry& geometry) {
  const auto mustCheck = [&](double idleDistance) { return idleDistance <= way_ + reach_; };
  const auto checked =
      static_cast<std::size_t>(std::ranges::count_if(candidates.idleDistance, mustCheck));
  const std::size_t count = checked > surfaces.entries() / 4 ? surfaces.entries() : 0;
  chords_.resize(count);
  forEachPart(count, threads_, [&](std::size_t begin, std::size_t end, int) {
    for (std::size_t e = begin; e < end; ++e) chords_[e] = chordOf(geometry, EntryId(e));
  });
  findPoints(Geometry(surfaces, start_.positions), count, pointsBefore_);
}

template <class Geometry>
void LocalSearch::findPoints(const Geometry& geometry, std::size_t count,
                             std::vector<Vec2>& points) const {
  points.resize(count);
  forEachPart(count, threads_, [&](std::size_t begin, std::size_t end, int) {
    for (std::size_t e = begin; e < end; ++e) points[e] = geometry.slave(EntryId(e));
  });
}

template <class Geometry, class ChordOf>
double LocalSearch::scanRow(const Candidates& candidates, const Geometry& geometry,
                            std::uint32_t row, ChordOf chordOfEntry,
                            std::vector<Near>& found) const {
  const Vec2 point = geometry.slave(candidates.slaves[row]);
  const double deepest = start_.deepest;
  double clear = INFINITY;
  for (std::uint32_t c = candidates.offsets[row]; c < candidates.offsets[row + 1]; ++c) {
    const EntryId master = candidates.masters[c];
    const Chord chord = chordOfEntry(master);
    const Beside beside = besideChord(chord, point);
    const double wide = reach_ + chord.bulge;
    const double leverage = beside.leverage(geometry.isArc(master));
    const double before = beside.gap - chord.bulge;
    if (beside.gap < wide && beside.gap > -wide - deepest &&
        beside.beyond < tolerance::kBeside * (wide + deepest))
      found.push_back({row, c, true, (before - tolerance::kTouching / chord.inverse) / leverage});
    // A master in which the slave is deeper than any contact cannot become active.
    const bool behind = beside.gap < -deepest;
    const double open = behind ? std::abs(beside.gap) - deepest - chord.bulge : before;
    clear = std::min(clear, open / leverage);
  }
  return clear;
}

void LocalSearch::findActives(const Candidates& candidates, const ContactSurfaces& surfaces,
                              std::span<const Vec2> positions, double deepest,
                              std::vector<Active>& actives, const PairsOfSlaves& known,
                              double moved) {
  findMoved(surfaces, positions);
  const Query query{candidates, surfaces, deepest, known, moved, moved_};
  const int parts = withGeometry(surfaces, positions, [&]<class Geometry>(const Geometry& plain) {
    findPoints(plain, chords_.size(), points_);
    const Geometry geometry(surfaces, positions, points_);
    return forEachPart(near_.size(), threads_, [&](std::size_t begin, std::size_t end, int part) {
      tryRows(query, geometry, beginOfRow(begin), beginOfRow(end),
              parts_[static_cast<std::size_t>(part)]);
    });
  });
  for (int part = 0; part < parts; ++part) {
    const auto& found = parts_[static_cast<std::size_t>(part)].actives;
    actives.insert(actives.end(), found.begin(), found.end());
  }
}

/// Finds the entries whose geometry differs from that at the last detection.
void LocalSearch::findMoved(const ContactSurfaces& surfaces, std::span<const Vec2> positions) {
  moved_.clear();
  // Where only few slaves are near, all of them are tried: fewer than there are entries.
  if (chords_.empty()) return;
  const bool first = triedAt_.empty();
  triedAt_.resize(surfaces.entries());
  if (!first) moved_.resize(surfaces.entries());
  for (std::size_t e = 0; e < surfaces.entries(); ++e) {
    const SegmentId segment = surfaces.entrySegment[e];
    const Vec2 at = positions[surfaces.segmentNode[segment.value].value];
    if (std::exchange(triedAt_[e], at) == at || first) continue;
    // An arc has the nodes of three segments, and a corner the normals of both sides.
    const EntryId former = surfaces.prev[e];
    for (const EntryId entry : {EntryId(e), former, surfaces.next[e], surfaces.prev[former.value]})
      moved_[entry.value] = 1;
  }
}

bool LocalSearch::mustTry(const Query& query, std::span<const Near> row) const {
  const auto differs = [&](EntryId entry) { return query.mayDiffer[entry.value] != 0; };
  return query.mayDiffer.empty() || differs(query.slaveOf(row.front())) ||
         std::ranges::any_of(row, [&](const Near& near) {
           return differs(query.candidates.masters[near.candidate]);
         });
}

/// Index of the first near pair at or after this one that is the first of its slave.
std::size_t LocalSearch::beginOfRow(std::size_t at) const {
  while (at > 0 && at < near_.size() && near_[at].row == near_[at - 1].row) ++at;
  return at;
}

template <class Geometry>
void LocalSearch::tryRows(const Query& query, const Geometry& geometry, std::size_t from,
                          std::size_t to, Part& part) const {
  part.actives.clear();
  const std::span<const Near> near(near_);
  TouchCursor touches(start_.touches);
  for (std::size_t begin = from, end = from; begin < to; begin = end) {
    const EntryId slave = query.slaveOf(near[begin]);
    while (end < to && near[end].row == near[begin].row) ++end;
    part.trials.clear();
    const std::span<const Near> row = near.subspan(begin, end - begin);
    if (!mustTry(query, row)) continue;
    tryRow(query, geometry, touches.of(slave), row, part);
    for (const Trial& trial : part.trials)
      if (trial.active) part.actives.push_back({{slave, trial.master}, trial.foot});
  }
}

/// Most slaves are not behind the line of any master that they can cross.
template <class Geometry>
void LocalSearch::tryRow(const Query& query, const Geometry& geometry,
                         std::span<const Touch> touches, std::span<const Near> row,
                         Part& part) const {
  const EntryId slave = query.slaveOf(row.front());
  const Vec2 point = geometry.slave(slave);
  bool allKnown = true;
  const auto addTrials = [&](bool canEnter) {
    for (const Near& near : row) {
      if (near.canEnter != canEnter || near.clear > query.moved) continue;
      const EntryId master = query.candidates.masters[near.candidate];
      // The quick test of an arc does not cover points past an end that is shared with a straight
      // piece.
      const bool quick =
          !geometry.isArc(master) || isArcAmongArcs(query.surfaces, geometry, master);
      if (quick && !geometry.mayPenetrate(master, point)) continue;
      part.trials.push_back({master});
      allKnown = allKnown && query.known.contains({slave, master});
    }
  };
  addTrials(true);
  if (allKnown) return part.trials.clear();
  const Geometry before(query.surfaces, start_.positions, pointsBefore_);
  const SlaveStep<Geometry> step{before, geometry, slave, touches, start_.depth, start_.constants};
  if (!findEntered(query.surfaces, step, part.trials, query.deepest)) return part.trials.clear();
  addTrials(false);
  std::ranges::sort(part.trials, {}, &Trial::master);
  decideByPath(query.surfaces, step, part.trials);
}

}  // namespace yadefrag
