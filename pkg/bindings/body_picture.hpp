#pragma once
// Finite-element bodies in YADE's 3D view. Their data are a copy: the thread that draws must not
// wait for a step.

#include <array>
#include <string>
#include <vector>

#include "core/vec2.hpp"
#include "yade/published.hpp"
#include "yade/yade.hpp"

namespace yadefrag {

class FESolver;

using Colour = std::array<float, 3>;

struct PictureTriangle {
  std::array<Vec2, 3> corners;  ///< m
  Colour colour;
};

/// Picture of one body.
struct BodyPicture {
  int entry = -1;  ///< the surface entry with which the body is drawn
  std::vector<PictureTriangle> triangles;
  std::vector<std::array<Vec2, 2>> outline;  ///< m, all sides of its boundary
  std::vector<std::array<Vec2, 2>> held;     ///< m, cohesive cracks
};

/// Pictures by component. `field`: 'component', 'fragment' or 'mises', blue at 0 and red at the
/// largest value.
[[nodiscard]] std::vector<BodyPicture> picturesOf(const FESolver& solver, const std::string& field);

/// A distinct colour for each number.
[[nodiscard]] Colour colourOf(std::uint32_t number);

class Gl1_SurfaceSegment final : public Published<Gl1_SurfaceSegment, yade::GlShapeFunctor> {
 public:
  static constexpr const char* kName = "Gl1_SurfaceSegment";
  static constexpr const char* kDoc =
      "Draws the bodies of FESolver in the 3D view: their triangles, filled according to "
      "FESolver.view, or, where the SurfaceSegment or the view is drawn in wire, their edges; in "
      "black their boundaries and open cracks, in red cohesive cracks.";
  static Attributes attributes() { return {}; }

  void go(const yade::shared_ptr<yade::Shape>& shape, const yade::shared_ptr<yade::State>& state,
          bool wire, const yade::GLViewInfo& view) override;
  yade::string get1DFunctorType1() const override { return "SurfaceSegment"; }
  yade::string renders() const override { return "SurfaceSegment"; }
  void initgl() override {}

 private:
  void takePictures();

  std::vector<BodyPicture> pictures_;  // of the last update that did not have to wait
};

}  // namespace yadefrag
