#include "loop/curve_loop.hpp"

#include <cstddef>

#include "core/lanes.hpp"
#include "core/parallel.hpp"
#include "core/request.hpp"
#include "loop/known_laws.hpp"
#include "yade/helpers.hpp"
#include "yade/running.hpp"

namespace yadefrag {

namespace {

// Parts of the contacts for each of several threads: enough that all threads end at the same time,
// few enough that few bodies have contacts in two of them. The results do not depend on it.
constexpr std::size_t kPartsPerThread = 2;
// Contacts between the request of data from memory and their use: enough for the latency of one
// access.
constexpr std::size_t kAhead = 8;

const InstructionSet kInstructions = bestInstructionSet();

}  // namespace

void ContactLoop::action() try {
  fastGeometries = fastForces = 0;
  threads = 0;
  // A list sorted for debugging: YADE's own loop.
  if (loopOnSortedInteractions) return yade::InteractionLoop::action();
  const auto update = [this](auto& dispatcher) {
    dispatcher.scene = scene;
    for (const auto& functor : dispatcher.functors) functor->scene = scene;
  };
  update(*geomDispatcher), update(*physDispatcher), update(*lawDispatcher);

  const std::size_t size = scene->interactions->size();
  if (size == 0) return;
  threads = threadsFor(size, threadsOf(*this));
  withLaw(*this, *scene, [&]<class Law>(typename Law::Functor* functor) {
    const PairStep<Law> step(*this, *scene, functor);
    run(step, size);
    if constexpr (kTracesEnergy<Law>) {
      if (fastForces > 0 && step.tracesEnergy()) addEnergies<Law>(*functor);
    }
  });
} catch (const std::exception& error) {
  noteStop(error.what());
  throw;
}

template <class Law>
void ContactLoop::run(const PairStep<Law>& step, std::size_t size) {
  if (step.functors() != functors_) rows_.forget();
  functors_ = step.functors();
  using enum BodyRows::Use;
  rows_.begin(*scene, size,
              !step.computesGeometry() ? kNone
              : step.computesForces()  ? kMotionAndSums
                                       : kMotion,
              {.masses = Law::kUsesMasses && step.computesForces(),
               .orientations = kUsesRotations<Law> && step.computesForces()},
              threads);
  if (!rows_.isInPlace()) rows_.findPairs(*scene, threads);
  evaluate(step, size);
  addLater();
  rows_.giveForces(*scene, threads);
  if (fastForces > 0) memory_.endStep<ContactOf<Law>, typename Law::Phys>(*scene);
}

template <class Law>
void ContactLoop::addEnergies(typename Law::Functor& functor) const {
  Law::addEnergies(functor, *scene->energy, [this](const auto& visit) {
    for (const Part& part : parts_)
      for (const ContactEnergy& one : part.energies) visit(one);
  });
}

template <class Law>
[[gnu::always_inline]] inline void ContactLoop::requestAhead(std::size_t place, std::size_t size) {
  using yade::Interaction;
  if (place + 2 * kAhead < size) {
    const auto* const contact =
        reinterpret_cast<const char*>((*scene->interactions)[place + 2 * kAhead].get());
    requestLine(contact + offsetof(Interaction, id1));
    requestLine(contact + offsetof(Interaction, phys));
    const PairRows& pair = rows_(place + 2 * kAhead);
    pair.request<Law::kBytes>();
    // A contact that has not begun: its functor.
    if (!pair.geom) requestLine(contact + offsetof(Interaction, functorCache.geom));
  }
  if (place + kAhead < size) rows_.request(rows_(place + kAhead));
}

// For contacts that are evaluated in place: from the interaction to its bodies, then to what these
// refer to. Each request reads what the one before has brought.
[[gnu::always_inline]] inline void ContactLoop::requestInPlace(std::size_t place,
                                                               std::size_t size) const {
  using yade::Body, yade::Interaction, yade::State, yade::Sphere;
  const auto& interactions = *scene->interactions;
  const auto& bodies = scene->bodies->body;
  const auto forBoth = [&](std::size_t at, const auto& visit) __attribute__((always_inline)) {
    if (at >= size) return;
    // A script may have removed all bodies, and left the interactions.
    for (const auto id : {interactions[at]->id1, interactions[at]->id2})
      if (static_cast<std::size_t>(id) < bodies.size()) visit(static_cast<std::size_t>(id));
  };
  if (place + 4 * kAhead < size) {
    request(interactions[place + 4 * kAhead].get(), offsetof(Interaction, functorCache),
            sizeof(Interaction));
  }
  forBoth(
      place + 3 * kAhead, [&](std::size_t id)
                              __attribute__((always_inline)) { requestLine(bodies.data() + id); });
  forBoth(
      place + 2 * kAhead, [&](std::size_t id) __attribute__((always_inline)) {
        request(bodies[id].get(), offsetof(Body, state),
                offsetof(Body, shape) + sizeof(Body::shape));
      });
  if (place + 2 * kAhead < size) {
    const Interaction& contact = *interactions[place + 2 * kAhead];
    request(contact.geom.get(), 0, sizeof(yade::ScGeom));
    request(contact.phys.get(), 0, sizeof(yade::FrictPhys));
  }
  if (place + kAhead >= size) return;
  // Of bodies that do not touch only the places are used.
  const bool areTouching = interactions[place + kAhead]->geom != nullptr;
  forBoth(
      place + kAhead, [&](std::size_t id) __attribute__((always_inline)) {
        if (!bodies[id]) return;
        request(bodies[id]->state.get(), offsetof(State, se3),
                areTouching ? offsetof(State, angVel) + sizeof(State::angVel)
                            : offsetof(State, se3) + sizeof(yade::Vector3r));
        request(bodies[id]->shape.get(), offsetof(Sphere, radius), sizeof(Sphere));
        if (areTouching) rows_.requestSums(id);
      });
}

template <class Law>
void ContactLoop::evaluate(const PairStep<Law>& step, std::size_t size) {
  const std::size_t count = threads == 1 ? 1 : kPartsPerThread * static_cast<std::size_t>(threads);
  parts_.resize(count);
  const auto evaluateOne = [&](std::size_t number) {
    Part& part = parts_[number];
    part.begin = size * number / count, part.end = size * (number + 1) / count;
    runFor(
        kInstructions, [&]() __attribute__((always_inline)) { evaluatePart(step, size, part); });
  };
  forEachItem(count, size, threads, evaluateOne, 1);
  for (const Part& part : parts_) fastGeometries += part.geometries, fastForces += part.forces;
}

// Most of the time of a step is spent here: without the attributes a compiler that sees many
// sources at once leaves vector products as calls.
template <class Law>
[[gnu::always_inline]] inline void ContactLoop::evaluatePart(const PairStep<Law>& step,
                                                             std::size_t size, Part& part) {
  Evaluation<Law> evaluation{step};
  part.later.clear(), part.energies.clear();
  for (std::size_t place = part.begin; place < part.end; ++place) {
    if (!evaluateContact(evaluation, place, size)) continue;
    ++evaluation.forces;
    const auto& contact = evaluation.force;
    add(evaluation.row1, contact.force, contact.torque1, part);
    add(evaluation.row2, -contact.force, contact.torque2, part);
    if constexpr (kTracesEnergy<Law>) {
      if (step.tracesEnergy()) part.energies.push_back(contact.energy);
    }
    // Apart, as YADE adds it: a sum of both torques would have other bits.
    if constexpr (requires { contact.moment; }) {
      if (!contact.hasMoment) continue;
      add(evaluation.row1, FourLanes{}, -contact.moment, part);
      add(evaluation.row2, FourLanes{}, contact.moment, part);
    }
  }
  part.geometries = evaluation.fast, part.forces = evaluation.forces;
}

template <class Law>
[[gnu::always_inline]] inline bool ContactLoop::evaluateContact(Evaluation<Law>& evaluation,
                                                                std::size_t place,
                                                                std::size_t size) {
  const Contact& contact = (*scene->interactions)[place];
  if (rows_.isInPlace()) {
    if (evaluation.step.usesMotion()) requestInPlace(place, size);
    return evaluateInPlace(evaluation, contact);
  }
  requestAhead<Law>(place, size);
  PairRows& pair = rows_(place);
  if (!rows_.isLocal(pair)) {
    contact->reset();
    return false;
  }
  if (!pair.isKnown(*contact) || evaluation.step.isException(*pair.phys)) {
    if (pair.isInOrder(*contact) &&
        evaluation.step.isFarApart(*contact, rows_[pair.row1], rows_[pair.row2])) {
      return false;
    }
    return evaluateGeneral(evaluation, contact, pair);
  }
  ++evaluation.fast;
  evaluation.row1 = pair.row1, evaluation.row2 = pair.row2;
  const auto masses = [&]() __attribute__((always_inline)) {
    return std::pair(rows_.mass(pair.row1), rows_.mass(pair.row2));
  };
  const auto turns = [&]() __attribute__((always_inline)) { return rows_.orientations(pair); };
  return evaluation.step.evaluateKnown(*contact, pair, rows_[pair.row1], rows_[pair.row2], masses,
                                       turns, evaluation.force);
}

template <class Law>
bool ContactLoop::evaluateGeneral(Evaluation<Law>& evaluation, const Contact& contact,
                                  PairRows& pair) {
  pair.matchOrder(*contact);
  const auto call = [&] {
    return evaluation.step.evaluate(contact, rows_[pair.row1], rows_[pair.row2], evaluation.fast,
                                    evaluation.force);
  };
  // With several threads YADE's law adds to the sums of its thread.
  const bool isGiven =
      threads == 1 && evaluation.step.computesForces() && evaluation.step.isForYade(*contact);
  const bool isForce = isGiven ? rows_.withSums(*scene, *contact, call) : call();
  pair.matchOrder(*contact);
  pair.note(*contact, evaluation.step.isKnown(*contact), evaluation.step.areSpheres(*contact));
  evaluation.row1 = pair.row1, evaluation.row2 = pair.row2;
  return isForce;
}

template <class Law>
bool ContactLoop::evaluateInPlace(Evaluation<Law>& evaluation, const Contact& contact) const {
  if (evaluation.step.computesGeometry() && evaluation.step.isFarApart(*contact)) return false;
  if (!BodyRows::isLocal(*scene, *contact)) {
    contact->reset();
    return false;
  }
  BodyRow one, two;
  if (evaluation.step.usesMotion()) {
    const auto& bodies = scene->bodies->body;
    BodyRows::read(*bodies[static_cast<std::size_t>(contact->id1)], one);
    BodyRows::read(*bodies[static_cast<std::size_t>(contact->id2)], two);
  }
  const bool isForce =
      evaluation.step.evaluate(contact, one, two, evaluation.fast, evaluation.force);
  evaluation.row1 = static_cast<std::uint32_t>(contact->id1);
  evaluation.row2 = static_cast<std::uint32_t>(contact->id2);
  return isForce;
}

// The sums of a body are the same for any number of threads: the first part with contacts of the
// body adds to them at once, the others after it, each in the order of the contacts.
[[gnu::always_inline]] inline void ContactLoop::add(std::uint32_t row, const FourLanes& force,
                                                    const FourLanes& torque, Part& part) {
  if (part.begin == 0 || rows_.isFirstIn(row, part.begin)) return rows_.add(row, force, torque);
  BodyForce& later = part.later.emplace_back();
  storeThree(force, later.force), storeThree(torque, later.torque);
  later.row = row;
}

void ContactLoop::addLater() {
  if (parts_.size() == 1) return;
  forEachPart(rows_.numSums(), threads, [&](std::size_t begin, std::size_t end, int) {
    for (const Part& part : parts_) {
      for (const BodyForce& later : part.later) {
        if (later.row < begin || later.row >= end) continue;
        rows_.add(later.row, loadThree(later.force), loadThree(later.torque));
      }
    }
  });
}

}  // namespace yadefrag
