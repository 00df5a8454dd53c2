#include "script/polygon_python.hpp"

#include "outline/polygon_text.hpp"
#include "outline/voronoi.hpp"
#include "script/arrays.hpp"
#include "script/calls.hpp"

namespace yadefrag {

namespace py = yade::py;

namespace {

py::list pairsOf(const std::vector<Vec2>& points) {
  py::list pairs;
  for (const Vec2 point : points) pairs.append(py::make_tuple(point.x, point.y));
  return pairs;
}

}  // namespace

py::tuple polygonOfText(const std::string& text) {
  return asValueError([&] {
    const Polygon polygon = polygonFromText(text);
    py::list holes;
    for (const auto& hole : polygon.holes) holes.append(pairsOf(hole));
    return py::make_tuple(pairsOf(polygon.outline), holes);
  });
}

py::list voronoiOf(const py::object& outline, std::uint32_t count, std::uint64_t seed, int rounds,
                   double shortest) {
  return asValueError([&] {
    py::list grains;
    const std::vector<Vec2> points = fromArray<Vec2>(outline);
    auto loops = voronoiGrains(points, count, seed, rounds);
    if (shortest > 0) loops = withoutShortSides(std::move(loops), points, shortest);
    for (const auto& grain : loops) grains.append(pairsOf(grain));
    return grains;
  });
}

}  // namespace yadefrag
