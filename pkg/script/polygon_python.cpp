#include "outline/polygon.hpp"
#include "rigid/rigid_section.hpp"
#include "script/arrays.hpp"
#include "script/calls.hpp"
#include "script/definitions.hpp"
#include "script/mesh_python.hpp"

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

/// The outline and the holes of outline/polygon.hpp's checkPolygon, as arrays.
py::list checkedPolygon(const py::object& outline, const py::list& holes) {
  return asValueError([&] {
    Polygon polygon = checkPolygon(polygonOf(outline, holes));
    polygon.holes.insert(polygon.holes.begin(), std::move(polygon.outline));
    return toArrays(polygon.holes);
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
  py::def("checkedPolygon", &checkedPolygon);
}

}  // namespace yadefrag
