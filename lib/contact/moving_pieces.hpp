#pragma once
// The pieces of all boundaries in one step, as detection reads them: positions at xⁿ and
// displacements to x*, the positions without contact.

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <span>
#include <vector>

#include "core/ids.hpp"
#include "core/vec2.hpp"
#include "surface/contact_surface.hpp"

namespace yadefrag {

/// A piece, by the chord from its begin to that of the next one: one line of the cache, since
/// detection is limited by memory.
struct alignas(64) MovingPiece {
  Vec2 begin;     ///< m, at xⁿ
  Vec2 moved;     ///< m, displacement of the begin to x*
  Vec2 along;     ///< unit tangent of the chord at xⁿ
  double length;  ///< m, of the chord at xⁿ
  EntryId next;
  std::uint32_t former : 31;  ///< the entry before it
  std::uint32_t isArc : 1;

  [[nodiscard]] Vec2 normal() const { return rightOf(along); }
  [[nodiscard]] EntryId prev() const { return EntryId(std::size_t{former}); }
  /// (m) The larger of the distances from the chord's line and beside the chord: at most the
  /// distance from the chord.
  [[nodiscard]] double distance(Vec2 point) const {
    const Vec2 from = point - begin;
    const double half = .5 * length;
    return std::max(std::abs(cross(along, from)), std::abs(dot(from, along) - half) - half);
  }
};

/// All of them, by entry.
class MovingPieces {
 public:
  /// `before`: xⁿ, `now`: x* (m, by node). The result is the same for any number of threads.
  void update(const ContactSurfaces& surfaces, std::span<const Vec2> before,
              std::span<const Vec2> now, int threads);

  /// (m) Largest displacement of a begin from the weighted mean of all: what moves together has no
  /// part in it, and a part at rest does not change the mean.
  [[nodiscard]] double largestMove() const;

  [[nodiscard]] const MovingPiece& operator[](EntryId entry) const { return pieces_[entry.value]; }
  /// (m) Displacement to x* of the point of a straight piece at ξ, 0 to 1 along the piece.
  [[nodiscard]] Vec2 movedAt(const MovingPiece& piece, double xi) const {
    return (1 - xi) * piece.moved + xi * (*this)[piece.next].moved;
  }

 private:
  std::vector<MovingPiece> pieces_;
  // m, those of the pieces: a quarter of the memory to read for `largestMove`.
  std::vector<Vec2> moved_;
};

}  // namespace yadefrag
