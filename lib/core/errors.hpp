#pragma once
// Bad input is reported by a typed exception with one sentence; programming errors are `assert`s.

#include <stdexcept>
#include <string>

namespace yadefrag {

/// The caller's input cannot be used. The message states the value and the valid range.
class InputError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// An InputError whose cause is the time step.
class TimeStepError : public InputError {
 public:
  using InputError::InputError;
};

/// The simulation cannot continue: an element is inverted, or a value is not finite.
class RunError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// An element is pressed so flat that the step is above the critical one.
class FlatError : public RunError {
 public:
  FlatError(const std::string& text, double step) : RunError(text), advised(step) {}
  double advised;  ///< s
};

}  // namespace yadefrag
