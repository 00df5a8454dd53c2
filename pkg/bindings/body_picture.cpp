#include "bindings/body_picture.hpp"

#include <GL/gl.h>
#include <dlfcn.h>

#include <algorithm>
#include <cmath>
#include <mutex>

#include "bindings/fragments.hpp"
#include "elements/element_state.hpp"
#include "materials/surface_segment.hpp"
#include "solver/fe_solver.hpp"

namespace yadefrag {

namespace {

/// A colour with full saturation and brightness; `turn`: 0 red, 1/3 green, 2/3 blue.
Colour hue(double turn) {
  Colour colour;
  for (int k = 0; k < 3; ++k) {
    const double away = std::abs(std::remainder(turn - k / 3., 1.)) * 6;
    colour[static_cast<std::size_t>(k)] = static_cast<float>(std::clamp(2 - away, 0., 1.));
  }
  return colour;
}

/// Von Mises stress of each triangle.
std::vector<double> misesOf(const Model& model) {
  std::vector<double> values = stressesAcross(model);
  std::size_t e = 0;
  for (const auto& [xx, yy, xy] : stresses(model)) {
    const double x = yy - values[e], y = values[e] - xx, z = xx - yy;
    values[e++] = std::sqrt((x * x + y * y + z * z) / 2 + 3 * xy * xy);
  }
  return values;
}

std::vector<Colour> coloursOf(const FESolver& solver, const std::string& field) {
  const Model& model = solver.world().model;
  std::vector<Colour> colours;
  if (field == "mises") {
    const std::vector<double> values = misesOf(model);
    const double most = values.empty() ? 0 : *std::ranges::max_element(values);
    for (const double value : values)
      colours.push_back(hue(2. / 3 * (1 - value / (most + 1e-300))));
    return colours;
  }
  std::vector<std::uint32_t> numbers;
  if (field == "fragment") findFragments(model, &numbers, &solver.world().fracture);
  for (std::size_t e = 0; e < model.triangles.size(); ++e)
    colours.push_back(colourOf(numbers.empty() ? model.triangles.component[e].value : numbers[e]));
  return colours;
}

void addHeld(const FESolver& solver, std::vector<BodyPicture>& pictures) {
  const World& world = solver.world();
  for (const EdgeId edge : world.fracture.cohesion.edge) {
    const Side side = world.fracture.edges.side(edge, 0);
    const ElementId element = world.fracture.edges.element[edge.value][0];
    const auto at = [&](NodeId node) { return world.model.nodes.position[node.value]; };
    pictures[world.model.triangles.component[element.value].value].held.push_back(
        {at(firstNode(world.model, side)), at(lastNode(world.model, side))});
  }
}

}  // namespace

/// Hues at golden-section distances, with three steps of brightness.
Colour colourOf(std::uint32_t number) {
  Colour colour = hue(std::fmod(.6 + .6180339887498949 * number, 1.));
  const float bright = 1 - .2F * static_cast<float>(number % 3);
  for (float& part : colour) part = bright * (.25F + .75F * part);
  return colour;
}

std::vector<BodyPicture> picturesOf(const FESolver& solver, const std::string& field) {
  const World& world = solver.world();
  const ContactSurfaces& surfaces = world.surfaces;
  std::vector<BodyPicture> pictures(world.model.components.size());
  const auto at = [&](NodeId node) { return world.model.nodes.position[node.value]; };
  const std::vector<Colour> colours = coloursOf(solver, field);
  for (std::size_t e = 0; e < colours.size(); ++e) {
    if (world.model.triangles.isDropped(e)) continue;
    const auto& [a, b, c] = world.model.triangles.nodes[e];
    pictures[world.model.triangles.component[e].value].triangles.push_back(
        {{at(a), at(b), at(c)}, colours[e]});
  }
  for (std::size_t s = 0; s < surfaces.segments(); ++s) {
    if (surfaces.isGone(SegmentId(s))) continue;
    const EntryId entry = surfaces.segmentEntry[s];
    const NodeId next = surfaces.segmentNode[surfaces.segmentNext[s].value];
    pictures[surfaces.component[entry.value].value].outline.push_back(
        {at(surfaces.segmentNode[s]), at(next)});
  }
  const std::size_t entries = std::min(surfaces.entries(), solver.entryBodies().ids().size());
  for (std::size_t e = entries; e-- > 0;)
    if (solver.entryBodies().hasBody(EntryId(e)))
      pictures[surfaces.component[e].value].entry = static_cast<int>(e);
  addHeld(solver, pictures);
  return pictures;
}

namespace {

/// OpenGL functions, which are loaded only in a yade with a 3D view: the plugin is not linked to
/// them.
struct OpenGL {
  decltype(&glBegin) begin;
  decltype(&glEnd) end;
  decltype(&glVertex3d) vertex;
  decltype(&glColor3f) colour;
  decltype(&glEnable) enable;
  decltype(&glDisable) disable;
  decltype(&glPushAttrib) push;
  decltype(&glPopAttrib) pop;
  decltype(&glLineWidth) width;
  decltype(&glPolygonOffset) offset;
  decltype(&glDepthRange) depth;
  bool isComplete = true;

