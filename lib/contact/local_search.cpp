#include "contact/local_search.hpp"

#include <algorithm>
#include <cmath>

#include "core/parallel.hpp"
#include "core/tolerances.hpp"

namespace yadefrag {

namespace {

bool isArc(const ContactSurfaces& surfaces, EntryId entry) {
  return surfaces.piece[entry.value] == Piece::kArc;
}

/// A straight neighbour has to know on which side of the arc a slave was.
bool isArcAmongArcs(const ContactSurfaces& surfaces, EntryId entry) {
  return isArc(surfaces, entry) && isArc(surfaces, surfaces.next[entry.value]) &&
         isArc(surfaces, surfaces.prev[entry.value]);
}

/// Where a point lies beside the chord of a piece.
struct Beside {
  double gap;     ///< m
  double beyond;  ///< m, by how much it is past an end; negative: over the piece
};

Beside besideChord(const PieceEnds& ends, Vec2 point) {
  const Vec2 along = ends.end - ends.begin;
  const double length = norm(along);
  const Vec2 from = point - ends.begin;
  const double at = dot(along, from) / length;
  return {cross(from, along) / length, std::max(-at, at - length)};
}

/// How far an arc bulges over its chord: near an arc is near its chord by that much more.
double bulge(const ContactSurfaces& surfaces, std::span<const Vec2> positions, EntryId entry,
             const PieceEnds& ends) {
  if (!isArc(surfaces, entry)) return 0;
  NodeId nodes[3];
  surfaces.pieceNodes(entry, nodes);
  return norm(positions[nodes[1].value] - .5 * (ends.begin + ends.end));
}

/// The slave's outward normals, of the piece before it and of its own: a corner has two.
struct SlaveNormals {
  Vec2 before, after;
  [[nodiscard]] bool oppose(Vec2 normal) const {
    return std::min(dot(before, normal), dot(after, normal)) < tolerance::kOpposed;
  }
};

SlaveNormals slaveNormals(const ContactSurfaces& surfaces, const PieceGeometry& geometry,
                          EntryId slave) {
  const EntryId former = surfaces.prev[slave.value];
  return {geometry.normal(former, pieceRange(surfaces.piece[former.value]).end),
          geometry.normal(slave, pieceRange(surfaces.piece[slave.value]).begin)};
}

bool isOver(const ContactSurfaces& surfaces, EntryId master, const Foot& foot) {
  const PieceRange range = pieceRange(surfaces.piece[master.value]);
  return foot.xi >= range.begin - tolerance::kFootRange &&
         foot.xi <= range.end + tolerance::kFootRange;
}

bool isBehindEnd(const ContactSurfaces& surfaces, EntryId master, const Foot& foot) {
  return foot.xi > pieceRange(surfaces.piece[master.value]).end;
}
bool isBeforeBegin(const ContactSurfaces& surfaces, EntryId master, const Foot& foot) {
  return foot.xi < pieceRange(surfaces.piece[master.value]).begin;
}

}  // namespace

void LocalSearch::scan(Candidates& candidates, const ContactSurfaces& surfaces,
                       std::span<const Vec2> positions, double reach, int threads) {
  const PieceGeometry geometry(surfaces, positions);
  near_.clear();
  nearByPart_.resize(static_cast<std::size_t>(std::max(threads, 1)));
  const auto work = [&](std::size_t begin, std::size_t end, int part) {
    std::vector<Near>& found = nearByPart_[static_cast<std::size_t>(part)];
    found.clear();
    for (std::size_t r = begin; r < end; ++r) {
      const Vec2 point = geometry.slave(candidates.slaves[r]);
      for (std::uint32_t c = candidates.offsets[r]; c < candidates.offsets[r + 1]; ++c) {
        const EntryId master = candidates.masters[c];
        const PieceEnds ends = geometry.ends(master);
        const Beside beside = besideChord(ends, point);
        const double wide = reach + bulge(surfaces, positions, master, ends);
        if (beside.gap < wide && beside.beyond < 4 * wide)
          found.push_back({static_cast<std::uint32_t>(r), c});
        else
          candidates.outside[c] = beside.gap >= 0 ? 1 : 0;
      }
    }
  };
  const int parts = forEachPart(candidates.slaves.size(), threads, work);
  for (int part = 0; part < parts; ++part) {
    const auto& found = nearByPart_[static_cast<std::size_t>(part)];
    near_.insert(near_.end(), found.begin(), found.end());
  }
}

void LocalSearch::findActives(const Candidates& candidates, const ContactSurfaces& surfaces,
                              std::span<const Vec2> positions, double halo,
                              std::vector<Active>& actives) {
  const PieceGeometry geometry(surfaces, positions);
  const std::span<const Near> near(near_);
  for (std::size_t begin = 0, end = 0; begin < near.size(); begin = end) {
    while (end < near.size() && near[end].row == near[begin].row) ++end;
    tryRow(candidates, surfaces, geometry, near.subspan(begin, end - begin), halo);
    const EntryId slave = candidates.slaves[near[begin].row];
    for (const Trial& trial : trials_)
      if (trial.active) actives.push_back({{slave, trial.master}, trial.foot, trial.cameAside});
  }
}

/// One slave and all masters that it is near to.
void LocalSearch::tryRow(const Candidates& candidates, const ContactSurfaces& surfaces,
                         const PieceGeometry& geometry, std::span<const Near> row, double halo) {
  const EntryId slave = candidates.slaves[row.front().row];
  const Vec2 point = geometry.slave(slave);
  trials_.clear();
  bool anyInside = false;
  for (const Near& near : row) {
    const EntryId master = candidates.masters[near.candidate];
    Trial trial{master, {}, candidates.outside[near.candidate] != 0, false, false, false};
    // The quick test spares the iteration.
    if (isArcAmongArcs(surfaces, master) && !geometry.mayPenetrate(master, point)) continue;
    trial.foot = geometry.foot(master, point);
    anyInside = anyInside || trial.foot.gap < 0;
    trials_.push_back(trial);
  }
  if (!anyInside) {
    trials_.clear();
    return;
  }
  const SlaveNormals normals = slaveNormals(surfaces, geometry, slave);
  for (Trial& trial : trials_) trial.opposed = normals.oppose(trial.foot.normal);
  decide(surfaces, geometry, halo);
}

/// The outside-inside criterion (§5.1), then the exceptions where two masters meet (§5.2). A smooth
/// master needs no flag (§5.3): its normal always exists and is unique. But where a body folds up,
/// the normals of a tight arc reach far into it and out at the other side: a depth beyond the halo
/// is none.
void LocalSearch::decide(const ContactSurfaces& surfaces, const PieceGeometry& geometry,
                         double halo) {
  for (Trial& trial : trials_) {
    const bool arc = isArc(surfaces, trial.master);
    trial.active = trial.opposed && trial.foot.gap < 0 && (arc || trial.outside) &&
                   (!arc || trial.foot.gap >= -halo) && isOver(surfaces, trial.master, trial.foot);
  }
  for (Trial& first : trials_)
    for (Trial& second : trials_)
      if (surfaces.next[first.master.value] == second.master)
        decideNeighbours(surfaces, geometry, first, second);
}

/// `second` follows `first` on their surface.
void LocalSearch::decideNeighbours(const ContactSurfaces& surfaces, const PieceGeometry& geometry,
                                   Trial& first, Trial& second) {
  const PieceRange range = pieceRange(surfaces.piece[first.master.value]);
  const PieceRange rangeAfter = pieceRange(surfaces.piece[second.master.value]);
  const bool pastFirst = isBehindEnd(surfaces, first.master, first.foot);
  const bool pastSecond = isBeforeBegin(surfaces, second.master, second.foot);
  enterFromNeighbour(first, second, pastFirst, isOver(surfaces, second.master, second.foot));
  enterFromNeighbour(second, first, pastSecond, isOver(surfaces, first.master, first.foot));
  if (first.foot.gap >= 0 || second.foot.gap >= 0) return;
  const bool concave = cross(geometry.tangent(first.master, range.end),
                             geometry.tangent(second.master, rangeAfter.begin)) < 0;
  if (concave && pastFirst && pastSecond && (first.outside || second.outside)) {
    // No orthogonal correction is possible: to the corner, which both masters' rows together do.
    first.active = first.opposed, second.active = second.opposed;
  } else if (!concave && first.active && second.active) {
    const bool firstIsNearer = first.foot.gap >= second.foot.gap;
    (firstIsNearer ? second : first).active = false;
  }
}

/// A slave that was outside `from` is now inside `to`, whose flag says that it was behind its line
/// before: it came in past the end of `from`, along which it may have slid, or, a corner that
/// grazes a corner, through `from` itself, a lateral face that does not oppose it.
void LocalSearch::enterFromNeighbour(const Trial& from, Trial& to, bool pastFrom, bool overTo) {
  if (!from.outside || !overTo || !to.opposed || to.active || to.foot.gap >= 0) return;
  if (!pastFrom && (from.opposed || from.foot.gap >= 0)) return;
  to.active = true;
  to.cameAside = !pastFrom;
}

void LocalSearch::settle(Candidates& candidates, const ContactSurfaces& surfaces,
                         std::span<const Vec2> positions,
                         std::span<const SlaveMaster> touched) const {
  const PieceGeometry geometry(surfaces, positions);
  for (const Near& near : near_) {
    const SlaveMaster pair{candidates.slaves[near.row], candidates.masters[near.candidate]};
    const bool active = std::binary_search(touched.begin(), touched.end(), pair);
    candidates.outside[near.candidate] =
        active || geometry.foot(pair.master, geometry.slave(pair.slave)).gap >= 0 ? 1 : 0;
  }
}

}  // namespace yadefrag
