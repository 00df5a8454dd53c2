#include "loop/curve_loop.hpp"

#include <omp.h>

#include <algorithm>
#include <cstddef>
#include <utility>

#include "abi/request.hpp"
#include "core/instruction_set.hpp"
#include "core/parallel.hpp"

namespace yadefrag {

namespace {

// Contacts that a thread takes at once: enough that taking them costs nothing, few enough that all
// threads end at the same time. The results do not depend on it.
constexpr std::size_t kContactsAtOnce = 128;
// Contacts between the request of data from memory and their use: enough for the latency of one
// access.
constexpr std::size_t kAhead = 8;

const InstructionSet kInstructions = bestInstructionSet();

}  // namespace

void ContactLoop::action() {
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
  const int most = omp_get_max_threads();
  threads = threadsFor(size, ompThreads > 0 ? std::min(ompThreads, most) : most);
  const PairStep step(*this, *scene);
  if (step.functors() != functors_) rows_.forget();
  functors_ = step.functors();
  rows_.begin(*scene, size, step.computesGeometry(), threads);
  if (threads > 1) {
    runInParallel(step, size);
  } else {
    runFor(
        kInstructions, [&]() __attribute__((always_inline)) { run(step, size); });
  }
  if (fastForces == 0) return;
  rows_.giveForces(*scene, threads);
  memory_.endStep(*scene);
}

[[gnu::always_inline]] inline void ContactLoop::requestAhead(std::size_t place, std::size_t size) {
  using yade::Interaction;
  if (place + 2 * kAhead < size) {
    const PairRows& pair = rows_(place + 2 * kAhead);
    const char* const contact =
        reinterpret_cast<const char*>((*scene->interactions)[place + 2 * kAhead].get());
    __builtin_prefetch(contact + offsetof(Interaction, id1));
    __builtin_prefetch(contact + offsetof(Interaction, phys));
    pair.request();
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
  const auto forBoth = [&](std::size_t at, const auto& visit) {
    if (at >= size) return;
    visit(static_cast<std::size_t>(interactions[at]->id1));
    visit(static_cast<std::size_t>(interactions[at]->id2));
  };
  if (place + 4 * kAhead < size) {
    request(interactions[place + 4 * kAhead].get(), offsetof(Interaction, functorCache),
            sizeof(Interaction));
  }
  forBoth(place + 3 * kAhead, [&](std::size_t id) { request(bodies.data() + id, 0, 1); });
  forBoth(place + 2 * kAhead, [&](std::size_t id) {
    request(bodies[id].get(), offsetof(Body, state), offsetof(Body, shape) + sizeof(Body::shape));
  });
  forBoth(place + kAhead, [&](std::size_t id) {
    if (!bodies[id]) return;
    request(bodies[id]->state.get(), offsetof(State, se3),
            offsetof(State, se3) + sizeof(yade::Vector3r));
    request(bodies[id]->shape.get(), offsetof(Sphere, radius), sizeof(Sphere));
  });
}

// Most of the time of a step is spent here: without the attributes a compiler that sees many
// sources at once leaves vector products as calls.
[[gnu::always_inline]] inline bool ContactLoop::evaluate(Evaluation& evaluation,
                                                         const Contact& contact,
                                                         PairRows& pair) const {
  if (!rows_.areHere(pair)) {
    contact->reset();
    return false;
  }
  if (!pair.isKnown(*contact)) return evaluateOther(evaluation, contact, pair);
  ++evaluation.fast;
  evaluation.row1 = pair.row1, evaluation.row2 = pair.row2;
  return evaluation.step.evaluateKnown(*contact, *pair.geom, *pair.phys, rows_[pair.row1],
                                       rows_[pair.row2], evaluation.force);
}

bool ContactLoop::evaluateOther(Evaluation& evaluation, const Contact& contact,
                                PairRows& pair) const {
  const bool isForce = evaluation.step.evaluate(contact, rows_[pair.row1], rows_[pair.row2],
                                                evaluation.fast, evaluation.force);
  if (contact->id1 != pair.id1) {  // the order of the bodies was swapped
    std::swap(pair.id1, pair.id2), std::swap(pair.row1, pair.row2);
  }
  pair.note(*contact, evaluation.step.isKnown(*contact));
  evaluation.row1 = pair.row1, evaluation.row2 = pair.row2;
  return isForce;
}

bool ContactLoop::evaluateInPlace(Evaluation& evaluation, const Contact& contact) const {
  if (evaluation.step.computesGeometry() && evaluation.step.isFarApart(*contact)) return false;
  if (!BodyRows::areHere(*scene, *contact)) {
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

[[gnu::always_inline]] inline void ContactLoop::add(const Evaluation& evaluation) {
  ++fastForces;
  rows_.addFirst(evaluation.row1, evaluation.force);
  rows_.addSecond(evaluation.row2, evaluation.force);
}

[[gnu::always_inline]] inline void ContactLoop::run(const PairStep& step, std::size_t size) {
  Evaluation evaluation{step};
  for (std::size_t place = 0; place < size; ++place) {
    const Contact& contact = (*scene->interactions)[place];
    if (rows_.isInPlace()) {
      if (step.usesMotion()) requestInPlace(place, size);
      if (!evaluateInPlace(evaluation, contact)) continue;
    } else {
      requestAhead(place, size);
      PairRows& known = rows_(place);
      PairRows& pair = known.isOf(*contact) ? known : rows_.make(*scene, place, *contact);
      if (!evaluate(evaluation, contact, pair)) continue;
    }
    add(evaluation);
  }
  fastGeometries = evaluation.fast;
}

// Forces are stored by contact, and then added in the order of the contacts, as by one thread. Each
// thread adds those of its own bodies.
void ContactLoop::runInParallel(const PairStep& step, std::size_t size) {
  stored_.resize(size);
  blocks_.resize((size + kContactsAtOnce - 1) / kContactsAtOnce);
  forEachItem(blocks_.size(), size, threads, [&](std::size_t number) {
    const std::size_t begin = number * kContactsAtOnce;
    const std::size_t end = std::min(begin + kContactsAtOnce, size);
    runFor(
        kInstructions, [&]() __attribute__((always_inline)) {
          evaluateBlock(step, begin, end, blocks_[number]);
        });
  });
  evaluateWithoutRows(step);
  addStored();
}

[[gnu::always_inline]] inline void ContactLoop::evaluateBlock(const PairStep& step,
                                                              std::size_t begin, std::size_t end,
                                                              ContactBlock& block) {
  Evaluation evaluation{step};
  block.withoutRows.clear();
  block.forces = 0;
  for (std::size_t place = begin; place < end; ++place) {
    const Contact& contact = (*scene->interactions)[place];
    bool isForce = false;
    if (rows_.isInPlace()) {
      if (step.usesMotion()) requestInPlace(place, stored_.size());
      isForce = evaluateInPlace(evaluation, contact);
    } else {
      requestAhead(place, stored_.size());
      if (PairRows& pair = rows_(place); pair.isOf(*contact)) {
        isForce = evaluate(evaluation, contact, pair);
      } else {
        block.withoutRows.push_back(place);
      }
    }
    store(evaluation, isForce, stored_[place]);
    block.forces += isForce;
  }
  block.fast = evaluation.fast;
}

[[gnu::always_inline]] inline void ContactLoop::store(const Evaluation& evaluation, bool isForce,
                                                      PairForce& force) const {
  force.row1 = isForce ? evaluation.row1 : PairForce::kNone;
  if (!isForce) return;
  force.row2 = evaluation.row2;
  storeThree(evaluation.force.force, force.force);
  storeThree(evaluation.force.torque1, force.torque1);
  storeThree(evaluation.force.torque2, force.torque2);
}

void ContactLoop::evaluateWithoutRows(const PairStep& step) {
  Evaluation evaluation{step};
  for (const ContactBlock& block : blocks_) {
    fastGeometries += block.fast, fastForces += block.forces;
    for (const std::size_t place : block.withoutRows) {
      const Contact& contact = (*scene->interactions)[place];
      PairRows& pair = rows_.make(*scene, place, *contact);
      const bool isForce = evaluate(evaluation, contact, pair);
      store(evaluation, isForce, stored_[place]);
      fastForces += isForce;
    }
  }
  fastGeometries += evaluation.fast;
}

void ContactLoop::addStored() {
  forEachPart(stored_.size(), threads, [&](std::size_t, std::size_t, int part) {
    const auto parts = static_cast<std::size_t>(threads), own = static_cast<std::size_t>(part);
    const std::size_t first = rows_.numSums() * own / parts;
    const std::size_t last = rows_.numSums() * (own + 1) / parts;
    const auto isOwn = [&](std::size_t row) { return row >= first && row < last; };
    for (const PairForce& force : stored_) {
      if (force.row1 == PairForce::kNone) continue;
      const ContactForce contact = {loadThree(force.force), loadThree(force.torque1),
                                    loadThree(force.torque2)};
      if (isOwn(force.row1)) rows_.addFirst(force.row1, contact);
      if (isOwn(force.row2)) rows_.addSecond(force.row2, contact);
    }
  });
}

}  // namespace yadefrag