  OpenGL() {
    void* library = dlopen("libGL.so.1", RTLD_LAZY);
    take(library, "glBegin", begin), take(library, "glEnd", end);
    take(library, "glVertex3d", vertex), take(library, "glColor3f", colour);
    take(library, "glEnable", enable), take(library, "glDisable", disable);
    take(library, "glPushAttrib", push), take(library, "glPopAttrib", pop);
    take(library, "glLineWidth", width), take(library, "glPolygonOffset", offset);
    take(library, "glDepthRange", depth);
  }

 private:
  template <class Function>
  void take(void* library, const char* name, Function& function) {
    function = library ? reinterpret_cast<Function>(dlsym(library, name)) : nullptr;
    isComplete = isComplete && function;
  }
};

const OpenGL& openGL() {
  static const OpenGL functions;
  return functions;
}

/// Draws lines relative to the position to which YADE has moved the origin.
struct Pen {
  const OpenGL& gl;
  Vec2 origin;

  void point(Vec2 at) const { gl.vertex(at.x - origin.x, at.y - origin.y, 0); }
  void lines(const std::vector<std::array<Vec2, 2>>& all, Colour colour, float width) const {
    gl.width(width);
    gl.colour(colour[0], colour[1], colour[2]);
    gl.begin(GL_LINES);
    for (const auto& [from, to] : all) point(from), point(to);
    gl.end();
  }
  void edges(const std::vector<PictureTriangle>& triangles) const {
    gl.width(1);
    for (const auto& [corners, colour] : triangles) {
      gl.colour(colour[0], colour[1], colour[2]);
      gl.begin(GL_LINE_LOOP);
      for (const Vec2 corner : corners) point(corner);
      gl.end();
    }
  }
  void filled(const std::vector<PictureTriangle>& triangles) const {
    gl.begin(GL_TRIANGLES);
    for (const auto& [corners, colour] : triangles) {
      gl.colour(colour[0], colour[1], colour[2]);
      for (const Vec2 corner : corners) point(corner);
    }
    gl.end();
  }
};

}  // namespace

/// Updates the pictures, except during a step: the step may be waiting for a lock that YADE holds
/// while drawing.
void Gl1_SurfaceSegment::takePictures() {
  if (!scene) return;
  for (const auto& engine : scene->engines) {
    const auto* solver = dynamic_cast<const FESolver*>(engine.get());
    if (!solver) continue;
    const std::unique_lock guard(solver->betweenSteps(), std::try_to_lock);
    if (guard.owns_lock()) pictures_ = picturesOf(*solver, solver->settings.view);
    return;
  }
}

void Gl1_SurfaceSegment::go(const yade::shared_ptr<yade::Shape>& shape,
                            const yade::shared_ptr<yade::State>& state, bool wire,
                            const yade::GLViewInfo& /*view*/) {
  const auto& segment = static_cast<const SurfaceSegment&>(*shape);
  const auto& gl = openGL();
  if (segment.entry < 0 || !gl.isComplete) return;
  const auto stands = [&](const BodyPicture& picture) { return picture.entry == segment.entry; };
  // All bodies once per frame; the first segment starts it.
  if (segment.entry == 0 || pictures_.empty()) takePictures();
  const auto picture = std::ranges::find_if(pictures_, stands);
  if (picture == pictures_.end()) return;
  const Pen pen{gl, {state->se3.position[0], state->se3.position[1]}};
  gl.push(GL_ENABLE_BIT | GL_CURRENT_BIT | GL_LINE_BIT | GL_POLYGON_BIT | GL_VIEWPORT_BIT);
  gl.disable(GL_LIGHTING), gl.disable(GL_CULL_FACE);
  // Lines in the same plane are drawn in front.
  gl.enable(GL_POLYGON_OFFSET_FILL), gl.offset(1, 1);
  if (wire)
    pen.edges(picture->triangles);
  else
    pen.filled(picture->triangles);
  pen.lines(picture->outline, {0, 0, 0}, 1.5F);
  // In front of the boundaries on both sides, in any order of drawing.
  gl.depth(0, .9999);
  pen.lines(picture->held, {1, 0, 0}, 2);
  gl.pop();
}

}  // namespace yadefrag
