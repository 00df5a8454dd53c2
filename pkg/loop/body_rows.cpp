#include "loop/body_rows.hpp"

#include <cassert>

#include "core/parallel.hpp"

namespace yadefrag {

namespace {

// Steps after which all rows are made anew: bodies have moved along the curve, and contacts ended.
constexpr int kLongestAge = 128;
// Bodies between the request of data from memory and their use: enough for the latency of one
// access.
constexpr std::size_t kAhead = 16;

template <class Object>
void request(const Object* object, std::size_t from, std::size_t to) {
  const auto* const bytes = reinterpret_cast<const char*>(object);
  for (std::size_t line = from; line < to; line += 64) __builtin_prefetch(bytes + line);
}

const yade::Body* bodyAt(const yade::Scene& scene, yade::Body::id_t id) {
  const auto& bodies = scene.bodies->body;
  const auto index = static_cast<std::size_t>(id);
  return index < bodies.size() ? bodies[index].get() : nullptr;
}

BodyRow readBody(const yade::Body* body) {
  BodyRow row;
  row.body = body;
  if (body == nullptr) return row;
#ifdef YADE_MPI
  row.subdomain = body->subdomain;
#endif
  const yade::State& state = *body->state;
  row.motion.position = state.se3.position;
  row.motion.velocity = state.vel;
  row.motion.spin = state.angVel;
  // Used for contacts of YADE's functor for two spheres only: of any other shape it has no meaning.
  if (body->shape) row.motion.radius = static_cast<const yade::Sphere&>(*body->shape).radius;
  return row;
}

}  // namespace

void BodyRows::fill(yade::Scene& scene, int threads) {
  // YADE's functions make the arrays of the calling thread, 0, long enough.
  const auto last = static_cast<yade::Body::id_t>(scene.bodies->body.size()) - 1;
  scene.forces.addForce(last, yade::Vector3r::Zero());
  scene.forces.addTorque(last, yade::Vector3r::Zero());
  if (++age_ > kLongestAge || scene.bodies->body.size() < rowOf_.size()) {
    age_ = 0;
    rowOf_.clear(), ids_.clear();
  }
  rowOf_.resize(scene.bodies->body.size(), -1);
  rows_.resize(ids_.size());
  starts_.resize(ids_.size());
  forEachPart(ids_.size(), threads, [&](std::size_t begin, std::size_t end, int) {
    for (std::size_t row = begin; row < end; ++row) {
      if (row + 2 * kAhead < end) request(bodyAt(scene, ids_[row + 2 * kAhead]), 0, 128);
      if (row + kAhead < end) {
        if (const yade::Body* next = bodyAt(scene, ids_[row + kAhead])) {
          request(next->state.get(), 64, 256);
          request(next->shape.get(), 64, 128);
        }
      }
      rows_[row] = readBody(bodyAt(scene, ids_[row]));
      starts_[row] = given(scene.forces, ids_[row]);
    }
  });
  sums_ = starts_;
}

void BodyRows::append(const yade::Scene& scene, std::size_t begin, std::size_t end) {
  for (std::size_t place = begin; place < end; ++place) {
    const yade::Interaction& contact = *(*scene.interactions)[place];
    for (const auto id : {contact.id1, contact.id2}) {
      appendOne(scene, id);
      request(&rows_[rowOf(id)], 0, sizeof(BodyRow));
      request(&sums_[rowOf(id)], 0, sizeof(Sum));
    }
  }
}

void BodyRows::appendOne(const yade::Scene& scene, yade::Body::id_t id) {
  const auto index = static_cast<std::size_t>(id);
  assert(index < rowOf_.size());
  if (rowOf_[index] >= 0) return;
  rowOf_[index] = static_cast<int>(ids_.size());
  ids_.push_back(id);
  rows_.push_back(readBody(bodyAt(scene, id)));
  starts_.push_back(given(scene.forces, id));
  sums_.push_back(starts_.back());
}

BodyRows::Sum BodyRows::given(const yade::ForceContainer& forces, yade::Body::id_t id) {
  const auto index = static_cast<std::size_t>(id);
  return {(forces.*exposed(ForceData{}))[0][index], (forces.*exposed(TorqueData{}))[0][index]};
}

void BodyRows::giveForces(yade::Scene& scene) const {
  auto& forces = (scene.forces.*exposed(ForceData{}))[0];
  auto& torques = (scene.forces.*exposed(TorqueData{}))[0];
  for (std::size_t row = 0; row < ids_.size(); ++row) {
    const auto index = static_cast<std::size_t>(ids_[row]);
    // The difference is 0 unless a functor of YADE has added to this body.
    const auto put = [](yade::Vector3r& total, const yade::Vector3r& sum,
                        const yade::Vector3r& start) { total = sum + (total - start); };
    put(forces[index], sums_[row].force, starts_[row].force);
    put(torques[index], sums_[row].torque, starts_[row].torque);
  }
}

}  // namespace yadefrag
