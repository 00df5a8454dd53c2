#include <gtest/gtest.h>

#include <atomic>
#include <new>
#include <stdexcept>
#include <string>

#include "core/parallel.hpp"
#include "core/same_bits.hpp"

namespace yadefrag::test {
namespace {

constexpr std::size_t kCount = 8 * tolerance::kMinItemsPerThread;

TEST(Parallel, PartsCoverTheRange) {
  for (const int threads : {1, 2, 3, 8}) {
    std::vector<int> seen(kCount);
    const int parts = forEachPart(kCount, threads, [&](std::size_t begin, std::size_t end, int) {
      for (std::size_t i = begin; i < end; ++i) ++seen[i];
    });
    EXPECT_EQ(parts, threads);
    EXPECT_EQ(seen, std::vector<int>(kCount, 1));
  }
}

TEST(Parallel, FewItemsRunOnThreadsIfTestsWantIt) {
  const auto partsOfTen = [] { return forEachPart(10, 3, [](std::size_t, std::size_t, int) {}); };
  {
    const ThreadsForFew few(3);
    EXPECT_EQ(partsOfTen(), 3);
  }
  EXPECT_EQ(partsOfTen(), 1);
}

TEST(Parallel, EachItemIsDoneOnce) {
  for (const int threads : {1, 2, 3, 8}) {
    std::vector<int> seen(1000);
    forEachItem(seen.size(), kCount, threads, [&](std::size_t item) { ++seen[item]; });
    EXPECT_EQ(seen, std::vector<int>(1000, 1));
    EXPECT_THROW(forEachItem(1000, kCount, threads, [](std::size_t) { throw std::bad_alloc(); }),
                 std::bad_alloc);
  }
}

// Memory may run out in any thread.
TEST(Parallel, ErrorsReachTheCaller) {
  for (const int threads : {1, 2, 3, 8}) {
    SCOPED_TRACE(threads);
    const auto fail = [](std::size_t, std::size_t, int) { throw std::bad_alloc(); };
    EXPECT_THROW(forEachPart(kCount, threads, fail), std::bad_alloc);
  }
}

TEST(Parallel, TheFirstPartsErrorIsThrownAfterAllHaveEnded) {
  std::atomic<int> ended = 0;
  try {
    forEachPart(kCount, 4, [&](std::size_t, std::size_t, int part) {
      ++ended;
      if (part % 2 == 1) throw std::runtime_error(std::to_string(part));
    });
    ADD_FAILURE() << "nothing was thrown";
  } catch (const std::runtime_error& error) {
    EXPECT_STREQ(error.what(), "1");
  }
  EXPECT_EQ(ended, 4);
}

}  // namespace
}  // namespace yadefrag::test
