#pragma once
// A sphere beside a facet, a wall or a box: the formulas of YADE's Ig2_Facet_Sphere_ScGeom,
// Ig2_Wall_Sphere_ScGeom and Ig2_Box_Sphere_ScGeom in the order of their operations, so that every
// bit is the same. The other shape is the first body. Most of these contacts have not begun, since
// the bounds of a slanted facet enclose many spheres: YADE's functor is only called where one
// begins.

#include <array>
#include <optional>

#include "loop/sphere_contact_kernels.hpp"

namespace yadefrag {

class ShapeContacts {
 public:
  using Functors = std::array<const yade::IGeomFunctor*, 3>;

  /// The functors of `dispatcher` whose geometry is a ScGeom6D, or a ScGeom.
  ShapeContacts(const yade::IGeomDispatcher& dispatcher, bool haveRotations);

  [[nodiscard]] Functors functors() const { return {facet_, wall_, box_}; }
  /// True: `functor` is one of them.
  [[nodiscard]] bool know(const yade::IGeomFunctor* functor) const {
    return functor && (functor == facet_ || functor == wall_ || functor == box_);
  }
  /// False: the first body has another shape than its functor needs.
  [[nodiscard]] bool isShapeOf(const yade::IGeomFunctor* functor, const yade::Body& body) const;
  /// True: a contact of `functor` that has not begun does not begin.
  [[nodiscard]] bool areApart(const yade::IGeomFunctor* functor, const yade::Body& body,
                              const BodyRow& sphere, const ImageShift& shift) const {
    return !find(functor, body, sphere, shift, false);
  }
  /// The geometry, after a step of `dt` (s), of a contact that has begun.
  [[nodiscard]] ContactGeometry next(const yade::IGeomFunctor* functor, const yade::Body& body,
                                     const yade::ScGeom& last, const BodyRow& one,
                                     const BodyRow& sphere, const ImageShift& shift,
                                     double dt) const;

 private:
  /// Where the two shapes touch.
  struct Touch {
    yade::Vector3r normal, point;
    double depth;
    double radius1;  // that stands for the other shape
    bool avoidsRatcheting;
  };

  [[nodiscard]] std::optional<Touch> find(const yade::IGeomFunctor* functor, const yade::Body& body,
                                          const BodyRow& sphere, const ImageShift& shift,
                                          bool isReal) const;
  [[nodiscard]] std::optional<Touch> onFacet(const yade::Body& body, const yade::Vector3r& centre,
                                             double radius, bool isReal) const;
  [[nodiscard]] std::optional<Touch> onWall(const yade::Body& body, const yade::Vector3r& centre,
                                            double radius, bool isReal) const;
  [[nodiscard]] std::optional<Touch> onBox(const yade::Body& body, const BodyRow& sphere,
                                           const yade::Vector3r& centre, bool isReal) const;

  // Null: there is none, or YADE's must be called.
  const yade::Ig2_Facet_Sphere_ScGeom* facet_ = nullptr;
  const yade::Ig2_Wall_Sphere_ScGeom* wall_ = nullptr;
  const yade::Ig2_Box_Sphere_ScGeom* box_ = nullptr;
};

}  // namespace yadefrag
