#pragma once
// What users read when something is refused.

#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include "core/errors.hpp"

namespace yadefrag::test {

/// Fails the test unless `text` is one a user can read: words, one line, a full stop.
inline void expectSentence(const std::string& text) {
  EXPECT_GE(std::count(text.begin(), text.end(), ' '), 4) << text;
  EXPECT_EQ(text.find('\n'), std::string::npos) << text;
  EXPECT_TRUE(text.ends_with('.')) << text;
}

/// "" if `call` comes to its end, else the sentence of the error of this type that it throws.
template <class Error, class Call>
std::string saidBy(Call call) {
  try {
    call();
  } catch (const Error& error) {
    expectSentence(error.what());
    return error.what();
  }
  return {};
}

template <class Call>
std::string refusalOf(Call call) {
  return saidBy<InputError>(call);
}

/// Of an InputError or a RunError. Any other exception fails the test.
template <class Call>
std::string sentenceOf(Call call) {
  std::string refusal;
  const std::string stop = saidBy<RunError>([&] { refusal = refusalOf(call); });
  return refusal + stop;
}

}  // namespace yadefrag::test
