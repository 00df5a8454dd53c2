#include "contact/local_search.hpp"

#include <algorithm>
#include <cmath>

#include "contact/slave_normals.hpp"
#include "core/parallel.hpp"
#include "core/tolerances/contact.hpp"

namespace yadefrag {

namespace {

/// A straight neighbour has to know on which side of the arc a slave was.
template <class Geometry>
bool isArcAmongArcs(const ContactSurfaces& surfaces, const Geometry& geometry, EntryId entry) {
  return geometry.isArc(entry) && geometry.isArc(surfaces.next[entry.value]) &&
         geometry.isArc(surfaces.prev[entry.value]);
}

/// Where a point lies beside the chord of a piece.
struct Beside {
  double gap;      ///< m
  double beyond;   ///< m, by how much it is past an end; negative: over the piece
  double inverse;  ///< 1/m, of the chord's length

  /// (m/m) Change of the gap, and of an arc's bulge, for a motion of all points by no more than 1,
  /// as long as the gap is open: beside its ends a chord swings farther than they move.
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
                       std::span<const Vec2> positions, double reach, int threads, double moved,
                       double deepest) {
  reach_ = reach;
  deepest_ = deepest;
  const std::size_t rows = candidates.slaves.size();
  way_ += moved;
  if (candidates.asleep.size() != rows || !std::isfinite(way_))
    candidates.asleep.assign(rows, 0), way_ = 0;
  near_.clear();
  nearByPart_.resize(static_cast<std::size_t>(std::max(threads, 1)));
  const int parts = withGeometry(surfaces, positions, [&](const auto& geometry) {
    findChords(candidates, surfaces, geometry, threads);
    return scanRows(candidates, geometry, reach, threads);
  });
  for (int part = 0; part < parts; ++part) {
    const auto& found = nearByPart_[static_cast<std::size_t>(part)];
    near_.insert(near_.end(), found.begin(), found.end());
  }
}

/// Returns in how many parts.
template <class Geometry>
int LocalSearch::scanRows(Candidates& candidates, const Geometry& geometry, double reach,
                          int threads) {
  const auto chord = [&](EntryId entry) {
    return chords_.empty() ? chordOf(geometry, entry) : chords_[entry.value];
  };
  return forEachPart(
      candidates.slaves.size(), threads, [&](std::size_t begin, std::size_t end, int part) {
        std::vector<Near>& found = nearByPart_[static_cast<std::size_t>(part)];
        found.clear();
        for (std::size_t r = begin; r < end; ++r) {
          if (candidates.asleep[r] > way_ + reach) continue;
          candidates.asleep[r] = way_ + scanRow(candidates, geometry, reach, deepest_,
                                                static_cast<std::uint32_t>(r), chord, found);
        }
      });
}

/// In rubble nearly every slave is awake, and every piece the master of several.
template <class Geometry>
void LocalSearch::findChords(const Candidates& candidates, const ContactSurfaces& surfaces,
                             const Geometry& geometry, int threads) {
  const auto isAwake = [&](double asleep) { return asleep <= way_ + reach_; };
  const auto awake = static_cast<std::size_t>(std::ranges::count_if(candidates.asleep, isAwake));
  chords_.resize(awake > surfaces.entries() / 4 ? surfaces.entries() : 0);
  forEachPart(chords_.size(), threads, [&](std::size_t begin, std::size_t end, int) {
    for (std::size_t e = begin; e < end; ++e) chords_[e] = chordOf(geometry, EntryId(e));
  });
}

template <class Geometry, class ChordOf>
double LocalSearch::scanRow(Candidates& candidates, const Geometry& geometry, double reach,
                            double deepest, std::uint32_t row, ChordOf chordOfEntry,
                            std::vector<Near>& found) {
  const Vec2 point = geometry.slave(candidates.slaves[row]);
  const bool flags = !candidates.outside.empty();
  double clear = INFINITY;
  for (std::uint32_t c = candidates.offsets[row]; c < candidates.offsets[row + 1]; ++c) {
    const EntryId master = candidates.masters[c];
    const Chord chord = chordOfEntry(master);
    const Beside beside = besideChord(chord, point);
    const double wide = reach + chord.bulge;
    const double aside = flags ? 4 * wide : 6 * (wide + deepest);
    if (beside.gap < wide && beside.gap > -wide - deepest && beside.beyond < aside)
      found.push_back({row, c});
    else if (flags)
      candidates.outside[c] = beside.gap >= 0 ? 1 : 0;
    const bool arc = geometry.isArc(master);
    // By flags, nothing comes of a straight master that the slave is behind of, until it has come
    // out; by the path, of any master that it is deeper in.
    const bool behind = flags ? !arc && candidates.outside[c] == 0 : beside.gap < -deepest;
    const double open =
        (behind ? std::abs(beside.gap) - (flags ? 0 : deepest) : beside.gap) - chord.bulge;
    clear = std::min(clear, open / beside.leverage(arc));
  }
  return clear;
}

void LocalSearch::findActives(const Candidates& candidates, const ContactSurfaces& surfaces,
                              std::span<const Vec2> positions, double deepest,
                              std::vector<Active>& actives, std::span<const SlaveMaster> known,
                              std::span<const std::uint8_t> moved, const PathStart* start) {
  withGeometry(surfaces, positions, [&](const auto& geometry) {
    tryAll(candidates, surfaces, geometry, deepest, actives, known, moved, start);
  });
}

template <class Geometry>
void LocalSearch::tryAll(const Candidates& candidates, const ContactSurfaces& surfaces,
                         const Geometry& geometry, double deepest, std::vector<Active>& actives,
                         std::span<const SlaveMaster> known, std::span<const std::uint8_t> moved,
                         const PathStart* start) {
  const std::span<const Near> near(near_);
  auto next = known.begin();
  for (std::size_t begin = 0, end = 0; begin < near.size(); begin = end) {
    const EntryId slave = candidates.slaves[near[begin].row];
    bool allKnown = true;
    for (; end < near.size() && near[end].row == near[begin].row; ++end) {
      const SlaveMaster pair{slave, candidates.masters[near[end].candidate]};
      while (next != known.end() && *next < pair) ++next;
      allKnown = allKnown && next != known.end() && *next == pair;
    }
    if (allKnown) continue;
    if (!moved.empty() && !hasMoved(candidates, surfaces, near.subspan(begin, end - begin), moved))
      continue;
    tryRow(candidates, surfaces, geometry, near.subspan(begin, end - begin), deepest, start);
    for (const Trial& trial : trials_)
      if (trial.active) actives.push_back({{slave, trial.master}, trial.foot});
  }
}

/// Has any node on which `tryRow` depends.
bool LocalSearch::hasMoved(const Candidates& candidates, const ContactSurfaces& surfaces,
                           std::span<const Near> row, std::span<const std::uint8_t> moved) {
  const auto of = [&](EntryId entry) {
    NodeId nodes[3];
    const int count = surfaces.pieceNodes(entry, nodes);
    return std::any_of(nodes, nodes + count, [&](NodeId n) { return moved[n.value] != 0; });
  };
  const EntryId slave = candidates.slaves[row.front().row];
  return of(slave) || of(surfaces.prev[slave.value]) ||
         std::ranges::any_of(
             row, [&](const Near& near) { return of(candidates.masters[near.candidate]); });
}

/// One slave and all masters that it is near to. Most slaves are outside all of them.
template <class Geometry>
void LocalSearch::tryRow(const Candidates& candidates, const ContactSurfaces& surfaces,
                         const Geometry& geometry, std::span<const Near> row, double deepest,
                         const PathStart* start) {
  trials_.clear();
  const EntryId slave = candidates.slaves[row.front().row];
  const Vec2 point = geometry.slave(slave);
  // Whatever the flags' rules do, they wake no master without a flag or an arc in the row.
  if (!start && std::ranges::none_of(row, [&](const Near& near) {
        return candidates.outside[near.candidate] != 0 ||
               geometry.isArc(candidates.masters[near.candidate]);
      }))
    return;
  if (std::ranges::none_of(row, [&](const Near& near) {
        const EntryId master = candidates.masters[near.candidate];
        return geometry.isArc(master) || geometry.mayPenetrate(master, point);
      }))
    return;
  takeTrials(candidates, surfaces, geometry, row);
  if (start)
    decideByPath(surfaces, geometry, *start, slave, trials_, deepest);
  else
    rules_.decide(surfaces, geometry, trials_, deepest, reach_);
}

/// None if the slave is inside no master that opposes it.
template <class Geometry>
void LocalSearch::takeTrials(const Candidates& candidates, const ContactSurfaces& surfaces,
                             const Geometry& geometry, std::span<const Near> row) {
  const EntryId slave = candidates.slaves[row.front().row];
  const Vec2 point = geometry.slave(slave);
  const bool flags = !candidates.outside.empty();
  const SlaveNormals normals = slaveNormals(surfaces, geometry, slave);
  bool anyInside = false;
  for (const Near& near : row) {
    const EntryId master = candidates.masters[near.candidate];
    Trial trial{master, {}, flags && candidates.outside[near.candidate] != 0, false, false};
    // The quick test spares the iteration.
    if (isArcAmongArcs(surfaces, geometry, master) && !geometry.mayPenetrate(master, point))
      continue;
    trial.foot = geometry.foot(master, point);
    trial.opposed = normals.oppose(trial.foot.normal);
    anyInside = anyInside || (trial.opposed && trial.foot.gap < 0);
    trials_.push_back(trial);
  }
  if (!anyInside) trials_.clear();
}

void LocalSearch::settle(Candidates& candidates, const ContactSurfaces& surfaces,
                         std::span<const Vec2> positions, std::span<const SlaveMaster> touched,
                         double left) const {
  withGeometry(surfaces, positions, [&](const auto& geometry) {
    auto next = touched.begin();
    for (const Near& near : near_) {
      const SlaveMaster pair{candidates.slaves[near.row], candidates.masters[near.candidate]};
      while (next != touched.end() && *next < pair) ++next;
      const bool active = next != touched.end() && *next == pair;
      std::uint8_t& outside = candidates.outside[near.candidate];
      const double least = outside != 0 ? -left : 0;
      const double gap = geometry.foot(pair.master, geometry.slave(pair.slave)).gap;
      outside = active || gap >= least ? 1 : 0;
    }
  });
}

}  // namespace yadefrag
