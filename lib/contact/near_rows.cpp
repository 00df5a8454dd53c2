#include "contact/near_rows.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace yadefrag {

ContactSizes::ContactSizes(double shortestSide, double move, const tolerance::Contact& constants)
    : shortest(shortestSide),
      zone(shortestSide * std::clamp(tolerance::kZoneMoves * move / shortestSide, tolerance::kZone,
                                     tolerance::kWidestZone)),
      wide(tolerance::kWide * zone),
      slack(constants.slack * move + tolerance::kTouching * shortestSide),
      leaning(constants.leaning * shortestSide),
      faceAngle(constants.faceAngle),
      closing(tolerance::kOpenShare * tolerance::kClosing * (slack + move)),
      isFast(tolerance::kZoneMoves * move > tolerance::kWidestZone * shortestSide) {}

/// A corner of a boundary: the entry that begins there, and its two sides.
struct NearRows::Corner {
  EntryId entry;
  const MovingPiece* own;     // begins there
  const MovingPiece* former;  // ends there
  double turn;                // sine; positive: convex. 0 at an arc
  bool isRound;               // one of them is an arc
  bool mayTouch;              // it is no notch, but for a small angle
};

/// A side at a corner, and a point (another corner) that may be in front of it.
struct NearRows::Side {
  EntryId piece, point;
  const MovingPiece* of;
  double gap;       // m, of the point at xⁿ
  double gapAfter;  // m, the same at x*, for the corner's displacement
  double inside;    // m, from the corner to the point's foot; negative: beside the side
  double xi;
  double leaning;  // sine, how far the point's own sides lean into this side
  bool atEnd;      // the corner is the side's end
};

NearRows::Corner NearRows::cornerAt(EntryId entry) const {
  const MovingPiece &own = pieces_[entry], &former = pieces_[own.prev()];
  const bool isRound = own.isArc != 0 || former.isArc != 0;
  const double turn = isRound ? 0 : cross(former.along, own.along);
  return {entry, &own, &former, turn, isRound, turn > -sizes_.faceAngle};
}

/// (sine) How far a corner's sides lean into a side with this normal; 0: not at all. Infinite for a
/// corner on the other side of it: its body is in front of it, but it faces the same way.
double NearRows::leaningOf(const Corner& corner, Vec2 normal) {
  if (dot(corner.own->normal() + corner.former->normal(), normal) > tolerance::kAway)
    return INFINITY;
  return std::max({0., -dot(corner.own->along, normal), dot(corner.former->along, normal)});
}

NearRows::Side NearRows::sideOf(const Corner& corner, const Corner& point, bool atEnd) const {
  const MovingPiece& piece = atEnd ? *corner.former : *corner.own;
  const Vec2 from = point.own->begin - corner.own->begin, normal = piece.normal();
  const double gap = dot(from, normal), along = dot(from, piece.along);
  Side side;
  side.piece = atEnd ? corner.own->prev() : corner.entry, side.point = point.entry;
  side.of = &piece;
  side.gap = gap;
  side.gapAfter = gap + dot(point.own->moved - corner.own->moved, normal);
  side.inside = atEnd ? -along : along;
  side.xi = atEnd ? 1 + along / piece.length : along / piece.length;
  side.leaning = leaningOf(point, normal);
  side.atEnd = atEnd;
  return side;
}

double NearRows::cornerAndSide(EntryId slave, EntryId master, double along, double gap) {
  const MovingPiece& piece = pieces_[master];
  const double toEnd = std::min(along, piece.length - along);
  const double open = std::max({0., gap, tolerance::kZone * sizes_.shortest - toEnd});
  if (toEnd < sizes_.zone || gap < -sizes_.zone) return open;
  // Deep, compared with its distance from the end: it came in there.
  if (gap < -tolerance::kThrough * toEnd) return open;
  const Corner corner = cornerAt(slave);
  if (!corner.mayTouch || leaningOf(corner, piece.normal()) > sizes_.faceAngle) return open;
  return add(slave, master, gap, along / piece.length) ? 0 : open;
}

