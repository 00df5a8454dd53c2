#pragma once
// YADE's Law2_ScGeom_FrictPhys_CundallStrack.

#include <algorithm>
#include <cmath>

#include "loop/contact_law.hpp"

namespace yadefrag {

class CundallStrack {
 public:
  using Functor = yade::Law2_ScGeom_FrictPhys_CundallStrack;
  using Geometry = yade::Ig2_Sphere_Sphere_ScGeom;
  using Phys = yade::FrictPhys;
  using Force = ContactForce;
  static constexpr std::string_view kProperties = "N4yade31Ip2_FrictMat_FrictMat_FrictPhysE";
  static constexpr bool kUsesMasses = false;
  static constexpr std::size_t kBytes = sizeof(Phys);

  CundallStrack(const Functor& functor, const yade::Scene& /*scene*/) : functor_(functor) {}

  static const char* reasonForYade(const Functor& functor, const yade::Scene& scene) {
    if (functor.traceEnergy) return "traceEnergy is set";
    return scene.trackEnergy ? "O.trackEnergy is set" : nullptr;
  }

  template <class View>
  [[gnu::always_inline]] bool apply(const View& view, Phys& phys, Force& force) const {
    if (view.geometry.depth < 0 && !functor_.neverErase) return false;
    force = contactForce(view.geometry, updateForces(view.geometry, phys), functor_.sphericalBodies,
                         view.one.position(), view.position2());
    return true;
  }

 private:
  /// Elastic normal force and shear force limited by friction; returns the force on the second
  /// body. The bodies touch, or the contact is kept without forces.
  [[gnu::always_inline]] static FourLanes updateForces(const ContactGeometry& geometry,
                                                       Phys& phys) {
    const FourLanes normalForce = phys.kn * std::max(geometry.depth, 0.) * geometry.normal;
    storeThree(normalForce, phys.normalForce.data());
    FourLanes shear = loadThree(phys.shearForce.data());
    if (geometry.depth < 0) shear = FourLanes{};
    shear = turned(shear, geometry) - phys.ks * geometry.shearing;
    const double tangent = phys.tangensOfFrictionAngle;
    const double limit = squaredNorm(normalForce) * (tangent * tangent);
    if (const double square = squaredNorm(shear); square > limit) {
      shear *= std::sqrt(limit) / std::sqrt(square);
    }
    storeThree(shear, phys.shearForce.data());
    return normalForce + shear;
  }

  const Functor& functor_;
};

}  // namespace yadefrag
