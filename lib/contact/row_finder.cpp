#include "contact/row_finder.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace yadefrag {

namespace {

/// The least of all, as if they were of now.
Candidates::Distance leastOf(const Candidates& candidates, double travelled) {
  Candidates::Distance least{INFINITY, INFINITY, travelled};
  for (const std::uint32_t row : candidates.rows()) {
    const Candidates::Distance& one = candidates.distances[row];
    const double moved = travelled - one.when;
    least.far = std::min(least.far, one.far - 2 * moved);
    least.open = std::min(least.open, one.open - moved / tolerance::kOpenShare);
  }
  return least;
}

}  // namespace

/// True if the slave has no row in this step. `distance`: of a former one.
bool RowFinder::isQuiet(const Candidates::Distance& distance, const ContactSizes& sizes,
                        double travelled) {
  const double moved = travelled - distance.when;
  return !sizes.isFast && distance.far - 2 * moved > tolerance::kFar * sizes.wide &&
         tolerance::kOpenShare * distance.open - moved > sizes.closing;
}

bool RowFinder::mayFind(const Candidates& candidates, const ContactSizes& sizes, double travelled) {
  return candidates.distances.empty() || !isQuiet(candidates.nearest, sizes, travelled);
}

std::vector<NearRow>& RowFinder::find(Candidates& candidates, const ContactSurfaces& surfaces,
                                      const Positions& positions, const ContactSizes& sizes,
                                      double travelled, int threads) {
  const std::size_t count = candidates.rows().size();
  candidates.distances.resize(candidates.slaves.size());
  listInParts(count, threads, parts_, rows_, [&](std::size_t begin, std::size_t end, auto& found) {
    Visit with{candidates,
               surfaces,
               {surfaces, positions.before},
               {surfaces, positions.now},
               sizes,
               {pieces_, sizes, found},
               {},
               {},
               {}};
    for (std::size_t i = begin; i < end; ++i) {
      const std::uint32_t r = candidates.rows()[i];
      Candidates::Distance& distance = candidates.distances[r];
      const std::size_t former = found.size();
      if (isQuiet(distance, sizes, travelled)) {
        assert((visit(r, with), found.size() == former));
        continue;
      }
      visit(r, with);
      distance = {with.far, found.size() > former ? 0 : with.open, travelled};
    }
  });
  candidates.nearest =
      rows_.empty() ? leastOf(candidates, travelled) : Candidates::Distance{0, 0, travelled};
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
  const std::span<const EntryId> masters = candidates.mastersOfRow(row);
  if (with.near.size() < masters.size()) with.near.resize(masters.size());
  std::size_t count = 0;
  double far = INFINITY;
  for (const EntryId master : masters) {
    const MovingPiece& piece = pieces_[master];
    const double distance = piece.distance(at);
    const bool isNear = (distance <= wide) | static_cast<bool>(piece.isArc);
    with.near[count] = master;
    count += static_cast<std::size_t>(isNear);
    far = std::min(far, isNear ? INFINITY : distance);
  }
  with.seen.clear();
  with.far = far, with.open = tolerance::kMostOpen * with.sizes.shortest;
  for (std::size_t k = 0; k < count; ++k) {
    const EntryId master = with.near[k];
    if (pieces_[master].isArc != 0)
      visitArc(slave, master, with);
    else
      visitStraight(slave, master, with);
  }
}

void RowFinder::visitArc(EntryId slave, EntryId master, Visit& with) const {
  // A Bézier arc is no farther from its chord than half of what its middle node is.
  const double bulge = .5 * with.before.bulge(master, with.before.ends(master));
  const double distance = pieces_[master].distance(pieces_[slave].begin) - bulge;
  if (distance > tolerance::kFar * with.sizes.wide && !with.sizes.isFast) {
    with.far = std::min(with.far, distance);
    return;
  }
  with.open = 0;
  with.rows.cornerAndArc(slave, master, with.before, with.now, with.surfaces);
}

void RowFinder::visitStraight(EntryId slave, EntryId master, Visit& with) const {
  const MovingPiece& piece = pieces_[master];
  const Vec2 at = pieces_[slave].begin, from = at - piece.begin;
  const double along = dot(from, piece.along), gap = dot(from, piece.normal());
  meet(slave, master, from, with);
  meet(slave, piece.next, at - pieces_[piece.next].begin, with);
  with.open = std::min(with.open, with.rows.cornerAndSide(slave, master, along, gap));
}

/// Two corners, `from` (m) each other: once for each pair that is near.
void RowFinder::meet(EntryId slave, EntryId corner, Vec2 from, Visit& with) const {
  // A little less than the masters that are near, so that both corners of a pair see each other.
  const double circle = tolerance::kInCircle * with.sizes.wide * with.sizes.wide;
  const double square = dot(from, from);
  if (!(square < circle)) {
    with.far = std::min(with.far, std::sqrt(square));
    return;
  }
  if (corner == slave || std::ranges::find(with.seen, corner) != with.seen.end()) return;
  with.seen.push_back(corner);
  if (slave < corner || !meets(corner, slave, with.candidates))
    with.open = std::min(with.open, with.rows.corners(slave, corner));
}

/// True if a near corner is met when the slave is visited.
bool RowFinder::meets(EntryId slave, EntryId corner, const Candidates& candidates) const {
  const std::span<const EntryId> masters = candidates.mastersOf(slave);
  const auto sees = [&](EntryId piece) {
    return pieces_[piece].isArc == 0 && std::ranges::binary_search(masters, piece);
  };
  return sees(corner) || sees(pieces_[corner].prev());
}

}  // namespace yadefrag
