#include "contact/row_builder.hpp"

#include <algorithm>

#include "core/tolerances.hpp"

namespace yadefrag {

namespace {

struct FootOn {
  EntryId master;
  Foot foot;
};

/// The foot at xⁿ: on the master, or on its neighbour if the slave was over that one and the
/// boundary does not turn towards the void between them (there the neighbour's normal is another).
FootOn footBefore(const ContactSurfaces& surfaces, const PieceGeometry& before, EntryId master,
                  Vec2 slave) {
  const Foot foot = before.foot(master, slave);
  const PieceRange range = pieceRange(surfaces.piece[master.value]);
  if (foot.xi >= range.begin && foot.xi <= range.end) return {master, foot};
  const EntryId neighbour =
      foot.xi < range.begin ? surfaces.prev[master.value] : surfaces.next[master.value];
  const Foot other = before.foot(neighbour, slave);
  const PieceRange otherRange = pieceRange(surfaces.piece[neighbour.value]);
  const bool overOther = other.xi >= otherRange.begin && other.xi <= otherRange.end;
  if (overOther && dot(other.normal, foot.normal) > tolerance::kSameFace) return {neighbour, other};
  return {master, foot};
}

/// A foot past the end of a straight piece goes on a little, elsewhere it stays at the end.
double usableXi(const ContactSurfaces& surfaces, EntryId master, double xi, bool atCorner) {
  const Piece piece = surfaces.piece[master.value];
  const PieceRange range = pieceRange(piece);
  const bool near =
      xi >= range.begin - tolerance::kFootBeyond && xi <= range.end + tolerance::kFootBeyond;
  if (piece != Piece::kArc && near && !atCorner) return xi;
  return std::clamp(xi, range.begin, range.end);
}

/// Does the boundary go on past that end of a piece without a corner worth the name?
bool goesOn(const ContactSurfaces& surfaces, const PieceGeometry& before, EntryId master, double xi,
            Vec2 slave) {
  const bool atBegin = xi < pieceRange(surfaces.piece[master.value]).begin;
  const EntryId neighbour = atBegin ? surfaces.prev[master.value] : surfaces.next[master.value];
  return dot(before.foot(neighbour, slave).normal, before.foot(master, slave).normal) >
         tolerance::kSameFace;
}

}  // namespace

ContactRow makeRow(const ContactSurfaces& surfaces, const PieceGeometry& before,
                   const Active& active) {
  const Stencil slave = surfaces.slave(active.pair.slave);
  const Vec2 point = before.slave(active.pair.slave);
  const PieceRange range = pieceRange(surfaces.piece[active.pair.master.value]);
  // Active without a foot on the piece: corrected to the node of a concave corner.
  const bool past = active.foot.xi < range.begin - tolerance::kFootRange ||
                    active.foot.xi > range.end + tolerance::kFootRange;
  const bool atCorner =
      past && !goesOn(surfaces, before, active.pair.master, active.foot.xi, point);
  const FootOn on = atCorner ? FootOn{active.pair.master, active.foot}
                             : footBefore(surfaces, before, active.pair.master, point);
  ContactRow row;
  row.slave = active.pair.slave;
  row.master = active.pair.master;
  row.normal = on.foot.normal;
  row.gap = active.foot.gap;
  row.add(slave, 1);
  row.add(surfaces.master(on.master, usableXi(surfaces, on.master, on.foot.xi, atCorner)), -1);
  return row;
}

double gapOf(const ContactRow& row, const PieceGeometry& geometry) {
  return geometry.foot(row.master, geometry.slave(row.slave)).gap;
}

}  // namespace yadefrag
