#include "script/section_python.hpp"

#include "rigid/rigid_section.hpp"

namespace yadefrag {

namespace py = yade::py;

namespace {

const char* nameOf(Section::Kind kind) {
  if (kind == Section::Kind::kOutline) return "outline";
  return kind == Section::Kind::kLine ? "line" : "wall";
}

}  // namespace

py::list sectionsOfScene() {
  py::list found;
  for (const auto& body : yade::Omega::instance().getScene()->bodies->body) {
    if (!body || !body->shape || !body->state || !mayHaveSection(*body)) continue;
    const std::optional<Section> section = sectionOf(*body);
    if (!section) continue;
    py::list points;
    for (const Vec2 point : section->points) points.append(py::make_tuple(point.x, point.y));
    found.append(py::make_tuple(body->id, nameOf(section->kind), points));
  }
  return found;
}

}  // namespace yadefrag
