#pragma once
// Detection: from the candidates to the rows of a step, once a step.

#include <cstdint>
#include <span>
#include <vector>

#include "contact/candidates.hpp"
#include "contact/near_rows.hpp"
#include "core/parallel.hpp"

namespace yadefrag {

class RowFinder {
 public:
  /// Positions of a step, by node.
  struct Positions {
    std::span<const Vec2> before;  ///< m, xⁿ
    std::span<const Vec2> now;     ///< m, x*
  };
  /// Before `find`. Returns the largest displacement (m) of a surface in the step, relative to the
  /// mean.
  double measure(const ContactSurfaces& surfaces, const Positions& positions, int threads) {
    pieces_.update(surfaces, positions.before, positions.now, threads);
    return pieces_.largestMove();
  }
  /// False if no slave can have a row in this step, by the distances of an earlier one: most steps
  /// of bodies that are apart. `travelled` (m): bound of the distance that each surface node has
  /// moved so far.
  [[nodiscard]] static bool mayFind(const Candidates& candidates, const ContactSizes& sizes,
                                    double travelled);
  /// The rows of all indexed candidates, in their order; valid until the next call. The
  /// result is the same for any number of threads. Sets the distances of the candidates.
  std::vector<NearRow>& find(Candidates& candidates, const ContactSurfaces& surfaces,
                             const Positions& positions, const ContactSizes& sizes,
                             double travelled, int threads);
  [[nodiscard]] const MovingPiece& piece(EntryId entry) const { return pieces_[entry]; }

 private:
  /// What one thread needs.
  struct Visit {
    const Candidates& candidates;
    const ContactSurfaces& surfaces;
    PieceGeometry before, now;
    const ContactSizes& sizes;
    NearRows rows;
    std::vector<EntryId> near;  // masters of one slave
    std::vector<EntryId> seen;  // corners that this slave has met
    double far = 0, open = 0;   // m, of the slave: see Candidates::Distance
  };
  [[nodiscard]] static bool isQuiet(const Candidates::Distance& distance, const ContactSizes& sizes,
                                    double travelled);
  void visit(std::size_t row, Visit& with) const;
  void visitArc(EntryId slave, EntryId master, Visit& with) const;
  void visitStraight(EntryId slave, EntryId master, Visit& with) const;
  void meet(EntryId slave, EntryId corner, Vec2 from, Visit& with) const;
  [[nodiscard]] bool meets(EntryId slave, EntryId corner, const Candidates& candidates) const;

  MovingPieces pieces_;
  std::vector<PartList<NearRow>> parts_;
  std::vector<NearRow> rows_;
};

}  // namespace yadefrag