double NearRows::corners(EntryId first, EntryId second) {
  const Corner a = cornerAt(first), b = cornerAt(second);
  if (a.own->prev() == second || b.own->prev() == first) return INFINITY;  // the ends of one piece
  if ((a.isRound && b.isRound) || (!a.mayTouch && !b.mayTouch)) return 0;
  const std::size_t former = rows_.size();
  if (b.turn < tolerance::kNotch && a.mayTouch)
    notch(b, a);
  else if (a.turn < tolerance::kNotch && b.mayTouch)
    notch(a, b);
  else
    separate(a, b);
  return rows_.size() > former ? 0 : openDistance(a, b);
}

/// Whatever case of the page these corners become by a small change of shape: a row needs a side
/// with a gap below the slack, and there is none if all four sides are open, both sides of one
/// corner in front of a convex one, or one side between two convex ones (`separate`).
double NearRows::openDistance(const Corner& a, const Corner& b) const {
  if (a.isRound || b.isRound) return 0;
  const auto isConvex = [](const Corner& c) { return c.turn > tolerance::kStillConvex; };
  double all = INFINITY, most = 0;
  for (const auto& [corner, point] : {std::pair{&a, &b}, std::pair{&b, &a}}) {
    const std::array<Side, 2> sides{sideOf(*corner, *point, false), sideOf(*corner, *point, true)};
    const double both = std::min(sides[0].gap, sides[1].gap);
    all = std::min(all, both);
    if (!isConvex(*point)) continue;
    for (const Side& side : sides) {
      if (side.leaning > sizes_.faceAngle - tolerance::kStillConvex) continue;
      const double gap = isConvex(*corner) ? side.gap - side.leaning * sizes_.leaning : both;
      most = std::max(most, gap);
    }
  }
  return std::max(all, most);
}

/// Both sides hold the tip. Where the boundary is nearly straight they are one, that which is
/// nearer at the end of the step: the tip slides over the node within the step.
void NearRows::notch(const Corner& corner, const Corner& tip) {
  const std::array<Side, 2> sides{sideOf(corner, tip, false), sideOf(corner, tip, true)};
  const bool isOne = dot(sides[0].of->along, sides[1].of->along) > tolerance::kOneSide;
  bool anyBefore = false;
  for (const Side& side : sides) {
    const Vec2 normal = side.of->normal();
    // A blunt tip's sides may lean into both sides of the notch, but must face them.
    if (std::min(dot(tip.own->normal(), normal), dot(tip.former->normal(), normal)) >
        tolerance::kFacing)
      continue;
    const Side& twin = sides[side.atEnd ? 0 : 1];
    if (isOne && (twin.gapAfter < side.gapAfter || (twin.gapAfter == side.gapAfter && side.atEnd)))
      continue;
    if (side.gap < -sizes_.zone || side.inside >= sizes_.zone) continue;
    const double xi = std::clamp(side.xi, -tolerance::kFootBeyond, 1 + tolerance::kFootBeyond);
    if (!add(side.point, side.piece, side.gap, xi)) continue;
    rows_.back().isSecond = anyBefore;
    anyBefore = true;
  }
}

