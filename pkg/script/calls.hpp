#pragma once
// How functions that Python calls begin and end: locks, and exceptions for Python.

#include <mutex>
#include <stdexcept>

#include "core/errors.hpp"
#include "fe/fe_solver.hpp"
#include "fe/running.hpp"

namespace yadefrag {

/// Runs `work`, and converts an InputError to Python's ValueError.
template <class Work>
auto asValueError(Work&& work) {
  try {
    return work();
  } catch (const InputError& error) {
    throw std::invalid_argument(error.what());
  }
}

/// Runs `work`, which changes the scene, between two steps.
template <class Work>
auto change(const FESolver& solver, Work&& work) {
  requirePaused();
  const std::lock_guard guard(solver.betweenSteps());
  return asValueError(work);
}

/// A call that waits for the end of a step if another thread runs the scene.
template <auto call>
struct Locked;
template <class Value, class Solver, class... Rest, Value (*function)(Solver&, Rest...)>
struct Locked<function> {
  static Value call(Solver& self, Rest... rest) {
    const std::lock_guard guard(self.betweenSteps());
    return function(self, rest...);
  }
};

}  // namespace yadefrag
