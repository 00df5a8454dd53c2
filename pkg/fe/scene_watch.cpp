#include "fe/scene_watch.hpp"

#include <algorithm>
#include <cmath>

#include "core/tolerances/collider.hpp"
#include "entries/surface_segment.hpp"
#include "script/with_gil.hpp"

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

}  // namespace yadefrag
