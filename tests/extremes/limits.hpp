#pragma once
// The manual's table of limits, which the tests make and check: a test measures the smallest and
// the largest value that works, and docs/limits.md must state the same.

#include <cmath>
#include <string>

#include "core/errors.hpp"

namespace yadefrag::test {

/// There is no such bound: the table shows "–".
inline constexpr double kNone = NAN;

/// One row. The page's row of this name has to have the same sentence, and numbers that are equal
/// but for a factor: the default is that of rounding to two digits, larger ones are for measured
/// figures that depend on rounding. `name` is a literal at the call, and holds the unit. With
/// YADEFRAG_LIMITS=folder the row is written there instead, for scripts/bench limits.
void limit(const std::string& name, double smallest, double largest, const std::string& beyond,
           double factor = 1.06);

/// True if the long parts are requested (YADEFRAG_LONG).
bool longRun();

/// Fails the test unless `text` is one a user can read: words, one line, a full stop.
void expectSentence(const std::string& text);

/// "" if `call` comes to its end, else the sentence of the InputError or RunError that it throws.
/// Any other exception, and a message that is no sentence, fails the test.
template <class Call>
std::string sentenceOf(Call call) {
  std::string text;
  try {
    call();
    return text;
  } catch (const InputError& error) {
    text = error.what();
  } catch (const RunError& error) {
    text = error.what();
  }
  expectSentence(text);
  return text;
}

}  // namespace yadefrag::test
