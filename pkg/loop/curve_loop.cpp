#include "loop/curve_loop.hpp"

#include <omp.h>

#include <algorithm>
#include <cstddef>

#include "abi/request.hpp"
#include "core/parallel.hpp"

namespace yadefrag {

namespace {

// Contacts that a thread takes at once: enough that taking them costs nothing, few enough that all
// threads end at the same time. The results do not depend on it.
constexpr std::size_t kContactsAtOnce = 128;
// Contacts between the request of an interaction from memory and its use: enough for the latency of
// one access.
constexpr std::size_t kAhead = 16;

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
  rows_.begin(*scene, size, threads);
  const PairStep step(*this, *scene);
  if (threads > 1) {
    runInParallel(step, size);
  } else {
    run(step, size);
  }
  if (fastForces == 0) return;
  rows_.giveForces(*scene);
  memory_.endStep(*scene);
}

[[gnu::always_inline]] inline void ContactLoop::requestAhead(std::size_t place,
                                                             std::size_t size) const {
  if (place + kAhead >= size) return;
  request((*scene->interactions)[place + kAhead].get(), offsetof(yade::Interaction, functorCache),
          sizeof(yade::Interaction));
}

// Most of the time of a step is spent here: without the attributes a compiler that sees many
// sources at once leaves vector products as calls.
[[gnu::always_inline]] inline bool ContactLoop::evaluate(const PairStep& step,
                                                         const Contact& contact,
                                                         const PairRows& pair, long& fast,
                                                         PairForce& force) const {
  if (step.isKnown(*contact)) {
    ++fast;
    force.row1 = pair.row1, force.row2 = pair.row2;
    return step.evaluateKnown(*contact, rows_[pair.row1], rows_[pair.row2], force.contact);
  }
  const auto other = step.evaluate(contact, rows_[pair.row1], rows_[pair.row2], fast);
  if (!other) return false;
  // The order of the bodies may have been swapped.
  const bool isSwapped = contact->id1 != pair.id1;
  force = {isSwapped ? pair.row2 : pair.row1, isSwapped ? pair.row1 : pair.row2, *other};
  return true;
}

bool ContactLoop::evaluateInPlace(const PairStep& step, const Contact& contact, long& fast,
                                  PairForce& force) const {
  if (step.isFarApart(*contact)) return false;
  const auto found = step.evaluate(contact, BodyRows::read(*scene, contact->id1),
                                   BodyRows::read(*scene, contact->id2), fast);
  if (!found) return false;
  force = {static_cast<std::uint32_t>(contact->id1), static_cast<std::uint32_t>(contact->id2),
           *found};
  return true;
}

[[gnu::always_inline]] inline void ContactLoop::add(const PairForce& force) {
  rows_.addFirst(force.row1, force.contact);
  rows_.addSecond(force.row2, force.contact);
}

[[gnu::flatten]] void ContactLoop::run(const PairStep& step, std::size_t size) {
  PairForce force;
  for (std::size_t place = 0; place < size; ++place) {
    requestAhead(place, size);
    const Contact& contact = (*scene->interactions)[place];
    if (rows_.isInPlace()) {
      if (!evaluateInPlace(step, contact, fastGeometries, force)) continue;
    } else {
      const PairRows* const known = rows_.known(place, *contact);
      const PairRows& pair = known ? *known : rows_.make(*scene, place, *contact);
      if (!evaluate(step, contact, pair, fastGeometries, force)) continue;
    }
    ++fastForces;
    add(force);
  }
}

// Forces are stored by contact, and then added in the order of the contacts, as by one thread. Each
// thread adds those of its own bodies.
void ContactLoop::runInParallel(const PairStep& step, std::size_t size) {
  stored_.resize(size);
  blocks_.resize((size + kContactsAtOnce - 1) / kContactsAtOnce);
  forEachItem(blocks_.size(), size, threads, [&](std::size_t number) {
    const std::size_t begin = number * kContactsAtOnce;
    evaluateBlock(step, begin, std::min(begin + kContactsAtOnce, size), blocks_[number]);
  });
  for (const ContactBlock& block : blocks_) {
    fastGeometries += block.fast;
    for (const std::size_t place : block.withoutRows) {
      const Contact& contact = (*scene->interactions)[place];
      const PairRows& pair = rows_.make(*scene, place, *contact);
      if (!evaluate(step, contact, pair, fastGeometries, stored_[place])) {
        stored_[place].row1 = PairForce::kNone;
      }
    }
  }
  forEachPart(size, threads, [&](std::size_t, std::size_t, int part) {
    const auto parts = static_cast<std::size_t>(threads), own = static_cast<std::size_t>(part);
    const std::size_t first = rows_.numSums() * own / parts;
    const std::size_t last = rows_.numSums() * (own + 1) / parts;
    const auto isOwn = [&](std::size_t row) { return row >= first && row < last; };
    for (const PairForce& force : stored_) {
      if (force.row1 == PairForce::kNone) continue;
      if (isOwn(force.row1)) rows_.addFirst(force.row1, force.contact);
      if (isOwn(force.row2)) rows_.addSecond(force.row2, force.contact);
    }
  });
  fastForces = std::count_if(stored_.begin(), stored_.end(),
                             [](const PairForce& force) { return force.row1 != PairForce::kNone; });
}

[[gnu::flatten]] void ContactLoop::evaluateBlock(const PairStep& step, std::size_t begin,
                                                 std::size_t end, ContactBlock& block) {
  block.fast = 0;
  block.withoutRows.clear();
  for (std::size_t place = begin; place < end; ++place) {
    requestAhead(place, stored_.size());
    const Contact& contact = (*scene->interactions)[place];
    PairForce& force = stored_[place];
    bool isForce = false;
    if (rows_.isInPlace()) {
      isForce = evaluateInPlace(step, contact, block.fast, force);
    } else if (const PairRows* const pair = rows_.known(place, *contact)) {
      isForce = evaluate(step, contact, *pair, block.fast, force);
    } else {
      block.withoutRows.push_back(place);
    }
    if (!isForce) force.row1 = PairForce::kNone;
  }
}

}  // namespace yadefrag
