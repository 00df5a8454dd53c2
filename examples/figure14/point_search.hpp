#pragma once
// The paper's global search (§4): finds slaves in the halos of masters. Points have position codes
// with one box edge b; rectangles are the queries. The searches of contact_search.hpp handle boxes
// of any size.

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

/// The rectangle enlarged by `halo` on every side.
inline Rectangle enlarged(const Rectangle& r, double halo) {
  return {{r.low.x - halo, r.low.y - halo}, {r.high.x + halo, r.high.y + halo}};
}

/// Finds candidates. Entry i of the surfaces is both the slave `points[i]` and the master whose
/// piece has the bounding rectangle `masters[i]`; the slave lies in that rectangle. Coordinates are
/// finite.
///
/// The candidates are exactly those with `contains(enlarged(masters[i], halo), point)`: each once,
/// an entry's own slave included, in an order that depends on the points and on earlier updates.
class PointSearch {
 public:
  virtual ~PointSearch() = default;

  /// Takes the present slaves; the array must not move until the next update.
  virtual void update(std::span<const Vec2> points) = 0;

  /// Row i: the slaves in the halo of master i. There are as many masters as slaves.
  virtual void find(std::span<const Rectangle> masters, double halo, Csr<EntryId>& candidates) = 0;

  /// Comparisons since construction.
  [[nodiscard]] Comparisons comparisons() const { return count_.total(); }

 protected:
  Count count_{true};
};

/// Parameters of a search.
struct PointSearchPlan {
  double edge = 1;                       ///< b, edge of the smallest boxes (m), > 0
  Vec2 origin;                           ///< a common corner of the boxes of all sizes
  std::vector<std::uint32_t> loopStart;  ///< first entry of each closed loop, ascending, from 0
  /// SPC only: the begin of a range is looked up in a directory; otherwise it is found as in the
  /// paper.
  bool directory = true;
};

std::unique_ptr<PointSearch> makePointSearch(SearchMethod method, PointSearchPlan plan);
/// That of kHierarchy.
std::unique_ptr<PointSearch> makePointHierarchy(PointSearchPlan plan);

}  // namespace yadefrag
