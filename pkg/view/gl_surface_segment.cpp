#include "view/body_picture.hpp"

#include <GL/gl.h>
#include <dlfcn.h>
#include <algorithm>

#include <mutex>

#include "entries/surface_segment.hpp"
#include "fe/fe_solver.hpp"

namespace yadefrag {
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
