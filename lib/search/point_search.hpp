#pragma once
// The paper's own global search (§4): slaves in the halos of masters. Points have position codes
// with one box edge b; rectangles ask. The searches of contact_search.hpp are for boxes of any
// size.

#include <memory>
#include <span>
#include <vector>

#include "core/comparisons.hpp"
#include "core/csr.hpp"
#include "core/ids.hpp"
#include "core/vec2.hpp"
#include "search/contact_search.hpp"

namespace yadefrag {

/// Axis-aligned and closed (m).
struct Rectangle {
  Vec2 low;
  Vec2 high;
};

/// Bitwise `&` as in `overlaps`: four independent comparisons.
inline bool contains(const Rectangle& r, Vec2 p) {
  return bool((r.low.x <= p.x) & (p.x <= r.high.x) & (r.low.y <= p.y) & (p.y <= r.high.y));
}

/// The rectangle at distance `halo` around another.
inline Rectangle enlarged(const Rectangle& r, double halo) {
  return {{r.low.x - halo, r.low.y - halo}, {r.high.x + halo, r.high.y + halo}};
}

/// Finds candidates. Entry i of the surfaces is the slave `points[i]` and the master whose piece
/// has the bounding rectangle `masters[i]`; its slave lies in it. Coordinates are finite.
///
/// The candidates are those of `contains(enlarged(masters[i], halo), point)`, exactly: each once,
/// an entry's own slave among them, in an order that depends on the points and on earlier updates.
class PointSearch {
 public:
  virtual ~PointSearch() = default;

  /// Takes the slaves as they are now; they must stay in place until the next update.
  virtual void update(std::span<const Vec2> points) = 0;

  /// Row i: the slaves in the halo of master i. As many masters as slaves.
  virtual void find(std::span<const Rectangle> masters, double halo, Csr<EntryId>& candidates) = 0;

  /// Comparisons since construction; zero unless asked for in `makePointSearch`.
  [[nodiscard]] virtual Comparisons comparisons() const = 0;
};

/// What a search must know beforehand.
struct PointSearchPlan {
  double edge = 1;                       ///< b, edge of the smallest boxes (m), > 0
  Vec2 origin;                           ///< where a corner of boxes of all sizes lies
  std::vector<std::uint32_t> loopStart;  ///< first entry of each closed loop, ascending, from 0
  /// Of SPC: where a range begins is looked up in a directory; else found as the paper does it.
  bool directory = true;
};

std::unique_ptr<PointSearch> makePointSearch(SearchMethod method, PointSearchPlan plan,
                                             bool countComparisons = false);

}  // namespace yadefrag
