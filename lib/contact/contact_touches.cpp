// Data of contact that are stored from one step to the next.

#include <algorithm>
#include <utility>

#include "contact/contact.hpp"
#include "core/tolerances/contact.hpp"

namespace yadefrag {

namespace {

/// With new numbers, and without contacts of removed entries.
std::vector<Touch> renumbered(std::vector<Touch> touches, std::span<const EntryId> numbers) {
  for (Touch& touch : touches)
    touch.pair = {numbers[touch.pair.slave.value], numbers[touch.pair.master.value]};
  std::erase_if(touches, [](const Touch& touch) {
    return touch.pair.slave == EntryId::none() || touch.pair.master == EntryId::none();
  });
  std::ranges::sort(touches, {}, &Touch::pair);
  return touches;
}

}  // namespace

/// True if cohesion holds both sides of a row to each other. It would undo in every step what
/// contact does to reduce their overlap: contact would create energy, and cohesion would take it.
bool Contact::isHeldByCohesion(const ContactRow& row, const CoupledForces* cohesion) {
  if (cohesion == nullptr) return false;
  const auto count = static_cast<std::size_t>(row.count);
  for (std::size_t k = 0; k < count; ++k) {
    if (!(row.weight[k] > 0)) continue;
    const std::uint32_t group = cohesion->groupOf(row.node[k]);
    if (group == CoupledForces::kNoGroup) continue;
    for (std::size_t m = 0; m < count; ++m)
      if (row.weight[m] < 0 && cohesion->groupOf(row.node[m]) == group) return true;
  }
  return false;
}

/// (m) Slip in the step without contact.
double Contact::slipOf(const ContactRow& row, const Model& model, const ContactStep& step) const {
  Vec2 moved;
  for (int k = 0; k < row.count; ++k) {
    const auto at = static_cast<std::size_t>(k);
    const std::uint32_t node = row.node[at].value;
    moved += row.weight[at] * (model.nodes.position[node] - step.before[node]);
  }
  return dot(moved - relative(row, displacement_), row.tangent());
}

double Contact::frictionOf(SlaveMaster pair, const Model& model, const ContactSurfaces& surfaces) {
  const auto friction = [&](EntryId entry) {
    return model.components[surfaces.component[entry.value].value].friction;
  };
  const double own = friction(pair.slave);
  return own > 0 ? std::min(own, friction(pair.master)) : 0;
}

/// Sets slip, and the values stored for this contact in the last step.
void Contact::startRow(ContactRow& row, const Model& model, const PieceGeometry& before,
                       const Touch* former, const ContactStep& step) const {
  row.gap -= dot(relative(row, displacement_), row.normal);
  if (row.friction > 0) row.slip = slipOf(row, model, step);
  const double decay = isHeldByCohesion(row, step.coupled) ? 0 : step.constants.overlapDecay;
  if (former != nullptr) {
    row.toleratedGap =
        std::min(0., former->toleratedGap + decay * std::min(-former->toleratedGap, step.move));
    row.normalForce = former->normalForce;
    row.tangentForce = former->tangentForce;
  } else {
    // An overlap from before the step, as beside an end, must not become velocity at once.
    const double gap = before.foot(row.master, before.slave(row.slave)).gap;
    row.toleratedGap = std::min(0., gap + decay * step.move);
  }
}

/// (m) Largest depth at xⁿ of the contacts of the last step.
double Contact::deepestTouch(const ContactSurfaces& surfaces, std::span<const Vec2> before) const {
  double most = 0;
  withGeometry(surfaces, before, [&](const auto& geometry) {
    for (const Touch& touch : touches)
      most =
          std::max(most, -geometry.foot(touch.pair.master, geometry.slave(touch.pair.slave)).gap);
  });
  return most;
}

void Contact::renumber(std::span<const EntryId> numbers) {
  std::vector<Touch> kept = renumbered(std::move(touches), numbers);
  reset();
  touches = std::move(kept);
}

void Contact::removeGone(const ContactSurfaces& surfaces) {
  yadefrag::removeGone(candidates, surfaces);
  std::erase_if(touches, [&](const Touch& t) {
    return surfaces.isGone(t.pair.slave) || surfaces.isGone(t.pair.master);
  });
}

void Contact::allowOverlaps(const ContactSurfaces& surfaces, std::span<const Vec2> positions,
                            std::span<const EntryId> masters) {
  if (masters.empty()) return;
  const PieceGeometry geometry(surfaces, positions);
  for (std::size_t r = 0; r < candidates.slaves.size(); ++r)
    for (std::uint32_t c = candidates.offsets[r]; c < candidates.offsets[r + 1]; ++c) {
      const SlaveMaster pair{candidates.slaves[r], candidates.masters[c]};
      if (std::ranges::find(masters, pair.master) == masters.end()) continue;
      const Foot foot = geometry.foot(pair.master, geometry.slave(pair.slave));
      const double gap = foot.gap;
      if (gap >= 0 || !isOver(geometry, pair.master, foot) ||
          gap < -tolerance::kStraightened * geometry.length(pair.master))
        continue;
      const auto at =
          std::lower_bound(touches.begin(), touches.end(), pair,
                           [](const Touch& t, const SlaveMaster& p) { return t.pair < p; });
      if (at != touches.end() && at->pair == pair)
        at->toleratedGap = std::min(at->toleratedGap, gap);
      else
        touches.insert(at, {pair, 0, 0, gap});
    }
}

}  // namespace yadefrag
