#pragma once
// The laws whose forces the loop computes, and the choice of one for a step.

#include <tuple>

#include "loop/cohesive_2025.hpp"
#include "loop/cundall_strack.hpp"
#include "loop/hertz_mindlin.hpp"
#include "loop/viscoelastic.hpp"

namespace yadefrag {

using KnownLaws = std::tuple<CundallStrack, HertzMindlin, Viscoelastic, Cohesive>;

/// Calls `visit.operator()<Law>()` for each known law.
template <class Visit>
void forEachLaw(const Visit& visit) {
  [&]<class... Laws>(const std::tuple<Laws...>*) {
    (visit.template operator()<Laws>(), ...);
  }(static_cast<const KnownLaws*>(nullptr));
}

/// Null: the loop lacks the functor, or YADE must call it.
template <ContactLaw Law>
typename Law::Functor* computed(const yade::InteractionLoop& loop, const yade::Scene& scene) {
  auto* const functor = exactly<typename Law::Functor>(loop.lawDispatcher->functors);
  return functor && !Law::reasonForYade(*functor, scene) ? functor : nullptr;
}

/// Calls `run.operator()<Law>(functor)` once: for the first law that the loop can compute, if
/// possible one whose properties it has; null: YADE's functors compute all forces.
template <class Run>
void withLaw(const yade::InteractionLoop& loop, const yade::Scene& scene, const Run& run) {
  bool hasRun = false;
  for (const bool needsProperties : {true, false}) {
    forEachLaw([&]<class Law>() {
      if (hasRun) return;
      auto* const functor = computed<Law>(loop, scene);
      if (!functor ||
          (needsProperties && !functorOf(loop.physDispatcher->functors, Law::kProperties)))
        return;
      hasRun = true;
      run.template operator()<Law>(functor);
    });
  }
  if (!hasRun) run.template operator()<CundallStrack>(nullptr);
}

}  // namespace yadefrag
