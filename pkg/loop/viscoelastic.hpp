#pragma once
// YADE's Law2_ScGeom_ViscElPhys_Basic: spring and damper in both directions, friction, rolling
// resistance.

#include <cmath>

#include "loop/contact_law.hpp"

namespace yadefrag {

class Viscoelastic {
 public:
  using Functor = yade::Law2_ScGeom_ViscElPhys_Basic;
  using Geometry = yade::Ig2_Sphere_Sphere_ScGeom;
  using Phys = yade::ViscElPhys;
  using Force = ContactForce;
  static constexpr std::string_view kProperties = "N4yade34Ip2_ViscElMat_ViscElMat_ViscElPhysE";
  static constexpr bool kUsesMasses = false;
  static constexpr std::size_t kBytes = sizeof(Phys);

  Viscoelastic(const Functor& /*functor*/, const yade::Scene& scene) : scene_(scene) {}

  static const char* reasonForYade(const Functor& /*functor*/, const yade::Scene& /*scene*/) {
    return reasonOfFeature<Phys>();
  }

  template <class View>
  [[gnu::always_inline]] bool apply(const View& view, Phys& phys, Force& force) const {
    const ContactGeometry& geometry = view.geometry;
    if (geometry.depth < 0) return false;
    const Motion motion = Motion::of(view);
    const double rate = dot(geometry.normal, motion.velocity);
    const FourLanes normalForce = normalOf(geometry, rate, phys);
    const FourLanes slip = motion.velocity - rate * geometry.normal;
    FourLanes shear{}, viscous{};
    if (view.contact.iterMadeReal != scene_.iter) shear = loadThree(phys.shearForce.data());
    shear = turned(shear, geometry) + (phys.ks * scene_.dt) * slip;
    const double tangent = phys.tangensOfFrictionAngle;
    const double limit = squaredNorm(normalForce) * (tangent * tangent);
    // Damped unless it slips.
    if (squaredNorm(shear) > limit) {
      shear *= std::sqrt(limit) / norm(shear);
    } else {
      viscous = phys.cs * slip;
    }
    storeThree(shear, phys.shearForce.data());
    const FourLanes both = normalForce + shear + viscous;
    const FourLanes moment = momentOf(view, motion, norm(normalForce), phys);
    force = {-both, moment - cross(motion.arm1, both), cross(motion.arm2, both) - moment};
    // YADE's law ends contacts that a script has switched off, after it has computed them.
    return view.contact.isActive;
  }

 private:
  /// Arms (m) from the bodies to the contact, and the velocity (m/s) that the law uses: of the
  /// first body relative to the second one, with the difference of images added, not subtracted, as
  /// YADE does.
  struct Motion {
    FourLanes arm1, arm2, velocity;

    template <class View>
    [[gnu::always_inline]] static Motion of(const View& view) {
      const BodyRow &one = view.one, &two = view.two;
      const FourLanes arm1 = view.geometry.point - one.position();
      const FourLanes arm2 = view.geometry.point - two.position() - view.shift.distance;
      return {arm1, arm2,
              (one.velocity() + cross(one.spin(), arm1)) -
                  (two.velocity() + cross(two.spin(), arm2)) + view.shift.velocity};
    }
  };

  // Radii and contacts that these features of YADE change are not known here.
  template <class P>
  static const char* reasonOfFeature() {
    if constexpr (requires(P & phys) { phys.SPHmode; }) return "YADE has the feature SPH";
    if constexpr (requires(P & phys) { phys.DeformEnabled; }) return "YADE has the feature DEFORM";
    return nullptr;
  }

  // By damping the bodies do not attract each other.
  [[gnu::always_inline]] static FourLanes normalOf(const ContactGeometry& geometry, double rate,
                                                   Phys& phys) {
    phys.Fn = phys.kn * geometry.depth;
    phys.Fv = phys.cn * rate;
    const double size = phys.Fn + phys.Fv;
    const FourLanes force = size < 0 ? FourLanes{} : size * geometry.normal;
    storeThree(force, phys.normalForce.data());
    return force;
  }

  // Of rolling resistance, on the first body; type 2 is proportional to the difference of the
  // velocities by rotation.
  template <class View>
  [[gnu::always_inline]] static FourLanes momentOf(const View& view, const Motion& motion,
                                                   double pressure, const Phys& phys) {
    if (!(phys.mR > 0) || phys.mRtype < 1 || phys.mRtype > 2) return FourLanes{};
    const FourLanes spin1 = view.one.spin(), spin2 = view.two.spin();
    double size = -phys.mR;
    if (phys.mRtype == 2) size *= norm(cross(motion.arm1, spin1) - cross(motion.arm2, spin2));
    return size * pressure * (spin1 - spin2);
  }

  const yade::Scene& scene_;
};

}  // namespace yadefrag
