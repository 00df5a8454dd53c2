#pragma once
// YADE's Law2_ScGeom_FrictPhys_CundallStrack.

#include <algorithm>
#include <cmath>
#include <string>

#include "loop/contact_law.hpp"

namespace yadefrag {

class CundallStrack {
 public:
  using Functor = yade::Law2_ScGeom_FrictPhys_CundallStrack;
  using Geometry = yade::Ig2_Sphere_Sphere_ScGeom;
  using Phys = yade::FrictPhys;
  using Force = TracedForce;
  static constexpr std::string_view kProperties = "N4yade31Ip2_FrictMat_FrictMat_FrictPhysE";
  static constexpr bool kUsesMasses = false;
  static constexpr std::size_t kBytes = sizeof(Phys);

  CundallStrack(const Functor& functor, const yade::Scene& scene)
      : functor_(functor), tracesEnergy_(functor.traceEnergy || scene.trackEnergy) {}

  static const char* reasonForYade(const Functor& /*functor*/, const yade::Scene& /*scene*/) {
    return nullptr;
  }

  template <class View>
  [[gnu::always_inline]] bool apply(const View& view, Phys& phys, Force& force) const {
    if (view.geometry.depth < 0 && !functor_.neverErase) return false;
    const FourLanes sum = updateForces(view.geometry, phys, force.energy);
    static_cast<ContactForce&>(force) = contactForce(view.geometry, sum, functor_.sphericalBodies,
                                                     view.one.position(), view.position2());
    return true;
  }

  [[nodiscard]] bool tracesEnergy() const { return tracesEnergy_; }

  /// To O.energy and the functor; `contacts`: visits those of the step in the order of
  /// O.interactions, in which YADE adds with one thread.
  template <class Contacts>
  static void addEnergies(Functor& functor, yade::EnergyTracker& tracker,
                          const Contacts& contacts) {
    const auto add = [&](const char* name, int& id, bool isOfStep, const auto& energyOf) {
      double sum = tracker.names.contains(name) ? tracker.getItem_py(name) : 0;
      contacts([&](const ContactEnergy& one) { sum += energyOf(one); });
      tracker.setItem_py(name, sum);
      id = tracker.names.at(name);
      if (isOfStep) tracker.resetStep[static_cast<std::size_t>(id)] = true;
    };
    double dissipated = 0;
    contacts([&](const ContactEnergy& one) { dissipated = std::max(dissipated, one.dissipated); });
    if (functor.traceEnergy) {
      contacts([&](const ContactEnergy& one) { functor.plasticDissipation += one.dissipated; });
    } else if (dissipated > 0) {
      add("plastDissip", functor.plastDissipIx, false,
          [](const ContactEnergy& one) { return std::max(one.dissipated, 0.); });
    }
    add("elastPotential", functor.elastPotentialIx, true,
        [](const ContactEnergy& one) { return one.elastic; });
  }

 private:
  /// Elastic normal force and shear force limited by friction; returns the force on the second
  /// body. The bodies touch, or the contact is kept without forces.
  [[gnu::always_inline]] FourLanes updateForces(const ContactGeometry& geometry, Phys& phys,
                                                ContactEnergy& energy) const {
    const FourLanes normalForce = phys.kn * std::max(geometry.depth, 0.) * geometry.normal;
    storeThree(normalForce, phys.normalForce.data());
    FourLanes shear = loadThree(phys.shearForce.data());
    if (geometry.depth < 0) shear = FourLanes{};
    shear = turned(shear, geometry) - phys.ks * geometry.shearing;
    const double tangent = phys.tangensOfFrictionAngle;
    const double limit = squaredNorm(normalForce) * (tangent * tangent);
    const FourLanes trial = shear;
    const double square = squaredNorm(shear);
    if (square > limit) shear *= std::sqrt(limit) / std::sqrt(square);
    storeThree(shear, phys.shearForce.data());
    if (tracesEnergy_) {
      energy.elastic = .5 * (squaredNorm(normalForce) / phys.kn + squaredNorm(shear) / phys.ks);
      energy.dissipated = square > limit ? dot((1 / phys.ks) * (trial - shear), shear) : 0;
      addDissipated(phys, energy.dissipated);
    }
    return normalForce + shear;
  }
  // YADE from 2026.1 on has a sum in each contact.
  template <class P>
  static void addDissipated(P& phys, double energy) {
    if constexpr (requires { phys.frictDissip; }) phys.frictDissip += energy;
  }

  const Functor& functor_;
  const bool tracesEnergy_;
};

}  // namespace yadefrag
