// Polygon files, and damaged ones: read or refused with a sentence.

#include "outline/polygon_text.hpp"

#include <gtest/gtest.h>

#include <random>
#include <string>

#include "core/errors.hpp"
#include "mesh/triangle_mesh.hpp"

namespace yadefrag::test {
namespace {

const std::string kPlate = "# a plate\n\n0 0  # corner\n4 0\n4 3\r\n\n\n1 1\n1 2\n2e0 +1\n\n";

/// "" if it can be read.
std::string refusal(const std::string& text) {
  try {
    (void)polygonFromText(text);
  } catch (const InputError& error) {
    return error.what();
  }
  return {};
}

TEST(PolygonText, LoopsAreApartByEmptyLines) {
  const Polygon polygon = polygonFromText(kPlate);
  EXPECT_EQ(polygon.outline, (std::vector<Vec2>{{0, 0}, {4, 0}, {4, 3}}));
  ASSERT_EQ(polygon.holes.size(), 1U);
  EXPECT_EQ(polygon.holes[0], (std::vector<Vec2>{{1, 1}, {1, 2}, {2, 1}}));
}

TEST(PolygonText, ByteOrderMarkAtTheBeginningIsSkipped) {
  EXPECT_EQ(polygonFromText("\xef\xbb\xbf"
                            "0 0\n1 0\n1 1\n")
                .outline,
            (std::vector<Vec2>{{0, 0}, {1, 0}, {1, 1}}));
  EXPECT_NE(refusal("0 0\n\xef\xbb\xbf"
                    "1 0\n"),
            "");
}

TEST(PolygonText, DamagedTextIsReadOrRefusedInASentence) {
  std::mt19937 random(1);
  int refused = 0;
  for (int i = 0; i < 20000; ++i) {
    std::string text = kPlate;
    for (unsigned k = random() % 4; k > 0; --k)
      text[random() % text.size()] = static_cast<char>(random());
    if (random() % 4 == 0) text.resize(random() % text.size());
    const std::string sentence = refusal(text);
    if (sentence.empty()) continue;
    ++refused;
    ASSERT_TRUE(sentence.starts_with("line ") && sentence.ends_with(".")) << sentence;
    ASSERT_EQ(sentence.find('\n'), std::string::npos) << sentence;
  }
  EXPECT_GT(refused, 5000);
  EXPECT_LT(refused, 19000);
}

}  // namespace
}  // namespace yadefrag::test
