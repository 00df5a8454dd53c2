#include "contact/row_finder.hpp"

#include <algorithm>
#include <cmath>

namespace yadefrag {

std::vector<NearRow>& RowFinder::find(const Candidates& candidates, const ContactSurfaces& surfaces,
                                      const Positions& positions, const ContactSizes& sizes,
                                      int threads) {
  rowOf_.assign(surfaces.entries(), kNone);
  const std::size_t count = candidates.slaves.size();
  for (std::size_t r = 0; r < count; ++r)
    rowOf_[candidates.slaves[r].value] = static_cast<std::uint32_t>(r);
  parts_.resize(static_cast<std::size_t>(threadsFor(count, threads)));
  forEachPart(count, threads, [&](std::size_t begin, std::size_t end, int part) {
    PartList<NearRow>& found = parts_[static_cast<std::size_t>(part)];
    found.clear();
    Visit with{candidates,
               surfaces,
               {surfaces, positions.before},
               {surfaces, positions.now},
               sizes,
               {pieces_, sizes, found},
               {},
               {}};
    for (std::size_t r = begin; r < end; ++r) visit(r, with);
  });
  rows_.clear();
  if (parts_.size() == 1) {
    rows_.swap(parts_.front());
  } else {
    for (const auto& part : parts_) rows_.insert(rows_.end(), part.begin(), part.end());
  }
  return rows_;
}

/// One slave, with all of its masters.
void RowFinder::visit(std::size_t row, Visit& with) const {
  const Candidates& candidates = with.candidates;
  const EntryId slave = candidates.slaves[row];
  const Vec2 at = pieces_[slave].begin;
  const double wide = with.sizes.wide;
  // First which masters are near, without branches: most are not, in no order that a processor
  // could predict.
  const std::uint32_t begin = candidates.offsets[row], end = candidates.offsets[row + 1];
  if (with.near.size() < end - begin) with.near.resize(end - begin);
  std::size_t count = 0;
  for (std::uint32_t c = begin; c < end; ++c) {
    const EntryId master = candidates.masters[c];
    const MovingPiece& piece = pieces_[master];
    const Vec2 from = at - piece.begin;
    const double gap = std::abs(cross(piece.along, from)), half = .5 * piece.length;
    const double beside = std::abs(dot(from, piece.along) - half) - half;
    with.near[count] = master;
    count += static_cast<std::size_t>((gap <= wide) & (beside <= wide)) |
             static_cast<std::size_t>(piece.isArc);
  }
  with.seen.clear();
  for (std::size_t k = 0; k < count; ++k) {
    const EntryId master = with.near[k];
    if (pieces_[master].isArc != 0)
      with.rows.cornerAndArc(slave, master, with.before, with.now, with.surfaces);
    else
      visitStraight(slave, master, with);
  }
}

void RowFinder::visitStraight(EntryId slave, EntryId master, Visit& with) const {
  const MovingPiece& piece = pieces_[master];
  const Vec2 at = pieces_[slave].begin, from = at - piece.begin;
  const double along = dot(from, piece.along), gap = dot(from, piece.normal());
  // A little less than the masters that are near, so that both corners of a pair see each other.
  const double circle = tolerance::kInCircle * with.sizes.wide * with.sizes.wide;
  if (dot(from, from) < circle) meet(slave, master, with);
  const Vec2 fromEnd = at - pieces_[piece.next].begin;
  if (dot(fromEnd, fromEnd) < circle) meet(slave, piece.next, with);
  with.rows.cornerAndSide(slave, master, along, gap);
}

/// Two corners that are near each other: once for each such pair.
void RowFinder::meet(EntryId slave, EntryId corner, Visit& with) const {
  if (corner == slave || std::ranges::find(with.seen, corner) != with.seen.end()) return;
  with.seen.push_back(corner);
  if (slave < corner || !meets(corner, slave, with.candidates)) with.rows.corners(slave, corner);
}

/// True if a near corner is met when the slave is visited.
bool RowFinder::meets(EntryId slave, EntryId corner, const Candidates& candidates) const {
  const std::uint32_t row = rowOf_[slave.value];
  if (row == kNone) return false;
  const auto begin = candidates.masters.begin() + candidates.offsets[row];
  const auto end = candidates.masters.begin() + candidates.offsets[row + 1];
  const auto sees = [&](EntryId piece) {
    return pieces_[piece].isArc == 0 && std::binary_search(begin, end, piece);
  };
  return sees(corner) || sees(pieces_[corner].prev());
}

}  // namespace yadefrag
