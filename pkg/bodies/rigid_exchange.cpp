// Rigid boundaries: a step takes velocities and inertia from YADE's bodies, and gives them forces.

#include <fmt/core.h>

#include <algorithm>
#include <map>

#include "bodies/rigid_bodies.hpp"
#include "core/tolerances/spheres.hpp"
#include "yade/helpers.hpp"

namespace yadefrag {
namespace {

using yade::Vector3r;

}  // namespace

void RigidBodies::giveVelocities(yade::Scene& scene, World& world,
                                 const yade::NewtonIntegrator* newton) {
  world.rigidVelocities.clear();
  world.rigidMasses.clear();
  const double dt = newton ? scene.dt : 0;
  std::map<yade::Body::id_t, std::uint32_t> numbers;
  std::vector<FreeMotion> motions;
  scene.forces.sync();
  for (std::size_t i = 0; i < corners_.size(); ++i) {
    const Member& member = members_[corners_[i].member];
    const NodeId node = world.rigidNodes()[i];
    const Vec2 from = world.model.nodes.position[node.value];
    Vector3r place;
    if (member.mover == kHeld) {
      place = RigidPose(*member.body, dt).place(corners_[i].place);
    } else {
      const auto number = static_cast<std::uint32_t>(motions.size());
      const auto [at, isNew] = numbers.emplace(member.mover, number);
      if (isNew) {
        motions.push_back(movers_.motionOf(scene, *newton, moverOf(scene, *member.body)));
        RigidMass mass = motions.back().mass();
        if (world.model.axisymmetric) mass.mobility.x = 0, mass.turning = 0;
        world.rigidMasses.masses.push_back(mass);
      }
      world.rigidMasses.members.push_back({node, at->second});
      place = motions[at->second].place(RigidPose(*member.body).place(corners_[i].place));
    }
    world.rigidVelocities.push_back(1 / scene.dt * (inPlane(place) - from));
  }
  world.rigidMasses.index();
  if (!newton) warnOfUnmoved();
}

/// A script that sets a velocity expects the body to move.
void RigidBodies::warnOfUnmoved() {
  for (const RigidCorner& corner : corners_) {
    const yade::Body& body = *members_[corner.member].body;
    if (body.state->vel.isZero(0) && body.state->angVel.isZero(0)) continue;
    sentences_.push_back(
        fmt::format("{} #{} has a velocity, but no NewtonIntegrator behind FESolver moves it: "
                    "engines(fe, moving=True) has one.",
                    body.shape->getClassName(), body.id));
    return;
  }
}

/// The corner at which a piece of a rigid boundary begins.
const RigidCorner& RigidBodies::cornerOf(const World& world, EntryId entry) const {
  const ContactSurfaces& surfaces = world.surfaces;
  const NodeId corner = surfaces.nodeOf(entry);
  const auto at = std::ranges::lower_bound(world.rigidNodes(), corner);
  return corners_[static_cast<std::size_t>(at - world.rigidNodes().begin())];
}

void RigidBodies::giveForces(yade::Scene& scene, const World& world, const StepLength& length,
                             ContactReactions& given) const {
  const ContactSurfaces& surfaces = world.surfaces;
  const Nodes& nodes = world.model.nodes;
  const auto isRigid = [&](EntryId entry) {
    return world.model.components[surfaces.component[entry.value].value].rigid;
  };
  for (const ContactRow& row : world.contact.rows()) {
    const bool ofSlave = isRigid(row.slave);
    if (!ofSlave && !isRigid(row.master)) continue;
    const EntryId entry = ofSlave ? row.slave : row.master;
    const RigidCorner& own = cornerOf(world, entry);
    const yade::Body& body = *members_[own.member].body;
    const double sign = ofSlave ? 1 : -1;
    // The forces act at the positions at the begin of the step.
    Vec2 point, velocity;
    for (std::size_t k = 0; k < static_cast<std::size_t>(row.count); ++k) {
      const std::uint32_t node = row.node[k].value;
      if (!world.model.components[nodes.component[node].value].rigid) continue;
      const Vec2 before = nodes.position[node] - length.position * nodes.velocity[node];
      point += sign * row.weight[k] * before;
      velocity +=
          sign * row.weight[k] / 2 * (world.formerVelocities()[node] + nodes.velocity[node]);
    }
    Vec2 force = sign * length.velocity / length.position * row.force();
    if (world.model.axisymmetric) force.x = point.x = 0;  // that of the other side is opposite
    const Vec2 arm = point - inPlane(body.state->se3.position);
    given.add(scene, {body.id, inSpace(force), Vector3r(0, 0, cross(arm, force)),
                      length.position * dot(force, velocity)});
  }
}

void RigidBodies::warnOfArcs(const World& world) {
  const ContactSurfaces& surfaces = world.surfaces;
  if (reportedArc_ || !surfaces.anySmooth()) return;
  std::map<std::uint32_t, const ContactRow*> pressed;  // by slave: at the begin of an arc
  for (const ContactRow& row : world.contact.rows())
    if (row.normalForce > 0 && surfaces.piece[row.slave.value] == Piece::kArc &&
        world.model.components[surfaces.component[row.master.value].value].rigid)
      pressed.emplace(row.slave.value, &row);
  const auto& places = world.model.nodes.position;
  for (const auto& [slave, row] : pressed) {
    const EntryId entry(slave);
    if (!pressed.contains(surfaces.next[slave].value)) continue;
    const Vec2 from = combine(surfaces.slave(entry), places);
    const double depth = dot(row->normal, from - combine(surfaces.master(entry, .5), places));
    const SegmentId segment = surfaces.entrySegment[slave];
    const NodeId begin = surfaces.segmentNode[segment.value],
                 end = surfaces.segmentNode[surfaces.segmentNext[segment.value].value];
    const double side = norm(places[end.value] - places[begin.value]);
    if (depth <= tolerance::kArcDepth * side) continue;
    reportedArc_ = true;
    const yade::Body& body = *members_[cornerOf(world, row->master).member].body;
    sentences_.push_back(fmt::format(
        "Body {} has smooth=True, but rests on {} #{} with two points of its curve, which enters "
        "by {:.3g} m between them, {:.3g} of a side: walls, boxes and facets have no points of "
        "their own, so that the body rolls like a polygon. A body of FESolver with fixed nodes, "
        "sides like those of the smooth one and passes=2 can take their place.",
        surfaces.component[slave].value, body.shape->getClassName(), body.id, depth, depth / side));
    return;
  }
}

}  // namespace yadefrag
