#include "loop/curve_loop.hpp"

#include <omp.h>

#include <algorithm>

#include "core/parallel.hpp"

namespace yadefrag {

namespace {

// Contacts that a thread takes at once: enough that taking them costs nothing, few enough that all
// threads end at the same time, and that their data are still in the cache when rows were made for
// their bodies. The results do not depend on it.
constexpr std::size_t kContactsAtOnce = 128;

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
  if (fastForces > 0) rows_.giveForces(*scene);
}

std::optional<ContactLoop::PairForce> ContactLoop::evaluate(const PairStep& step, std::size_t place,
                                                            long& fast) const {
  const auto& contact = (*scene->interactions)[place];
  if (rows_.isInPlace() && step.isFarApart(*contact)) return {};
  BodyRow one, two;
  const auto force = step.evaluate(contact, rows_.get(*scene, contact->id1, one),
                                   rows_.get(*scene, contact->id2, two), fast);
  if (!force) return {};
  return PairForce{rows_.rowOf(contact->id1), rows_.rowOf(contact->id2), *force};
}

void ContactLoop::run(const PairStep& step, std::size_t size) {
  for (std::size_t begin = 0; begin < size; begin += kContactsAtOnce) {
    const std::size_t end = std::min(begin + kContactsAtOnce, size);
    rows_.append(*scene, begin, end);
    for (std::size_t place = begin; place < end; ++place) {
      if (const auto pair = evaluate(step, place, fastGeometries)) {
        ++fastForces;
        rows_.addFirst(pair->row1, pair->contact);
        rows_.addSecond(pair->row2, pair->contact);
      }
    }
  }
}

// Forces are stored by contact, and then added in the order of the contacts, as by one thread. Each
// thread adds those of its own bodies.
void ContactLoop::runInParallel(const PairStep& step, std::size_t size) {
  rows_.append(*scene, 0, size);
  stored_.resize(size);
  const std::size_t blocks = (size + kContactsAtOnce - 1) / kContactsAtOnce;
  fastInBlock_.assign(blocks, 0);
  forEachItem(blocks, size, threads, [&](std::size_t block) {
    const std::size_t begin = block * kContactsAtOnce;
    for (std::size_t place = begin; place < std::min(begin + kContactsAtOnce, size); ++place) {
      stored_[place] = evaluate(step, place, fastInBlock_[block]);
    }
  });
  for (const long fast : fastInBlock_) fastGeometries += fast;
  forEachPart(size, threads, [&](std::size_t, std::size_t, int part) {
    const auto parts = static_cast<std::size_t>(threads), own = static_cast<std::size_t>(part);
    const std::size_t first = rows_.numSums() * own / parts;
    const std::size_t last = rows_.numSums() * (own + 1) / parts;
    const auto isOwn = [&](std::size_t row) { return row >= first && row < last; };
    for (const auto& pair : stored_) {
      if (!pair) continue;
      if (isOwn(pair->row1)) rows_.addFirst(pair->row1, pair->contact);
      if (isOwn(pair->row2)) rows_.addSecond(pair->row2, pair->contact);
    }
  });
  fastForces = std::count_if(stored_.begin(), stored_.end(),
                             [](const auto& pair) { return pair.has_value(); });
}

}  // namespace yadefrag
