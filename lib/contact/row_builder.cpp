#include "contact/row_builder.hpp"

#include <algorithm>
#include <cmath>

#include "contact/junction_rules.hpp"
#include "contact/slave_normals.hpp"
#include "core/tolerances/contact.hpp"

namespace yadefrag {

namespace {

struct FootOn {
  EntryId master;
  Foot foot;
};

/// The foot at xⁿ: on the master, or on its adjacent piece if the slave was over that one and the
/// boundary does not turn towards the void between them (otherwise the adjacent piece has another
/// normal). A piece of which the slave is an end is excluded: it cannot be pushed away from itself.
FootOn footBefore(const ContactSurfaces& surfaces, const PieceGeometry& before, SlaveMaster pair,
                  Vec2 slave, double faceAngle) {
  const EntryId master = pair.master;
  const Foot foot = before.foot(master, slave);
  const PieceRange range = before.range(master);
  if (foot.xi >= range.begin && foot.xi <= range.end) return {master, foot};
  const EntryId neighbour =
      foot.xi < range.begin ? surfaces.prev[master.value] : surfaces.next[master.value];
  if (neighbour == pair.slave || neighbour == surfaces.prev[pair.slave.value])
    return {master, foot};
  // In a notch the neighbour's normal would push the slave in the direction of its motion, which
  // creates energy.
  const bool isNotch = neighbour == surfaces.prev[master.value]
                           ? isConcaveJunction(before, neighbour, master)
                           : isConcaveJunction(before, master, neighbour);
  if (isNotch) return {master, foot};
  const Foot other = before.foot(neighbour, slave);
  const PieceRange otherRange = before.range(neighbour);
  const bool overOther = other.xi >= otherRange.begin && other.xi <= otherRange.end;
  if (overOther && areOneFace(other.normal, foot.normal, faceAngle)) return {neighbour, other};
  return {master, foot};
}

/// The foot of a slave that has passed the end of its master within the step: the one at xⁿ if the
/// slave was over the master then, near its end. With the end instead, each such contact would
/// create angular momentum. Rejected with friction, which has a moment anyway: a wedge of 10°
/// driven into a notch with μ = 100 gains 8 % of its energy.
FootOn footAtCorner(const PieceGeometry& before, const Active& active, Vec2 slave) {
  const EntryId master = active.pair.master;
  const Foot start = before.foot(master, slave);
  const PieceRange range = before.range(master);
  const double inside = std::min(start.xi - range.begin, range.end - start.xi);
  return {master, inside >= 0 && inside <= tolerance::kFootWithin ? start : active.foot};
}

/// A foot past the end of a straight piece is extrapolated a little; otherwise it is at the end. A
/// foot that coincides with a node is at the node: the other node would only connect rows that do
/// not affect each other.
double usableXi(const PieceGeometry& before, EntryId master, double xi, bool atCorner) {
  const PieceRange range = before.range(master);
  if (std::abs(xi - range.begin) < tolerance::kFootAtNode) return range.begin;
  if (std::abs(xi - range.end) < tolerance::kFootAtNode) return range.end;
  const bool near =
      xi >= range.begin - tolerance::kFootBeyond && xi <= range.end + tolerance::kFootBeyond;
  if (!before.isArc(master) && near && !atCorner) return xi;
  return std::clamp(xi, range.begin, range.end);
}

/// True if the boundary continues past that end of a piece without a significant corner.
bool goesOn(const ContactSurfaces& surfaces, const PieceGeometry& before, EntryId master, double xi,
            Vec2 slave, double faceAngle) {
  const bool atBegin = xi < before.range(master).begin;
  const EntryId neighbour = atBegin ? surfaces.prev[master.value] : surfaces.next[master.value];
  return areOneFace(before.foot(neighbour, slave).normal, before.foot(master, slave).normal,
                    faceAngle);
}

}  // namespace

ContactRow makeRow(const ContactSurfaces& surfaces, const PieceGeometry& before,
                   const Active& active, double faceAngle, bool hasFriction) {
  const Stencil slave = surfaces.slave(active.pair.slave);
  const Vec2 point = before.slave(active.pair.slave);
  const PieceRange range = before.range(active.pair.master);
  // Active without a foot on the piece: correct to the node of a concave corner.
  const bool past = active.foot.xi < range.begin - tolerance::kFootRange ||
                    active.foot.xi > range.end + tolerance::kFootRange;
  const bool atCorner =
      past && !goesOn(surfaces, before, active.pair.master, active.foot.xi, point, faceAngle);
  FootOn on{active.pair.master, active.foot};
  if (!atCorner)
    on = footBefore(surfaces, before, active.pair, point, faceAngle);
  else if (!hasFriction)
    on = footAtCorner(before, active, point);
  ContactRow row;
  row.slave = active.pair.slave;
  row.master = active.pair.master;
  row.normal = on.foot.normal;
  row.gap = active.foot.gap;
  row.add(slave, 1);
  row.add(surfaces.master(on.master, usableXi(before, on.master, on.foot.xi, atCorner)), -1);
  return row;
}

}  // namespace yadefrag
