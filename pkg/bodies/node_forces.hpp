#pragma once
// Forces of YADE's contacts on the boundary, as forces on nodes.

#include <algorithm>
#include <vector>

#include "step/world.hpp"
#include "surface/piece_geometry.hpp"
#include "yade/helpers.hpp"

namespace yadefrag {

/// The middle of a piece of the boundary, and the two nodes that determine its rotation: moments
/// act as a pair of forces on them.
struct EntryFrame {
  Stencil middle;
  NodeId first, last;

  EntryFrame(const ContactSurfaces& surfaces, EntryId entry) {
    NodeId nodes[3];
    const int count = surfaces.pieceNodes(entry, nodes);
    first = nodes[0], last = nodes[count - 1];
    const PieceRange range = pieceRange(surfaces.piece[entry.value]);
    middle = surfaces.master(entry, .5 * (range.begin + range.end));
  }
};

/// The point of a piece nearest to `point`, where the force of a contact acts.
inline Stencil footOf(const ContactSurfaces& surfaces, const PieceGeometry& geometry, EntryId entry,
                      Vec2 point) {
  const PieceRange range = geometry.range(entry);
  return surfaces.master(entry, std::clamp(geometry.foot(entry, point).xi, range.begin, range.end));
}

/// Divides the forces on one body between the nodes of its piece.
class NodeForces {
 public:
  NodeForces(const ContactSurfaces& surfaces, const Nodes& nodes, std::vector<Vec2>& forces)
      : surfaces_(surfaces), nodes_(nodes), geometry_(surfaces, nodes.position), forces_(forces) {}

  /// Each contact acts at its foot on the piece: its power is then that of the overlap it has, also
  /// at a corner, which only one node moves. YADE's laws may treat both bodies of a contact as
  /// spheres, with a torque that belongs to the body's position; with contacts, the moment is
  /// therefore that of the contact points. The remaining force acts at the piece's middle.
  void add(EntryId entry, const yade::Body& body, Vec2 force, double torque) {
    const EntryFrame frame(surfaces_, entry);
    Vec2 explained, points;
    double moment = 0;
    int count = 0;
    for (const auto& [other, contact] : body.intrs) {
      if (!contact->isReal()) continue;
      const auto* geom = dynamic_cast<const yade::ScGeom*>(contact->geom.get());
      const auto* phys = dynamic_cast<const yade::NormShearPhys*>(contact->phys.get());
      if (!geom || !phys) continue;
      const double sign = contact->getId2() == body.getId() ? 1 : -1;
      const Vec2 part = sign * inPlane(phys->normalForce + phys->shearForce);
      const Vec2 point = inPlane(geom->contactPoint);
      moment += addAt(footOf(surfaces_, geometry_, entry, point), point, part);
      explained += part;
      points += point;
      ++count;
    }
    const Vec2 rest = force - explained;
    const Vec2 place = count > 0 ? (1. / count) * points : inPlane(body.state->se3.position);
    moment += addAt(frame.middle, place, rest);
    if (count == 0) moment += torque;
    const Vec2 along = nodes_.position[frame.last.value] - nodes_.position[frame.first.value];
    const Vec2 pair = (-moment / dot(along, along)) * rightOf(along);
    forces_[frame.last.value] += pair;
    forces_[frame.first.value] -= pair;
  }

 private:
  /// Returns the moment (N m) that is missing if a force at `place` acts at the stencil's point.
  double addAt(const Stencil& at, Vec2 place, Vec2 force) {
    for (int k = 0; k < at.count; ++k) forces_[at.node[k].value] += at.weight[k] * force;
    return cross(place - combine(at, nodes_.position), force);
  }

  const ContactSurfaces& surfaces_;
  const Nodes& nodes_;
  const PieceGeometry geometry_;
  std::vector<Vec2>& forces_;
};

// --- Forces that FESolver adds to YADE's bodies: they remain until the next reset of forces, and
// there may be none before the next step.

class ContactReactions {
 public:
  struct Given {
    yade::Body::id_t id;
    yade::Vector3r force, torque;  ///< N, N m
    double work;                   ///< J, on a boundary that has moved by its own velocity
  };

  /// Takes back the forces of the last step, unless they have been reset since.
  void begin(yade::Scene& scene) {
    if (all_.empty()) return;
    if (lastReset(scene.forces) == lastReset_) {
      for (const Given& one : all_) {
        scene.forces.addForce(one.id, -one.force);
        scene.forces.addTorque(one.id, -one.torque);
      }
      scene.forces.sync();
    }
    all_.clear();
  }
  void add(yade::Scene& scene, const Given& one) {
    scene.forces.addForce(one.id, one.force);
    scene.forces.addTorque(one.id, one.torque);
    all_.push_back(one);
  }
  /// Must be called after all forces and all new bodies of a step: YADE's reset deletes, and
  /// O.forces.f shows, only forces that have been synchronised since the last new body.
  /// NewtonIntegrator does that, too, if there is one.
  void end(yade::Scene& scene) {
    lastReset_ = lastReset(scene.forces);
    scene.forces.sync();
  }

  /// Forces of the last step, in the order of `add`: several for one body.
  [[nodiscard]] const std::vector<Given>& all() const { return all_; }

 private:
  std::vector<Given> all_;
  long lastReset_ = 0;  // step of the last reset when they were added
};

}  // namespace yadefrag
