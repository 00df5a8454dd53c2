#include "solver/scene_watch.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

#include "core/tolerances/collider.hpp"
#include "materials/surface_segment.hpp"
#include "yade/gil.hpp"

namespace yadefrag {

namespace {

/// YADE derives cylinders and connections from Sphere, too.
bool isSphere(const yade::Shape& shape) {
  const std::string name = shape.getClassName();
  return name == "Sphere" || name == "GridNode";
}

}  // namespace

bool SceneWatch::check(const yade::Scene& scene) {
  const auto& bodies = scene.bodies->body;
  bool isNew = hasNewSpheres_ = false;
  checked_ = std::min(checked_, bodies.size());
  for (; checked_ < bodies.size(); ++checked_) {
    const yade::Body* body = bodies[checked_].get();
    if (!body || !body->shape) continue;
    if (dynamic_cast<const SurfaceSegment*>(body->shape.get())) continue;
    if (free_ < 0 && !body->isClumpMember() && body->isDynamic()) free_ = body->id;
    if (body->isClump() || !body->isBounded()) continue;
    isNew = noteShape(*body) || isNew;
    if (isSphere(*body->shape))
      isNew = noteSphere(*body, static_cast<const yade::Sphere&>(*body->shape).radius) || isNew;
  }
  return isNew;
}

bool SceneWatch::noteShape(const yade::Body& body) {
  const yade::Shape& shape = *body.shape;
  const auto isKnown = [&](const Kind& kind) { return *kind.type == typeid(shape); };
  if (std::any_of(kinds_.begin(), kinds_.end(), isKnown)) return false;
  kinds_.push_back({&typeid(shape), isSphere(shape) ? "Sphere" : shape.getClassName(), body.id});
  return true;
}

bool SceneWatch::noteSphere(const yade::Body& body, double radius) {
  bool isNew = false;
  const auto note = [&](bool is, yade::Body::id_t& first) {
    if (!is || first >= 0) return;
    first = body.id;
    isNew = true;
  };
  if (++spheres_ == 2) isNew = true;
  spheres_ = std::min(spheres_, 2);
  hasNewSpheres_ = true;
  largest_ = std::max(largest_, radius);
  const double height = std::abs(body.state->se3.position[2]);
  note(height >= radius, beside_);
  if (body.isClumpMember() || (body.state->blockedDOFs & yade::State::DOF_Z) != 0) return isNew;
  note(height > tolerance::kInPlane * radius || body.state->vel[2] != 0, leaving_);
  note(true, loose_);
  return isNew;
}

void SceneWatch::requireRound() const {
  for (const Kind& kind : kinds_)
    if (kind.name != "Wall" && kind.name != "Box")
      throw std::invalid_argument(fmt::format(
          "FESolver is axisymmetric, and body #{} has the shape {}: around the axis there can be "
          "only FE bodies, walls across it, and boxes on it.",
          kind.first, kind.name));
}

std::vector<std::string> SceneWatch::sentences(const yade::Vector3r& gravity, bool rigidBodies,
                                               double thickness) const {
  namespace py = yade::py;
  const WithGil gil;
  std::vector<std::string> result;
  try {
    py::dict kinds;
    for (const Kind& kind : kinds_)
      if (!kinds.has_key(kind.name)) kinds[kind.name] = kind.first;
    const py::object found = py::import("yadefrag.scene.scene_check")
                                 .attr("sentences")(kinds, spheres_, beside_, leaving_, loose_,
                                                    gravity[2], rigidBodies, largest_, thickness);
    for (py::ssize_t i = 0; i < py::len(found); ++i)
      result.push_back(py::extract<std::string>(found[i]));
  } catch (const py::error_already_set&) {
    PyErr_Clear();  // a failed warning must not stop a run
  }
  return result;
}

namespace {

constexpr const char* kOrder =
    "; the order is ForceResetter, collider, InteractionLoop, FESolver, NewtonIntegrator.";

using Engines = std::vector<const yade::Engine*>;

/// True for derived engines, too: CurveLoop is an InteractionLoop.
template <class Kind>
bool isA(const yade::Engine* engine) {
  return dynamic_cast<const Kind*>(engine) != nullptr;
}
bool resetsForces(const yade::Engine* engine) { return engine->getClassName() == "ForceResetter"; }

/// Engines run in a cycle: after the engine at `from`, which adds forces to bodies, `user` must run
/// before a reset of forces.
void requireForces(const Engines& engines, std::size_t from, const yade::Engine* user) {
  for (std::size_t i = 1; i < engines.size(); ++i) {
    const yade::Engine* const next = engines[(from + i) % engines.size()];
    if (next == user) return;
    if (resetsForces(next))
      throw std::invalid_argument("O.engines: ForceResetter deletes the forces of " +
                                  engines[from]->getClassName() + " before " +
                                  user->getClassName() + " has used them" + kOrder);
  }
}

/// True if NewtonIntegrator uses the forces of the engine at `from` before `solver`.
bool movesBefore(const Engines& engines, std::size_t from, const yade::Engine& solver) {
  for (std::size_t i = 1; i < engines.size(); ++i) {
    const yade::Engine* const next = engines[(from + i) % engines.size()];
    if (next == &solver) return false;
    if (isA<yade::NewtonIntegrator>(next)) return true;
  }
  return false;
}

Engines aliveIn(const yade::Scene& scene) {
  Engines alive;
  for (const auto& engine : scene.engines)
    if (!engine->dead) alive.push_back(engine.get());
  return alive;
}

}  // namespace

void EngineOrder::requireReturn(const yade::Scene& scene, const yade::Engine& solver,
                                bool anyMovable) {
  const Engines alive = aliveIn(scene);
  const auto own = std::ranges::find(alive, &solver);
  if (own == alive.end()) return;
  for (auto behind = own; behind != alive.end(); ++behind)
    if (resetsForces(*behind))
      throw std::invalid_argument(
          std::string("O.engines: ForceResetter behind FESolver deletes the forces of contact on "
                      "walls, boxes and facets within the step, so that O.forces would show none") +
          kOrder);
  if (!anyMovable) return;
  for (const yade::Engine* user : alive) {
    if (!isA<yade::NewtonIntegrator>(user)) continue;
    if (std::ranges::none_of(alive, resetsForces))
      throw std::invalid_argument(
          std::string("O.engines has a NewtonIntegrator and no ForceResetter: the forces on clumps "
                      "of all steps would add up") +
          kOrder);
    requireForces(alive, static_cast<std::size_t>(own - alive.begin()), user);
  }
}

bool EngineOrder::require(const yade::Scene& scene, const yade::Engine& solver) {
  std::vector<Item> items;
  for (const auto& engine : scene.engines) {
    const yade::Engine& one = *engine;
    items.push_back({&typeid(one), &one == &solver, one.dead});
  }
  if (items == checked_) return false;
  checked_.clear();
  const Engines alive = aliveIn(scene);
  const auto count = std::count(alive.begin(), alive.end(), &solver);
  if (count > 1)
    throw std::invalid_argument(
        "O.engines has the same FESolver more than once; it must be there once.");
  bool moveFirst = false;
  for (std::size_t i = 0; i < alive.size() && count == 1; ++i) {
    if (!isA<yade::InteractionLoop>(alive[i])) continue;
    if (std::ranges::none_of(alive, resetsForces))
      throw std::invalid_argument(
          std::string("O.engines has an InteractionLoop and no ForceResetter: the forces of all "
                      "steps would add up") +
          kOrder);
    for (const yade::Engine* user : alive)
      if (user == &solver || isA<yade::NewtonIntegrator>(user)) requireForces(alive, i, user);
    moveFirst = moveFirst || movesBefore(alive, i, solver);
  }
  spheresMoveFirst_ = moveFirst;
  checked_.swap(items);
  return true;
}

}  // namespace yadefrag
