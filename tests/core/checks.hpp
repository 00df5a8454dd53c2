#pragma once
// What the tests of all folders share: sentences that users read when something is refused;
// equality to the last bit, which is what "same input, same bits" means (== would take -0 for 0);
// random numbers; measured figures, which are in the XML output and in the message of a failure;
// memory that runs out at a moment which a test chooses.

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>
#include <cstring>
#include <random>
#include <ranges>
#include <string>

#include "core/errors.hpp"
#include "core/parallel.hpp"

namespace yadefrag::test {

/// Fails the test unless `text` is one a user can read: words, one line, a full stop.
inline void expectSentence(const std::string& text) {
  EXPECT_GE(std::count(text.begin(), text.end(), ' '), 4) << text;
  EXPECT_EQ(text.find('\n'), std::string::npos) << text;
  EXPECT_TRUE(text.ends_with('.')) << text;
}

/// If not, the message shows both.
inline testing::AssertionResult contains(const std::string& text, const std::string& part) {
  return testing::IsSubstring("part", "text", part, text);
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

template <std::ranges::contiguous_range Range>
bool sameBits(const Range& a, const Range& b) {
  if (std::ranges::size(a) != std::ranges::size(b)) return false;
  const std::size_t bytes = std::ranges::size(a) * sizeof(std::ranges::range_value_t<Range>);
  // An empty range may have no address, which memcmp does not take.
  return bytes == 0 || std::memcmp(std::ranges::data(a), std::ranges::data(b), bytes) == 0;
}

/// While it exists, even a few items are distributed to threads.
class ThreadsForFew {
 public:
  explicit ThreadsForFew(std::size_t items = 4) { leastItemsPerThread() = items; }
  ~ThreadsForFew() { leastItemsPerThread() = tolerance::kMinItemsPerThread; }
  ThreadsForFew(const ThreadsForFew&) = delete;
  ThreadsForFew& operator=(const ThreadsForFew&) = delete;
};

using Random = std::mt19937_64;

/// Evenly distributed from `low` to `high`.
inline double even(Random& random, double low, double high) {
  return std::uniform_real_distribution<double>(low, high)(random);
}

inline void record(const std::string& name, double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.6g", value);
  ::testing::Test::RecordProperty(name, text);
}

/// Records a value and expects it within `tolerance` of `wanted`.
inline void figure(const std::string& name, double value, double wanted, double tolerance) {
  record(name, value);
  EXPECT_NEAR(value, wanted, tolerance) << name;
}

/// While it exists, the allocation after `count` further ones of this thread throws std::bad_alloc.
class FailingMemory {
 public:
  explicit FailingMemory(std::size_t count);
  ~FailingMemory();
  FailingMemory(const FailingMemory&) = delete;
  FailingMemory& operator=(const FailingMemory&) = delete;
};

}  // namespace yadefrag::test
