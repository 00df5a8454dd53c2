#include "outline/polygon_text.hpp"
#include "outline/voronoi.hpp"
#include "rigid/rigid_section.hpp"
#include "script/arrays.hpp"
#include "script/calls.hpp"
#include "script/definitions.hpp"

namespace yadefrag {

namespace py = yade::py;

namespace {

py::list pairsOf(const std::vector<Vec2>& points) {
  py::list pairs;
  for (const Vec2 point : points) pairs.append(py::make_tuple(point.x, point.y));
  return pairs;
}

/// (outline, holes) as lists of pairs; ValueError as polygonFromText.
py::tuple polygonOfText(const std::string& text) {
  return asValueError([&] {
    const Polygon polygon = polygonFromText(text);
    py::list holes;
    for (const auto& hole : polygon.holes) holes.append(pairsOf(hole));
    return py::make_tuple(pairsOf(polygon.outline), holes);
  });
}

/// The grains of outline/voronoi.hpp, as lists of pairs; `outline` is an array of its points.
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

const char* nameOf(Section::Kind kind) {
  if (kind == Section::Kind::kOutline) return "outline";
  return kind == Section::Kind::kLine ? "line" : "wall";
}

/// Sections of all bodies of the present scene that intersect the plane z = 0: tuples (id, kind,
/// points), with kind 'outline', 'line' or 'wall' and points as in Section, pairs (m).
py::list sectionsOfScene() {
  py::list found;
  for (const auto& body : yade::Omega::instance().getScene()->bodies->body) {
    if (!body || !body->shape || !body->state || !mayHaveSection(*body)) continue;
    const std::optional<Section> section = sectionOf(*body);
    if (!section) continue;
    found.append(py::make_tuple(body->id, nameOf(section->kind), pairsOf(section->points)));
  }
  return found;
}

}  // namespace

void defineOutlines() {
  py::def("sectionsOfScene", &sectionsOfScene);
  py::def("polygonOfText", &polygonOfText);
  py::def("voronoiOf", &voronoiOf);
}

}  // namespace yadefrag
