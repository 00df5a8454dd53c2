#include "loop/body_rows.hpp"

#include <algorithm>
#include <cmath>
#include <typeinfo>

#include "core/request.hpp"
#include "yade/helpers.hpp"

namespace yadefrag {

namespace {

// Contacts per body from which rows save more than they cost.
constexpr std::size_t kContactsPerBody = 1;
// Bodies between the request of data from memory and their use: enough for the latency of one
// access.
constexpr std::size_t kAhead = 8;

// NaN for other shapes, which have contacts by YADE's functors only.
double radiusOf(const yade::Shape* shape) {
  if (shape == nullptr) return NAN;
  if (typeid(*shape) == typeid(yade::Sphere)) {  // faster than the cast
    return static_cast<const yade::Sphere*>(shape)->radius;
  }
  const auto* const sphere = dynamic_cast<const yade::Sphere*>(shape);
  return sphere ? sphere->radius : NAN;
}

// YADE's sum is 0 unless one of its functors has added to this body.
void addTo(yade::Vector3r& total, const FourLanes& sum) {
  storeThree(sum + loadThree(total.data()), total.data());
}

// The arrays of thread 0, which runs the engines.
auto& forcesOf(yade::Scene& scene) { return (scene.forces.*exposed(ForceData{}))[0]; }
auto& torquesOf(yade::Scene& scene) { return (scene.forces.*exposed(TorqueData{}))[0]; }

}  // namespace

unsigned BodyRows::flagsOf([[maybe_unused]] const yade::Scene& scene, const yade::Body* body) {
  if (!hasMotion(body)) return 0;
#ifdef YADE_MPI
  if (body->subdomain != scene.subdomain) return kExists;
#endif
  return kExists | kIsHere;
}

void BodyRows::read(const yade::Body& body, BodyRow& row) {
  row.setMotion(*body.state, radiusOf(body.shape.get()));
}

bool BodyRows::isLocal(const yade::Scene& scene, const yade::Interaction& contact) {
  return isLocal(flagsOf(scene, bodyAt(scene.bodies->body, contact.id1)),
                 flagsOf(scene, bodyAt(scene.bodies->body, contact.id2)));
}

void BodyRows::begin(yade::Scene& scene, std::size_t numContacts, Use use, const More& more,
                     int threads) {
  // YADE's functions make the arrays long enough.
  numBodies_ = scene.bodies->body.size();
  if (numBodies_ > 0) {
    const auto last = static_cast<yade::Body::id_t>(numBodies_) - 1;
    scene.forces.addForce(last, yade::Vector3r::Zero());
    scene.forces.addTorque(last, yade::Vector3r::Zero());
  }
  isInPlace_ = use == Use::kNone || numContacts < kContactsPerBody * numBodies_;
  areSumsUsed_ = !isInPlace_ && use == Use::kMotionAndSums;
  more_ = more;
  if (!isInPlace_) return fill(scene, numContacts, threads);
  forces_ = forcesOf(scene).data();
  torques_ = torquesOf(scene).data();
}

void BodyRows::fill(yade::Scene& scene, std::size_t numContacts, int threads) {
  areValid_ = areValid_ && numBodies_ >= rowOf_.size() && numNew_ * kNewShare <= numContacts;
  if (!areValid_) {
    rowOf_.clear(), rows_.clear(), flags_.clear(), firstPlaces_.clear(), pairs_.clear(),
        contacts_.clear();
  }
  rowOf_.resize(numBodies_, -1);
  masses_.resize(more_.masses ? rows_.size() : 0);
  orientations_.resize(more_.orientations ? rows_.size() : 0);
  pairs_.resize(numContacts), contacts_.resize(numContacts);
  // In the order of ids, which often is that of their memory.
  forEachPart(rowOf_.size(), threads, [&](std::size_t begin, std::size_t end, int) {
    for (std::size_t id = begin; id < end; ++id) {
      requestAhead(scene, id);
      if (rowOf_[id] >= 0) fillRow(scene, id, static_cast<std::size_t>(rowOf_[id]));
    }
  });
  if (areOthers_.exchange(false)) {
    for (PairRows& pair : pairs_) pair.geom = nullptr;
  }
}

// What a row reads, and the row.
[[gnu::always_inline]] inline void BodyRows::requestAhead(const yade::Scene& scene,
                                                          std::size_t id) const {
  using yade::Body, yade::State;
  if (const Body* const body = bodyAt(scene.bodies->body, id + 2 * kAhead)) {
    yadefrag::request(body, offsetof(Body, state), offsetof(Body, shape) + sizeof(Body::shape));
  }
  const Body* const body = bodyAt(scene.bodies->body, id + kAhead);
  if (body == nullptr || rowOf_[id + kAhead] < 0) return;
  yadefrag::request(body->state.get(), offsetof(State, se3),
                    offsetof(State, angVel) + sizeof(State::angVel));
  yadefrag::request(body->shape.get(), offsetof(yade::Sphere, radius), sizeof(yade::Sphere));
  if (more_.masses) requestLine(&body->state->blockedDOFs);
  const double* const values = rows_[static_cast<std::size_t>(rowOf_[id + kAhead])].values;
  requestLine(values), requestLine(values + 8);
}

[[gnu::always_inline]] inline void BodyRows::fillRow(yade::Scene& scene, std::size_t id,
                                                     std::size_t row) {
  const yade::Body* const body = bodyAt(scene.bodies->body, id);
  flags_[row] = static_cast<unsigned char>(flagsOf(scene, body));
  if (flags_[row] == 0) return;
  const bool wasSphere = !std::isnan(rows_[row].radius());
  read(*body, rows_[row]);
  if (wasSphere && std::isnan(rows_[row].radius())) areOthers_ = true;
  if (more_.masses) masses_[row] = massOf(*body);
  if (more_.orientations)
    storeFour(loadFour(body->state->se3.orientation.coeffs().data()), orientations_[row].data());
  if (!areSumsUsed_) return;
  double *const force = forcesOf(scene)[id].data(), *const torque = torquesOf(scene)[id].data();
  rows_[row].setSums(loadThree(force), loadThree(torque));
  storeThree(FourLanes{}, force), storeThree(FourLanes{}, torque);
}

void BodyRows::findPairs(yade::Scene& scene, int threads) {
  const auto list = [&](std::size_t begin, std::size_t end, auto& changed) {
    for (std::size_t place = begin; place < end; ++place) {
      if (contacts_[place] != (*scene.interactions)[place]) changed.push_back(place);
    }
  };
  listInParts(pairs_.size(), threads, changedByPart_, changed_, list);
  for (const std::size_t place : changed_) makePair(scene, place);
  numNew_ += changed_.size();
  if (!areValid_) areValid_ = true, numNew_ = 0;
}

void BodyRows::makePair(yade::Scene& scene, std::size_t place) {
  contacts_[place] = (*scene.interactions)[place];
  const yade::Interaction& contact = *contacts_[place];
  PairRows& pair = pairs_[place];
  pair.id1 = contact.id1;
  pair.row1 = rowFor(scene, contact.id1, place), pair.row2 = rowFor(scene, contact.id2, place);
  pair.geom = nullptr;
}

std::uint32_t BodyRows::rowFor(yade::Scene& scene, yade::Body::id_t id, std::size_t place) {
  const auto index = static_cast<std::size_t>(id);
  // A script may have removed all bodies, and left the interactions.
  if (index >= rowOf_.size()) rowOf_.resize(index + 1, -1);
  if (rowOf_[index] < 0) {
    rowOf_[index] = static_cast<int>(rows_.size());
    rows_.emplace_back(), flags_.emplace_back();
    if (more_.masses) masses_.emplace_back();
    if (more_.orientations) orientations_.emplace_back();
    firstPlaces_.push_back(static_cast<std::uint32_t>(place));
    fillRow(scene, index, rows_.size() - 1);
  }
  const auto row = static_cast<std::uint32_t>(rowOf_[index]);
  firstPlaces_[row] = std::min(firstPlaces_[row], static_cast<std::uint32_t>(place));
  return row;
}

void BodyRows::giveForce(yade::Scene& scene, yade::Body::id_t id) {
  const auto index = static_cast<std::size_t>(id);
  const BodyRow& row = rows_[static_cast<std::size_t>(rowOf_[index])];
  addTo(forcesOf(scene)[index], row.force()), addTo(torquesOf(scene)[index], row.torque());
}

void BodyRows::takeForce(yade::Scene& scene, yade::Body::id_t id) {
  const auto index = static_cast<std::size_t>(id);
  double* const force = forcesOf(scene)[index].data();
  double* const torque = torquesOf(scene)[index].data();
  rows_[static_cast<std::size_t>(rowOf_[index])].setSums(loadThree(force), loadThree(torque));
  storeThree(FourLanes{}, force), storeThree(FourLanes{}, torque);
}

void BodyRows::giveForces(yade::Scene& scene, int threads) const {
  if (!areSumsUsed_) return;
  auto &forces = forcesOf(scene), &torques = torquesOf(scene);
  forEachPart(rowOf_.size(), threads, [&](std::size_t begin, std::size_t end, int) {
    for (std::size_t id = begin; id < end; ++id) {
      if (id + kAhead < end && rowOf_[id + kAhead] >= 0) {
        const BodyRow& next = rows_[static_cast<std::size_t>(rowOf_[id + kAhead])];
        requestLine(next.values + 8);
      }
      if (rowOf_[id] < 0) continue;
      const auto row = static_cast<std::size_t>(rowOf_[id]);
      if (flags_[row] == 0) continue;
      addTo(forces[id], rows_[row].force());
      addTo(torques[id], rows_[row].torque());
    }
  });
}

}  // namespace yadefrag
