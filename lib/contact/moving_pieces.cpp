#include "contact/moving_pieces.hpp"

#include <algorithm>
#include <cmath>

#include "core/parallel.hpp"
#include "surface/piece_geometry.hpp"

namespace yadefrag {

void MovingPieces::update(const ContactSurfaces& surfaces, std::span<const Vec2> before,
                          std::span<const Vec2> now, int threads) {
  const std::size_t count = surfaces.entries();
  pieces_.resize(count), moved_.resize(count);
  const bool anySmooth = surfaces.anySmooth();
  const PieceGeometry start(surfaces, before), end(surfaces, now);
  forEachPart(count, threads, [&](std::size_t first, std::size_t last, int) {
    for (std::size_t e = first; e < last; ++e) {
      const EntryId entry(e);
      MovingPiece& piece = pieces_[e];
      piece.next = surfaces.next[e];
      piece.former = surfaces.prev[e].value & 0x7fffffffU;
      piece.isArc = surfaces.piece[e] == Piece::kArc ? 1 : 0;
      Vec2 next;
      if (anySmooth) {
        piece.begin = start.slave(entry), piece.moved = end.slave(entry) - piece.begin;
        next = start.slave(piece.next);
      } else {
        const NodeId node = surfaces.nodeOf(entry);
        piece.begin = before[node.value], piece.moved = now[node.value] - piece.begin;
        next = before[surfaces.nodeOf(piece.next).value];
      }
      moved_[e] = piece.moved;
      // In the same pass, although both ends are then read twice: memory limits the speed.
      const Vec2 chord = next - piece.begin;
      piece.length = norm(chord);
      piece.along = piece.length > 0 ? (1 / piece.length) * chord : Vec2{};
    }
  });
}

double MovingPieces::largestMove() const {
  // By the displacement itself: a part at rest has no weight, one that rounding moves hardly any.
  Vec2 sum;
  double weights = 0;
  for (const Vec2 moved : moved_) {
    const double weight = norm(moved);
    sum += weight * moved, weights += weight;
  }
  if (!(weights > 0)) return 0;
  const Vec2 mean = 1 / weights * sum;
  double most = 0;
  for (const Vec2 moved : moved_) most = std::max(most, dot(moved - mean, moved - mean));
  return std::sqrt(most);
}

}  // namespace yadefrag
