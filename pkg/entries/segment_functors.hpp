#pragma once
// Bound of a surface segment, and its contacts with spheres.

#include <tuple>

#include "abi/yade.hpp"
#include "publish/published.hpp"

namespace yadefrag {

class Bo1_SurfaceSegment_Aabb final
    : public Published<Bo1_SurfaceSegment_Aabb, yade::BoundFunctor> {
 public:
  static constexpr const char* kName = "Bo1_SurfaceSegment_Aabb";
  static constexpr const char* kDoc =
      "Computes the bound of a SurfaceSegment: the box of the segment, or of the arc's control "
      "points, "
      "enlarged by `halo` on every side (also along z).";
  static Attributes attributes() { return {}; }

  void go(const yade::shared_ptr<yade::Shape>& shape, yade::shared_ptr<yade::Bound>& bound,
          const yade::Se3r& se3, const yade::Body* body) override;
  yade::string get1DFunctorType1() const override { return "SurfaceSegment"; }
};

class Ig2_Sphere_SurfaceSegment_ScGeom final
    : public Published<Ig2_Sphere_SurfaceSegment_ScGeom, yade::IGeomFunctor> {
 public:
  static constexpr const char* kName = "Ig2_Sphere_SurfaceSegment_ScGeom";
  static constexpr const char* kDoc =
      "Computes the ScGeom of a Sphere and a SurfaceSegment. Distances are in the plane: the "
      "boundary is a prism along z. As with Ig2_Wall_Sphere_ScGeom the boundary has the "
      "sphere's radius, so that a flat one is as stiff as a Wall. Along a chain of segments "
      "every point belongs to one of them: no double force at "
      "a flat or convex junction, two forces in a concave corner.";
  static Attributes attributes() { return {}; }

  bool go(const yade::shared_ptr<yade::Shape>& sphere, const yade::shared_ptr<yade::Shape>& segment,
          const yade::State& state1, const yade::State& state2, const yade::Vector3r& shift2,
          const bool& force, const yade::shared_ptr<yade::Interaction>& contact) override;
  bool goReverse(const yade::shared_ptr<yade::Shape>& segment,
                 const yade::shared_ptr<yade::Shape>& sphere, const yade::State& state1,
                 const yade::State& state2, const yade::Vector3r& shift2, const bool& force,
                 const yade::shared_ptr<yade::Interaction>& contact) override;
  yade::string get2DFunctorType1() const override { return "Sphere"; }
  yade::string get2DFunctorType2() const override { return "SurfaceSegment"; }
  yade::string checkOrder() const override { return "Sphere SurfaceSegment"; }
};

}  // namespace yadefrag
