#pragma once
// YADE's Law2_ScGeom6D_CohFrictPhys_CohesionMoment: bonds that break or yield, friction, moments of
// bending and twisting.

#include <algorithm>
#include <cmath>

#include "loop/contact_law.hpp"

namespace yadefrag {

/// What the law of all versions has.
class CohesiveBase {
 public:
  using Functor = yade::Law2_ScGeom6D_CohFrictPhys_CohesionMoment;
  using Geometry = yade::Ig2_Sphere_Sphere_ScGeom6D;
  using Phys = yade::CohFrictPhys;
  using Force = ForceAndMoment;
  static constexpr std::string_view kProperties =
      "N4yade40Ip2_CohFrictMat_CohFrictMat_CohFrictPhysE";
  static constexpr bool kUsesMasses = false;
  static constexpr std::size_t kBytes = sizeof(Phys);

  CohesiveBase(const Functor& functor, const yade::Scene& scene)
      : functor_(functor), scene_(scene) {}

  static const char* reasonForYade(const Functor& functor, const yade::Scene& scene) {
    if (functor.traceEnergy) return "traceEnergy is set";
    if (functor.twist_creep) return "twist_creep is set";
    return scene.trackEnergy ? "O.trackEnergy is set" : nullptr;
  }
  static bool changesProperties(const yade::IPhysFunctor& properties) {
    using Known = yade::Ip2_CohFrictMat_CohFrictMat_CohFrictPhys;
    return static_cast<const Known&>(properties).setCohesionNow;
  }
  static bool changesProperties(const Phys& phys) { return phys.initCohesion; }

 protected:
  [[nodiscard]] bool hasMoment(const Phys& phys) const {
    return phys.momentRotationLaw && (!phys.cohesionBroken || functor_.always_use_moment_law);
  }
  // With creep, and elastic in this step.
  template <class View>
  [[gnu::always_inline]] FourLanes elasticShear(const View& view, const Phys& phys) const {
    FourLanes shear{};
    if (view.contact.iterMadeReal != scene_.iter) shear = loadThree(phys.shearForce.data());
    if (functor_.shear_creep) shear -= phys.ks * (shear * scene_.dt / functor_.creep_viscosity);
    return turned(shear, view.geometry) - phys.ks * view.geometry.shearing;
  }
  [[gnu::always_inline]] static double limitOf(const Phys& phys, double adhesion, double friction) {
    if (!phys.cohesionDisablesFriction || adhesion == 0) adhesion += friction;
    return std::max(0., adhesion);
  }
  template <class View>
  [[gnu::always_inline]] static void sum(const View& view, const FourLanes& forceOnSecond,
                                         Force& force) {
    static_cast<ContactForce&>(force) =
        contactForce(view.geometry, forceOnSecond, false, view.one.position(), view.position2());
  }

  const Functor& functor_;
  const yade::Scene& scene_;
};

/// YADE before 2025.2: forces break a bond, moments do not.
class Cohesive2023 : public CohesiveBase {
 public:
  using CohesiveBase::CohesiveBase;
  using CohesiveBase::reasonForYade;

  [[gnu::always_inline]] const char* reasonForYade(const Phys& phys) const {
    if (functor_.useIncrementalForm || !phys.momentRotationLaw) return nullptr;
    if (phys.maxRollPl < 0 && phys.maxTwistPl < 0) return nullptr;
    return "YADE warns of limits of moments without useIncrementalForm";
  }

  template <class View>
  [[gnu::always_inline]] bool apply(const View& view, Phys& phys, Force& force) const {
    const ContactGeometry& geometry = view.geometry;
    double size = phys.kn * (geometry.depth - phys.unp);
    if (-size > phys.normalAdhesion && !yields(geometry, phys, size)) return false;
    FourLanes normalForce = size * geometry.normal;
    const FourLanes shear = shearOf(view, size, phys, normalForce);
    storeThree(normalForce, phys.normalForce.data());
    sum(view, normalForce + shear, force);
    force.hasMoment = hasMoment(phys);
    if (force.hasMoment) force.moment = momentOf(view, norm(normalForce), phys);
    return true;
  }

 private:
  // Beyond the tensile strength; false: the contact has ended.
  static bool yields(const ContactGeometry& geometry, Phys& phys, double& size) {
    if (phys.fragile) return false;
    size = -phys.normalAdhesion;
    phys.unp = geometry.depth + phys.normalAdhesion / phys.kn;
    return !(phys.unpMax >= 0 && -phys.unp > phys.unpMax);
  }

  // Limited by cohesion and friction; a brittle bond breaks there. `size`: of the normal force,
  // which a contact that slips has as pressure only.
  template <class View>
  [[gnu::always_inline]] FourLanes shearOf(const View& view, double size, Phys& phys,
                                           FourLanes& normalForce) const {
    FourLanes shear = elasticShear(view, phys);
    const double friction = size * phys.tangensOfFrictionAngle, force = norm(shear);
    double limit = limitOf(phys, phys.shearAdhesion, friction);
    if (force > limit) {
      if (phys.fragile && !phys.cohesionBroken) {
        phys.cohesionBroken = true;
        phys.normalAdhesion = phys.shearAdhesion = 0;
        limit = std::max(0., friction);
      }
      shear *= limit / force;
      if (size < 0) normalForce = FourLanes{};
    }
    storeThree(shear, phys.shearForce.data());
    return shear;
  }

  template <class View>
  [[gnu::always_inline]] FourLanes momentOf(const View& view, double pressure, Phys& phys) const {
    ElasticMoments moments;
    if (functor_.useIncrementalForm) {
      moments = ElasticMoments::of(view, phys.moment_bending.data(), phys.moment_twist.data(),
                                   phys.kr, phys.ktw, scene_.dt);
    } else {
      const auto& rotation = static_cast<const yade::ScGeom6D&>(*view.contact.geom);
      moments = {loadThree(rotation.bending.data()) * phys.kr,
                 (rotation.twist * phys.ktw) * view.geometry.normal};
    }
    auto& [bend, twist] = moments;
    limitTo(phys.maxRollPl, pressure, bend), limitTo(phys.maxTwistPl, pressure, twist);
    storeThree(bend, phys.moment_bending.data()), storeThree(twist, phys.moment_twist.data());
    return twist + bend;
  }
  [[gnu::always_inline]] static void limitTo(double factor, double pressure, FourLanes& moment) {
    if (!(factor >= 0)) return;
    const double limit = factor * pressure, size = norm(moment);
    if (size > limit) moment *= limit / size;
  }
};

}  // namespace yadefrag
