#pragma once
// From a near pair to its rows. Which side holds two corners apart follows from the shape of the
// boundaries at xⁿ alone; nothing is remembered from one step to the next.
//
//        1            2            3            4            5
//     ╲  s  ╱       ╲   ╱       ╲ s ╱         ╲ s ╱     ───── s ┐
//      ╲   ╱         ╲ ╱     ────╲ ╱──v    ╲   ╲ ╱   ╱    v ─────┼──
//   ────╲ ╱────       s          v ─┘       ╲   ╳   ╱     └──────┘
//        ▔         v ──────                  ╲─ v ─╱     rows with two
//   side, its       corner:     the side that   notch:     antiparallel
//   middle: a row   of four     stays open      both       sides
//   with the side   sides one   separates them  sides hold
//                   separates
//
// 1. A corner over the middle of a side has a row with that side.
// 2., 3. Two corners: of the four sides that meet there one separates the two wedges, as in the
//    theorem of separating axes. If several do, the one that stays open, or that is violated
//    least. The row holds the corner of the other boundary in front of it.
// 4. A notch (a concave corner) holds a tip with both sides.
// 5. Two sides that overlap antiparallel beyond their corners need a second row.
//
// (s: slave, v: a corner as master.) Where several sides separate alike, the first that is compared
// holds. Rows are speculative: an open pair has one, too, if it may close in this step. The gap is
// linear in the displacements from xⁿ, where normal and foot are.

#include <span>
#include <vector>

#include "contact/moving_pieces.hpp"
#include "core/tolerances/contact.hpp"
#include "surface/piece_geometry.hpp"

namespace yadefrag {

/// A row that has been detected: a corner in front of a piece.
struct NearRow {
  EntryId slave, master;
  Vec2 normal;    ///< outward normal of the master, at xⁿ
  double xi;      ///< of the foot, 0 to 1 along the piece; straight pieces are extended a little
  double before;  ///< m, gap at xⁿ
  double gap;     ///< m, gap at x*, linear
  double slip;    ///< m, of the slave along the tangent in this step
  /// Solved together with the row before: that of the notch's other side, or of the antiparallel
  /// side.
  bool isSecond = false;
};

/// Lengths of detection in one step.
struct ContactSizes {
  ContactSizes(double shortest, double move, const tolerance::Contact& constants);

  double shortest;   ///< m, shortest segment
  double zone;       ///< m, a corner nearer than this to the end of a side belongs to that corner;
                     ///< no row holds a deeper one, which came another way
  double wide;       ///< m, pairs farther from each other than this are left out
  double slack;      ///< m, rows with a larger gap at x*, beyond an overlap at xⁿ, are left out
  double leaning;    ///< m, per sine
  double faceAngle;  ///< sine
  double closing;    ///< m, nodes move by less towards a pair that stays open in this step
  bool isFast;       ///< the zone does not cover a step
};

/// Appends the rows of near pairs to a list. Those of straight pieces return an open distance (m):
/// while both move by less than a kOpenShare of it, the pair has no row. 0: it may have one.
class NearRows {
 public:
  NearRows(const MovingPieces& pieces, const ContactSizes& sizes, std::vector<NearRow>& rows)
      : pieces_(pieces), sizes_(sizes), rows_(rows) {}

  /// Case 1. `along`, `gap` (m): place of the slave along a straight master and before it.
  double cornerAndSide(EntryId slave, EntryId master, double along, double gap);
  /// Cases 2 to 5, for the corners at which two entries begin.
  double corners(EntryId a, EntryId b);
  /// A corner, or a point of an arc, in front of an arc. `before`, `now`: at xⁿ and x*.
  void cornerAndArc(EntryId slave, EntryId master, const PieceGeometry& before,
                    const PieceGeometry& now, const ContactSurfaces& surfaces);

 private:
  struct Corner;
  struct Side;
  [[nodiscard]] Corner cornerAt(EntryId entry) const;
  static double leaningOf(const Corner& corner, Vec2 normal);
  [[nodiscard]] Side sideOf(const Corner& corner, const Corner& point, bool atEnd) const;
  [[nodiscard]] double openDistance(const Corner& a, const Corner& b) const;
  void notch(const Corner& corner, const Corner& tip);
  void separate(const Corner& a, const Corner& b);
  void addOf(const Side& side, double least);
  bool add(EntryId slave, EntryId master, double gap, double xi);

  const MovingPieces& pieces_;
  const ContactSizes& sizes_;
  std::vector<NearRow>& rows_;
};

}  // namespace yadefrag