/// The separating side of two wedges.
void NearRows::separate(const Corner& a, const Corner& b) {
  std::array<Side, 4> sides;
  int count = 0;
  const Side* best = nullptr;
  bool bestIsOpen = false;
  double bestScore = 0;
  const auto look = [&](const Corner& corner, const Corner& point, bool atEnd) {
    Side& side = sides[static_cast<std::size_t>(count)];
    side = sideOf(corner, point, atEnd);
    if (side.leaning > sizes_.faceAngle) return false;
    // At an arc only what is beside the side is known.
    if (point.isRound && (side.inside < 0 || side.inside > side.of->length)) return false;
    ++count;
    const double less = side.leaning * sizes_.leaning;
    const bool isOpen = side.gap - less >= -tolerance::kOpen * sizes_.shortest;
    if (isOpen && side.gapAfter - less > 2 * sizes_.slack) return true;
    const double score = (isOpen ? side.gapAfter : side.gap) - less +
                         tolerance::kPerBeside * std::min(0., side.inside);
    if (best == nullptr || (isOpen && !bestIsOpen) || (isOpen == bestIsOpen && score > bestScore))
      best = &side, bestIsOpen = isOpen, bestScore = score;
    return false;
  };
  // Ends as soon as one side separates them in any case.
  if (!b.isRound && a.mayTouch && (look(b, a, false) || look(b, a, true))) return;
  if (!a.isRound && b.mayTouch && (look(a, b, false) || look(a, b, true))) return;
  if (best == nullptr) return;
  const std::size_t former = rows_.size();
  addOf(*best, -INFINITY);
  const std::size_t first = rows_.size();
  for (int k = 0; k < count; ++k) {
    const Side& side = sides[static_cast<std::size_t>(k)];
    if (side.point != best->point &&
        dot(side.of->along, best->of->along) < tolerance::kAntiparallel)
      addOf(side, tolerance::kPartner * sizes_.shortest);
  }
  // Both rows move nearly the same nodes: from row to row their forces would not converge.
  if (first > former && rows_.size() > first) rows_[first].isSecond = true;
}

/// `least` (m): how far over the side the point must be.
void NearRows::addOf(const Side& side, double least) {
  if (side.gap < -sizes_.zone || side.inside < least) return;
  if (side.inside >= sizes_.zone) return;  // it is over the middle of this side
  double xi = side.xi;
  if (std::abs(xi) < tolerance::kFootAtNode) xi = 0;
  if (std::abs(xi - 1) < tolerance::kFootAtNode) xi = 1;
  (void)add(side.point, side.piece, side.gap,
            std::clamp(xi, -tolerance::kFootBeyond, 1 + tolerance::kFootBeyond));
}

/// Adds a row with a straight master, unless it stays open in this step.
bool NearRows::add(EntryId slave, EntryId master, double gapBefore, double xi) {
  const MovingPiece &on = pieces_[master], &to = pieces_[on.next];
  const Vec2 normal = on.normal();
  const Vec2 moved = pieces_[slave].moved - pieces_.movedAt(on, xi);
  double gap = gapBefore + dot(moved, normal);
  if (gap - std::min(0., gapBefore) > sizes_.slack) return false;
  // Of the second order: the side turns while the slave slides along it. Only the sign that
  // deepens: with both, impacts have overlaps of 6e-3 of a segment.
  const double turn = dot(to.moved - on.moved, normal) / on.length, slide = dot(moved, on.along);
  gap -= std::max(0., turn * slide);
  rows_.push_back({slave, master, normal, xi, gapBefore, gap, slide});
  return true;
}

void NearRows::cornerAndArc(EntryId slave, EntryId master, const PieceGeometry& before,
                            const PieceGeometry& now, const ContactSurfaces& surfaces) {
  const MovingPiece& point = pieces_[slave];
  const Foot after = now.foot(master, point.begin + point.moved);
  const bool isOver = after.xi >= -tolerance::kFootRange && after.xi <= 1 + tolerance::kFootRange;
  if (!isOver || !(after.gap < sizes_.slack) || after.gap < -sizes_.zone - sizes_.slack) return;
  const Foot foot = before.foot(master, point.begin);
  if (leaningOf(cornerAt(slave), foot.normal) > sizes_.faceAngle) return;
  // At the end itself the force would have a moment while the slave slides past it.
  const double xi = std::clamp(foot.xi, -tolerance::kFootBeyond, 1 + tolerance::kFootBeyond);
  const Stencil stencil = surfaces.master(master, xi);
  const Vec2 moved =
      point.moved - (combine(stencil, now.positions()) - combine(stencil, before.positions()));
  const double gap = foot.gap + dot(moved, foot.normal);
  if (gap - std::min(0., foot.gap) > sizes_.slack) return;
  rows_.push_back({slave, master, foot.normal, xi, foot.gap, gap,
                   dot(moved, Vec2{-foot.normal.y, foot.normal.x})});
}

}  // namespace yadefrag
