// Rigid boundaries that obey forces, as parts of the contact system.

#include <algorithm>
#include <cmath>

#include "contact/contact.hpp"

namespace yadefrag {

/// Sets the row's part on such a boundary.
void Contact::findRigid(ContactRow& row, const Nodes& nodes, const ContactStep& step) const {
  ContactRow::RigidPart& part = row.rigid;
  for (int k = 0; k < row.count; ++k) {
    const auto at = static_cast<std::size_t>(k);
    const NodeId node = row.node[at];
    if (nodes.held[node.value] != kHeldXY) continue;
    const std::uint32_t mass = step.rigid.of(node);
    if (mass == ContactRow::kNone || (part.mass != ContactRow::kNone && part.mass != mass))
      continue;
    part.mass = mass;
    part.weight += row.weight[at];
    part.lever += row.weight[at] * (step.before[node.value] - step.rigid.masses[mass].centre);
  }
}

bool Contact::isOfRigid(NodeId node, const ContactStep& step) const {
  return !rigidLoads_.empty() && step.rigid.of(node) != ContactRow::kNone;
}

/// Moves the nodes of these boundaries to their position in the body's corrected pose. The rows'
/// linear displacement differs from it by the second order of the rotation. `largest` (m²): as in
/// `move`.
void Contact::moveRigid(Model& model, const ContactStep& step, double& largest) {
  if (rigidLoads_.empty()) return;
  for (const ContactRow& row : rows_) {
    if (row.rigid.mass == ContactRow::kNone) continue;
    RigidLoad& load = rigidLoads_[row.rigid.mass];
    load.hasRow = true;
    load.force += row.rigid.weight * row.force();
    load.moment += cross(row.rigid.lever, row.force());
  }
  const double squared = step.length.squared();
  for (std::uint32_t m = 0; m < rigidLoads_.size(); ++m) {
    const RigidLoad& load = rigidLoads_[m];
    if (!load.hasRow) continue;
    const RigidMass& body = step.rigid.masses[m];
    const Vec2 shift{squared * body.mobility.x * load.force.x,
                     squared * body.mobility.y * load.force.y};
    const double angle = squared * body.turning * load.moment;
    const double cosine = std::cos(angle), sine = std::sin(angle);
    for (const NodeId node : step.rigid.nodesOf.row(m)) {
      const std::uint32_t n = node.value;
      const Vec2 before = step.before[n];
      const Vec2 free = before + step.length.position * model.nodes.velocity[n];
      const Vec2 arm = free - body.moved;
      const Vec2 place =
          body.moved + shift + Vec2{cosine * arm.x - sine * arm.y, sine * arm.x + cosine * arm.y};
      const Vec2 by = place - free;
      model.nodes.position[n] = place;
      model.nodes.velocity[n] = 1 / step.length.position * (place - before);
      largest = std::max(largest, dot(by, by));
    }
  }
}

}  // namespace yadefrag
