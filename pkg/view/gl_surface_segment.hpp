#pragma once
// Finite-element bodies in YADE's 3D view.

#include "abi/yade.hpp"
#include "publish/published.hpp"
#include "view/body_picture.hpp"

namespace yadefrag {

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
