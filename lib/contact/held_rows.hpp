#pragma once
// Contacts between pieces that cohesion holds together.

#include <cstddef>
#include <cstdint>

#include "contact/contact_row.hpp"
#include "contact/coupled_forces.hpp"

namespace yadefrag {

/// True if cohesion holds both sides of a row to each other. It would undo in every step what
/// contact does to reduce their overlap: contact would create energy, and cohesion would take it.
[[nodiscard]] inline bool isHeldByCohesion(const ContactRow& row, const CoupledForces* cohesion) {
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

}  // namespace yadefrag
