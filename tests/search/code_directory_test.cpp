#include "search/code_directory.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "core/comparisons.hpp"

namespace yadefrag {
namespace {

std::vector<std::uint64_t> randomCodes(std::mt19937_64& random, int kind, std::size_t count) {
  std::vector<std::uint64_t> codes(count);
  for (std::uint64_t& code : codes) {
    switch (kind) {
      case 0:
        code = random() >> 1;
        break;  // even
      case 1:
        code = (random() % 2 << 60) + random() % 5000;
        break;  // two clusters
      case 2:
        code = random() % 4;
        break;  // many equal
      case 3:
        code = std::uint64_t{1} << (random() % 63);
        break;  // every scale
      default:
        code = random() % 3 ? 12345 : (random() >> 1);
        break;  // a crowd, outliers
    }
  }
  std::sort(codes.begin(), codes.end());
  return codes;
}

TEST(CodeDirectory, FindsWhatBinarySearchFinds) {
  std::mt19937_64 random(3);
  CountNothing nothing;
  for (int k = 0; k < 2000; ++k) {
    const auto codes = randomCodes(random, k % 5, random() % 400);
    CodeDirectory directory;
    directory.build(codes);
    const auto check = [&](std::uint64_t code) {
      const auto expected = std::lower_bound(codes.begin(), codes.end(), code) - codes.begin();
      ASSERT_EQ(directory.lowerBound(code, nothing), expected);
    };
    check(0);
    check(~std::uint64_t{0});
    for (const std::uint64_t code : codes) {
      check(code);
      check(code + 1);
      check(code > 0 ? code - 1 : 0);
    }
    for (int i = 0; i < 50; ++i) check(random() >> (random() % 64));
  }
}

TEST(CodeDirectory, LooksDoNotGrowWithTheList) {
  std::mt19937_64 random(4);
  for (const int kind : {0, 1}) {
    std::vector<double> perLook;
    for (const std::size_t count : {1000, 1000000}) {
      auto codes = randomCodes(random, kind, count);
      if (kind == 1)
        for (std::uint64_t& code : codes) code = (code >> 60 << 60) + random() % (count * 10);
      std::sort(codes.begin(), codes.end());
      CodeDirectory directory;
      directory.build(codes);
      CountAll counted;
      for (std::size_t i = 0; i < 10000; ++i)
        static_cast<void>(directory.lowerBound(codes[random() % count] + random() % 3, counted));
      perLook.push_back(static_cast<double>(counted.total().range) / 10000);
    }
    EXPECT_LT(perLook[1], 1.3 * perLook[0]);
    EXPECT_LT(perLook[1], 9);
  }
}

}  // namespace
}  // namespace yadefrag
