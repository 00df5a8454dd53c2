#include "loop/body_rows.hpp"

#include <cassert>
#include <cmath>
#include <typeinfo>

#include "core/parallel.hpp"

namespace yadefrag {

namespace {

// Steps after which all rows are made anew: bodies have moved along the curve, and contacts ended.
constexpr int kLongestAge = 128;
// Contacts per body from which rows save more than they cost.
constexpr std::size_t kContactsPerBody = 1;
// Bodies between the request of data from memory and their use: enough for the latency of one
// access.
constexpr std::size_t kAhead = 16;

const yade::Body* bodyAt(const yade::Scene& scene, yade::Body::id_t id) {
  const auto& bodies = scene.bodies->body;
  const auto index = static_cast<std::size_t>(id);
  return index < bodies.size() ? bodies[index].get() : nullptr;
}

// NaN for other shapes, which have contacts by YADE's functors only.
double radiusOf(const yade::Shape* shape) {
  if (shape == nullptr) return NAN;
  if (typeid(*shape) == typeid(yade::Sphere)) {  // faster than the cast
    return static_cast<const yade::Sphere*>(shape)->radius;
  }
  const auto* const sphere = dynamic_cast<const yade::Sphere*>(shape);
  return sphere ? sphere->radius : NAN;
}

// The arrays of thread 0, which runs the engines.
auto& forcesOf(yade::Scene& scene) { return (scene.forces.*exposed(ForceData{}))[0]; }
auto& torquesOf(yade::Scene& scene) { return (scene.forces.*exposed(TorqueData{}))[0]; }

}  // namespace

BodyRow BodyRows::read(const yade::Scene& scene, yade::Body::id_t id) {
  BodyRow row;
  row.body = bodyAt(scene, id);
  if (row.body == nullptr) return row;
#ifdef YADE_MPI
  row.subdomain = row.body->subdomain;
#endif
  const yade::State& state = *row.body->state;
  row.motion.position = state.se3.position;
  row.motion.velocity = state.vel;
  row.motion.spin = state.angVel;
  row.motion.radius = radiusOf(row.body->shape.get());
  return row;
}

void BodyRows::begin(yade::Scene& scene, std::size_t numContacts, int threads) {
  // YADE's functions make the arrays long enough.
  const auto last = static_cast<yade::Body::id_t>(scene.bodies->body.size()) - 1;
  scene.forces.addForce(last, yade::Vector3r::Zero());
  scene.forces.addTorque(last, yade::Vector3r::Zero());
  isInPlace_ = numContacts < kContactsPerBody * scene.bodies->body.size();
  if (!isInPlace_) return fill(scene, numContacts, threads);
  forces_ = forcesOf(scene).data();
  torques_ = torquesOf(scene).data();
  numSums_ = scene.bodies->body.size();
}

void BodyRows::fill(yade::Scene& scene, std::size_t numContacts, int threads) {
  if (++age_ > kLongestAge || scene.bodies->body.size() < rowOf_.size()) {
    age_ = 0;
    rowOf_.clear(), ids_.clear(), pairs_.clear();
  }
  rowOf_.resize(scene.bodies->body.size(), -1);
  pairs_.resize(numContacts);
  rows_.resize(ids_.size());
  startForces_.resize(ids_.size()), startTorques_.resize(ids_.size());
  // In the order of ids, which often is that of their memory.
  forEachPart(rowOf_.size(), threads, [&](std::size_t begin, std::size_t end, int) {
    for (std::size_t index = begin; index < end; ++index) {
      if (rowOf_[index] < 0) continue;
      const auto row = static_cast<std::size_t>(rowOf_[index]);
      rows_[row] = read(scene, static_cast<yade::Body::id_t>(index));
      startForces_[row] = forcesOf(scene)[index];
      startTorques_[row] = torquesOf(scene)[index];
    }
  });
  ownForces_ = startForces_, ownTorques_ = startTorques_;
  useOwnSums();
}

void BodyRows::useOwnSums() {
  forces_ = ownForces_.data(), torques_ = ownTorques_.data();
  numSums_ = ids_.size();
}

const PairRows& BodyRows::make(yade::Scene& scene, std::size_t place,
                               const yade::Interaction& contact) {
  PairRows& pair = pairs_[place];
  pair.id1 = contact.id1, pair.id2 = contact.id2;
  pair.row1 = rowFor(scene, pair.id1), pair.row2 = rowFor(scene, pair.id2);
  useOwnSums();
  return pair;
}

std::uint32_t BodyRows::rowFor(yade::Scene& scene, yade::Body::id_t id) {
  const auto index = static_cast<std::size_t>(id);
  assert(index < rowOf_.size());
  if (rowOf_[index] >= 0) return static_cast<std::uint32_t>(rowOf_[index]);
  rowOf_[index] = static_cast<int>(ids_.size());
  ids_.push_back(id);
  rows_.push_back(read(scene, id));
  startForces_.push_back(forcesOf(scene)[index]);
  startTorques_.push_back(torquesOf(scene)[index]);
  ownForces_.push_back(startForces_.back()), ownTorques_.push_back(startTorques_.back());
  return static_cast<std::uint32_t>(rowOf_[index]);
}

void BodyRows::giveForces(yade::Scene& scene) const {
  if (isInPlace_) return;
  // The difference is 0 unless a functor of YADE has added to this body.
  const auto put = [](yade::Vector3r& total, const yade::Vector3r& sum,
                      const yade::Vector3r& start) { total = sum + (total - start); };
  for (std::size_t row = 0; row < ids_.size(); ++row) {
    const auto index = static_cast<std::size_t>(ids_[row]);
    put(forcesOf(scene)[index], ownForces_[row], startForces_[row]);
    put(torquesOf(scene)[index], ownTorques_[row], startTorques_[row]);
  }
}

}  // namespace yadefrag
