// Data of contact that are stored from one step to the next.

#include <algorithm>
#include <utility>

#include "contact/contact.hpp"
#include "core/tolerances/contact.hpp"

namespace yadefrag {

namespace {

/// With new numbers, and without contacts of removed entries.
std::vector<StoredContact> renumbered(std::vector<StoredContact> touches,
                                      std::span<const EntryId> numbers) {
  for (StoredContact& touch : touches)
    touch.pair = {numbers[touch.pair.slave.value], numbers[touch.pair.master.value]};
  std::erase_if(touches, [](const StoredContact& touch) {
    return touch.pair.slave == EntryId::none() || touch.pair.master == EntryId::none();
  });
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

void Contact::measureFriction(const Model& model) {
  friction_.clear();
  for (const Component& component : model.components) friction_.push_back(component.friction);
}

/// Tangent of the friction angle: the smaller one of both bodies.
double Contact::frictionOf(SlaveMaster pair, const ContactSurfaces& surfaces) const {
  return std::min(friction_[surfaces.component[pair.slave.value].value],
                  friction_[surfaces.component[pair.master.value].value]);
}

void Contact::indexTouches(std::size_t entries) {
  pairs_.clear();
  pairs_.grow(entries);
  for (const StoredContact& touch : touches) pairs_.add(touch.pair);
}

/// The contact of the last step, or null.
const StoredContact* Contact::storedContactOf(SlaveMaster pair) const {
  const std::uint32_t number = pairs_.numberOf(pair);
  return number == PairsOfSlaves::kNone ? nullptr : &touches[number];
}

void Contact::renumber(std::span<const EntryId> numbers) {
  std::vector<StoredContact> kept = renumbered(std::move(touches), numbers);
  reset();
  touches = std::move(kept);
}

void Contact::removeGone(const ContactSurfaces& surfaces) {
  yadefrag::removeGone(candidates, surfaces);
  std::erase_if(touches, [&](const StoredContact& t) {
    return surfaces.isGone(t.pair.slave) || surfaces.isGone(t.pair.master);
  });
}

}  // namespace yadefrag
