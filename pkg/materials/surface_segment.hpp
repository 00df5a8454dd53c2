#pragma once
// The shape of a surface entry's body: one piece of a boundary, material on the left. Its bound,
// and its contacts with spheres.

#include <vector>

#include "surface/contact_surface.hpp"
#include "surface/disc_contact.hpp"
#include "yade/published.hpp"
#include "yade/yade.hpp"

namespace yadefrag {

/// Coordinates are those of the world: the body's position and orientation do not define the
/// position of the piece. FESolver updates all members.
class SurfaceSegment final
    : public Published<SurfaceSegment, Indexed<SurfaceSegment, yade::Shape>, yade::Shape> {
 public:
  static constexpr const char* kName = "SurfaceSegment";
  static constexpr const char* kDoc =
      "One piece of the boundary of a finite-element body, in the plane z = const: a straight "
      "segment or a Bezier arc, with the material on its left. Its coordinates are those of the "
      "world; the position of its body does not matter. FESolver makes these and moves them; one "
      "created by a script is a rigid wall.";

  using Vector3r = yade::Vector3r;
  Vector3r start = Vector3r::Zero(), end = Vector3r::Zero(), middle = Vector3r::Zero();
  Vector3r before = Vector3r::Zero(), after = Vector3r::Zero();
  int kind = static_cast<int>(Piece::kSegment);
  double halo = 0;
  int entry = -1, component = -1;
  bool selfContact = true;
  /// A contact with a sphere that a crack changed (sphere_contacts.hpp). Its law has the overlap
  /// share · (overlap − tolerated).
  struct Changed {
    yade::Body::id_t sphere;
    double share, tolerated;  // 1, m
  };
  std::vector<Changed> changed;  // usually empty

  [[nodiscard]] bool isArc() const { return kind == static_cast<int>(Piece::kArc); }
  [[nodiscard]] BoundaryPiece piece() const {
    const auto flat = [](const Vector3r& v) { return Vec2{v[0], v[1]}; };
    return {flat(start), flat(middle), flat(end), flat(before), flat(after), isArc()};
  }

  /// Null for a contact that no crack has changed.
  [[nodiscard]] Changed* changedBy(yade::Body::id_t sphere);
  /// A share of 1 without a tolerated overlap removes the entry.
  void setChanged(const Changed& one);
  /// Of an overlap of `depth` (m; 0: none) with a sphere, the part that its law has. What is
  /// tolerated decreases with the overlap.
  double depthForLaw(yade::Body::id_t sphere, double depth);

  static Attributes attributes();
  void archiveMore(AnyArchive& archive);
};

class Bo1_SurfaceSegment_Aabb final
    : public Published<Bo1_SurfaceSegment_Aabb, yade::BoundFunctor> {
 public:
  static constexpr const char* kName = "Bo1_SurfaceSegment_Aabb";
  static constexpr const char* kDoc =
      "Computes the bound of a SurfaceSegment: the box of the segment, or of the arc's control "
      "points, enlarged by `halo` on every side (also along z).";
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
