#include "contact/contact_row.hpp"

#include <cassert>

namespace yadefrag {

void ContactRow::add(const Stencil& stencil, double sign) {
  for (int k = 0; k < stencil.count; ++k) {
    if (stencil.weight[k] == 0) continue;
    assert(count < static_cast<int>(node.size()));
    const auto at = static_cast<std::size_t>(count++);
    node[at] = stencil.node[k];
    weight[at] = sign * stencil.weight[k];
  }
}

}  // namespace yadefrag
