#include "outline/polygon.hpp"

#include <gtest/gtest.h>
#include <algorithm>
#include <cmath>

#include <chrono>
#include <limits>
#include <string>

#include "core/errors.hpp"
#include "outline/polygons.hpp"

namespace yadefrag {
namespace {

using namespace test;

std::string messageFor(const Polygon& polygon) {
  try {
    (void)checkPolygon(polygon);
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

const Loop kSquare = box({0, 0}, {4, 4});

TEST(Polygon, GoodOnesAreOriented) {
  Polygon polygon{kSquare, {box({1, 1}, {2, 2}), box({2.5, 1}, {3, 3})}};
  std::reverse(polygon.outline.begin(), polygon.outline.end());
  std::reverse(polygon.holes[1].begin(), polygon.holes[1].end());
  const Polygon checked = checkPolygon(polygon);
  EXPECT_EQ(signedArea(checked.outline), 16);
  EXPECT_EQ(signedArea(checked.holes[0]), -1);
  EXPECT_EQ(signedArea(checked.holes[1]), -1);
  EXPECT_EQ(checked.outline[0], polygon.outline[0]);
  EXPECT_EQ(checked.outline[1], polygon.outline[3]);
  EXPECT_EQ(checked.holes[1], polygon.holes[1]);
}

TEST(Polygon, StraightCornersAndNeedlesAreGood) {
  EXPECT_EQ(messageFor({{{0, 0}, {1, 0}, {2, 0}, {2, 1}, {0, 1}}, {}}), "");
  EXPECT_EQ(messageFor({{{0, 0}, {1, 0}, {1, 1e-12}}, {}}), "");
}

TEST(Polygon, TooFewPoints) {
  EXPECT_EQ(messageFor({{}, {}}),
            "Polygon: the outline ends after 0 vertices; it needs at least three.");
  EXPECT_EQ(
      messageFor({{{1, 2}}, {}}),
      "Polygon: the outline ends after 1 vertex, the last at (1, 2); it needs at least three.");
  EXPECT_EQ(messageFor({kSquare, {{{1, 2}, {3, 2}}}}),
            "Polygon: hole 0 ends after 2 vertices, the last at (3, 2); it needs at least three.");
}

TEST(Polygon, NotFinite) {
  const double nan = std::nan("");
  EXPECT_EQ(messageFor({{{0, 0}, {1, nan}, {1, 1}}, {}}),
            "Polygon: vertex 1 of the outline at (1, nan) must have finite coordinates.");
  EXPECT_EQ(messageFor({kSquare, {{{1, 1}, {2, 1}, {std::numeric_limits<double>::infinity(), 2}}}}),
            "Polygon: vertex 2 of hole 0 at (inf, 2) must have finite coordinates.");
}

TEST(Polygon, RepeatedPoints) {
  EXPECT_EQ(messageFor({{{0, 0}, {1, 0}, {1, 0}, {1, 1}}, {}}),
            "Polygon: vertex 2 of the outline at (1, 0) is the same point as vertex 1 of the "
            "outline; all points must be different.");
  EXPECT_EQ(messageFor({{{0, 0}, {1, 0}, {1, 1}, {0, 0}}, {}}),
            "Polygon: vertex 3 of the outline at (0, 0) is the same point as vertex 0 of the "
            "outline; a loop closes by itself, leave its last point out.");
  EXPECT_EQ(messageFor({kSquare, {{{1, 1}, {2, 1}, {4, 4}}}}),
            "Polygon: vertex 2 of hole 0 at (4, 4) is the same point as vertex 2 of the outline; "
            "all points must be different.");
}

TEST(Polygon, NoArea) {
  EXPECT_EQ(messageFor({{{0, 0}, {1, 1}, {3, 3}, {2, 2}}, {}}),
            "Polygon: vertex 0 of the outline at (0, 0) lies on one line with all others of the "
            "outline, which must enclose an area.");
  EXPECT_NE(messageFor({{{0, 0}, {1e-200, 0}, {0, 1e-200}}, {}}).find("vertex 0"),
            std::string::npos);
  EXPECT_NE(messageFor({{{0, 0}, {1e200, 0}, {0, 1e200}}, {}}).find("vertex 0"), std::string::npos);
}

TEST(Polygon, CrossingItself) {
  EXPECT_EQ(messageFor({{{0, 0}, {2, 2}, {2, 0}, {0, 1}}, {}}),
            "Polygon: the edge that begins at vertex 0 of the outline at (0, 0) meets the one that "
            "begins at vertex 2 of the outline at (2, 0); a loop must not cross or touch itself.");
}

TEST(Polygon, TouchingItself) {
  // A vertex on another edge, an edge that runs back on the one before, a spike onto a vertex.
  EXPECT_NE(messageFor({{{0, 0}, {4, 0}, {4, 4}, {2, 0}, {0, 4}}, {}}).find("vertex 0"),
            std::string::npos);
  EXPECT_NE(messageFor({{{0, 0}, {4, 0}, {2, 0}, {2, 3}}, {}}).find("vertex 0"), std::string::npos);
  EXPECT_NE(messageFor({{{0, 0}, {4, 0}, {4, 4}, {4, 2}, {0, 2}}, {}}).find("vertex 1"),
            std::string::npos);
}

TEST(Polygon, FoldAtTheStart) {
  EXPECT_NE(messageFor({{{0, 0}, {4, 0}, {4, 4}, {0, 4}, {6, 0}}, {}})
                .find("must not cross or touch itself"),
            std::string::npos);
}

TEST(Polygon, HolesOutsideOrMeeting) {
  EXPECT_EQ(messageFor({kSquare, {box({5, 5}, {6, 6})}}),
            "Polygon: vertex 0 of hole 0 at (5, 5) is outside the outline; holes must be inside.");
  EXPECT_EQ(messageFor({kSquare, {box({1, 1}, {5, 2})}}),
            "Polygon: the edge that begins at vertex 1 of the outline at (4, 0) meets the one that "
            "begins at vertex 0 of hole 0 at (1, 1); loops must not cross or touch one another.");
  EXPECT_NE(messageFor({kSquare, {box({1, 1}, {4, 2})}}).find("must not cross or touch"),
            std::string::npos);
  EXPECT_NE(messageFor({kSquare, {box({-1, -1}, {5, 5})}}).find("outside the outline"),
            std::string::npos);
  EXPECT_NE(messageFor({kSquare, {box({1, 1}, {2, 2}), box({2, 1.5}, {3, 3})}}).find("of hole 1"),
            std::string::npos);
}

TEST(Polygon, HoleInHole) {
  const std::string wanted =
      "Polygon: vertex 0 of hole 1 at (1.5, 1.5) is inside hole 0; holes must be beside one "
      "another.";
  EXPECT_EQ(messageFor({kSquare, {box({1, 1}, {3, 3}), box({1.5, 1.5}, {2, 2})}}), wanted);
  EXPECT_NE(messageFor({kSquare, {box({1.5, 1.5}, {2, 2}), box({1, 1}, {3, 3})}}).find("of hole 0"),
            std::string::npos);
}

TEST(Polygon, ComparisonsAreExact) {
  // The tip is one unit in the last place short of the far edge, or on it.
  const double near = std::nextafter(1., 0.);
  EXPECT_EQ(messageFor({{{0, 0}, {1, 0}, {1, 1}, {near, .5}, {0, 1}}, {}}), "");
  EXPECT_NE(messageFor({{{0, 0}, {1, 0}, {1, 1}, {1, .5}, {0, 1}}, {}}), "");
}

TEST(Polygon, TenThousandPointsAreQuick) {
  const auto start = std::chrono::steady_clock::now();
  (void)checkPolygon({circle({0, 0}, 1, 20000), {circle({0, 0}, .5, 20000)}});
  const std::chrono::duration<double> took = std::chrono::steady_clock::now() - start;
  EXPECT_LT(took.count(), 20);  // 0.1 s where nothing else runs; every edge with every other: 100 s
}

}  // namespace
}  // namespace yadefrag
