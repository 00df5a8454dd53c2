#include "bodies/rigid_movers.hpp"

#include <algorithm>
#include <cmath>

#include "core/tolerances/spheres.hpp"
#include "yade/helpers.hpp"

namespace yadefrag {

using yade::Quaternionr;

bool isWall(const yade::Body& body) {
  return dynamic_cast<const yade::Wall*>(body.shape.get()) != nullptr;
}

RigidPose::RigidPose(const yade::Body& body, double dt)
    : position(body.state->se3.position + dt * body.state->vel) {
  if (isWall(body)) return;
  orientation = body.state->se3.orientation;
  const double angle = dt * body.state->angVel.norm();
  if (angle > 0)
    orientation =
        Quaternionr(Eigen::AngleAxis<double>(angle, body.state->angVel.normalized())) * orientation;
}

FormerCorners::FormerCorners(std::span<const RigidCorner> corners,
                             std::span<const yade::Body* const> bodies,
                             std::span<const Vec2> places) {
  for (std::uint32_t i = 0; i < corners.size(); ++i) {
    const yade::Body* body = bodies[corners[i].member];
    if (!body) continue;
    const yade::Vector3r here = RigidPose(*body).place(corners[i].place);
    sides_[body].push_back(
        {i, places[i], places[corners[i].following], places[i] - Vec2{here[0], here[1]}});
  }
}

FormerCorners::Found FormerCorners::take(const yade::Body& body, Vec2 begin, Vec2 end,
                                         double farthest) {
  const auto known = sides_.find(&body);
  if (known == sides_.end() || known->second.empty()) return {World::kNoCorner, begin};
  std::vector<Side>& sides = known->second;
  const auto away = [&](const Side& side) {
    return std::max(norm(side.begin - begin), norm(side.end - end));
  };
  const bool wall = isWall(body);
  const auto nearest = wall ? sides.begin() : std::ranges::min_element(sides, {}, away);
  if (!wall && !(away(*nearest) <= farthest)) return {World::kNoCorner, begin};
  const Found found{nearest->number, wall ? begin + nearest->lag : nearest->begin};
  sides.erase(nearest);
  return found;
}

namespace {

using yade::Quaternionr;
using yade::State;
using yade::Vector3r;

bool isFree(const State& state, unsigned axis) { return (state.blockedDOFs & axis) == 0; }

/// Without the components of blocked directions; `first`: the flag of the first of three.
Vector3r freePart(const State& state, Vector3r vector, unsigned first) {
  for (int i = 0; i < 3; ++i)
    if (!isFree(state, first << i)) vector[i] = 0;
  return vector;
}

/// The integrator uses the tensor of inertia only if all rotations are free.
bool usesTensor(const yade::NewtonIntegrator& newton, const yade::Body& mover) {
  const unsigned rotations = State::DOF_RX | State::DOF_RY | State::DOF_RZ;
  return newton.exactAsphericalRot && (mover.flags & yade::Body::FLAG_ASPHERICAL) != 0 &&
         (mover.state->blockedDOFs & rotations) == 0;
}

/// M⁻¹ of the rotation about the centre, for a vector in the scene's frame.
Vector3r turned(const yade::Body& body, bool aspherical, const Vector3r& moment) {
  const State& state = *body.state;
  if (!aspherical) return moment.cwiseQuotient(state.inertia);
  const Quaternionr& frame = state.se3.orientation;
  return frame * (frame.conjugate() * moment).cwiseQuotient(state.inertia);
}

}  // namespace

const yade::Body& moverOf(const yade::Scene& scene, const yade::Body& body) {
  const yade::Body* clump = body.isClumpMember() ? bodyAt(scene, body.clumpId) : nullptr;
  return clump ? *clump : body;
}

bool obeysForces(const yade::NewtonIntegrator* newton, const yade::Body& mover) {
  const State& state = *mover.state;
  const unsigned plane = State::DOF_X | State::DOF_Y | State::DOF_RZ;
  if (!newton || (state.blockedDOFs & plane) == plane || !(state.mass > 0)) return false;
  return newton->mask <= 0 || (newton->mask & mover.groupMask) != 0;
}

bool lacksInertia(const State& state) {
  for (int i = 0; i < 3; ++i) {
    if (isFree(state, State::DOF_X << i) && !(state.mass > 0)) return true;
    if (isFree(state, State::DOF_RX << i) && !(state.inertia[i] > 0)) return true;
  }
  return false;
}

std::optional<double> neglectedMoment(const yade::NewtonIntegrator& newton,
                                      const yade::Body& mover) {
  const State& state = *mover.state;
  if (!isFree(state, State::DOF_RZ) || usesTensor(newton, mover)) return std::nullopt;
  const Vector3r z = state.se3.orientation.conjugate() * Vector3r::UnitZ();
  const double moment = z.cwiseAbs2().dot(state.inertia);
  if (std::abs(moment - state.inertia[2]) <= tolerance::kSameMoment * moment) return std::nullopt;
  return moment;
}

Vector3r FreeMotion::place(const Vector3r& before) const {
  Vector3r arm = before - centre;
  const double angle = dt * spin.norm();
  if (angle > 0) arm = Eigen::AngleAxis<double>(angle, spin.normalized()) * arm;
  return centre + dt * velocity + arm;
}

RigidMass FreeMotion::mass() const {
  const Vector3r after = centre + dt * velocity;
  return {{centre[0], centre[1]}, {after[0], after[1]}, mobility, turning};
}

const std::vector<yade::Body::id_t>& RigidMovers::membersOf(const yade::Scene& scene,
                                                            const yade::Body& clump) {
  if (known_ != scene.bodies->body.size()) forget();
  known_ = scene.bodies->body.size();
  const auto [at, isNew] = members_.try_emplace(clump.id);
  if (isNew)
    for (const auto& body : scene.bodies->body)
      if (body && body->isClumpMember() && body->clumpId == clump.id)
        at->second.push_back(body->id);
  return at->second;
}

/// As NewtonIntegrator without damping.
FreeMotion RigidMovers::motionOf(yade::Scene& scene, const yade::NewtonIntegrator& newton,
                                 const yade::Body& mover) {
  const State& state = *mover.state;
  const Vector3r centre = state.se3.position;
  Vector3r force = scene.forces.getForce(mover.id), moment = scene.forces.getTorque(mover.id);
  if (mover.isClump())
    for (const yade::Body::id_t id : membersOf(scene, mover)) {
      const yade::Body* member = scene.bodies->body[static_cast<std::size_t>(id)].get();
      if (!member || member->clumpId != mover.id) continue;
      const Vector3r one = scene.forces.getForce(id);
      force += one;
      moment += scene.forces.getTorque(id) + (member->state->se3.position - centre).cross(one);
    }
  const bool isWall = dynamic_cast<const yade::Wall*>(mover.shape.get()) != nullptr;
  FreeMotion motion{scene.dt, centre, state.vel, isWall ? Vector3r::Zero() : state.angVel, {}, 0};
  motion.velocity += scene.dt * freePart(state, force / state.mass + newton.gravity, State::DOF_X);
  motion.mobility = {isFree(state, State::DOF_X) ? 1 / state.mass : 0,
                     isFree(state, State::DOF_Y) ? 1 / state.mass : 0};
  if (isWall || !(state.inertia.minCoeff() > 0)) return motion;
  const bool aspherical = usesTensor(newton, mover);
  const Vector3r gained = scene.dt * freePart(state, moment, State::DOF_RX);
  motion.spin = aspherical ? turned(mover, true, state.angMom + gained)
                           : Vector3r(state.angVel + turned(mover, false, gained));
  if (isFree(state, State::DOF_RZ))
    motion.turning = turned(mover, aspherical, Vector3r::UnitZ())[2];
  return motion;
}

}  // namespace yadefrag
