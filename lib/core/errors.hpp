#pragma once
// Bad input is reported by a typed exception with one sentence; our own mistakes are `assert`s.

#include <stdexcept>

namespace yadefrag {

/// The caller's input cannot be used; the message says what it was and what would be right.
class InputError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// The same, where it is the time step that cannot be used.
class TimeStepError : public InputError {
 public:
  using InputError::InputError;
};

/// A run cannot go on: an element is inverted, or a value is not finite.
class RunError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

}  // namespace yadefrag
