#pragma once
// YADE's Law2_ScGeom6D_CohFrictPhys_CohesionMoment from 2025.2 on: moments have adhesion, and break
// a bond as forces do.

#include <atomic>
#include <cmath>
#include <type_traits>

#include "loop/cohesive.hpp"

namespace yadefrag {

/// A template, since the YADE that is compiled for may lack members of `P` and `F`, its physics and
/// functor.
template <class P, class F>
class Cohesive2025 : public CohesiveBase {
 public:
  using Phys = P;
  using CohesiveBase::CohesiveBase;
  using CohesiveBase::reasonForYade;

  static const char* reasonForYade(const P& /*phys*/) { return nullptr; }

  template <class View>
  [[gnu::always_inline]] bool apply(const View& view, P& phys, Force& force) const {
    if (phys.momentRotationLaw) warnOnce(functor_, view.contact);
    force.hasMoment = hasMoment(phys);
    Elastic elastic;
    elastic.size = phys.kn * (view.geometry.depth - phys.unp);
    elastic.shear = elasticShear(view, phys);
    if (force.hasMoment) setMoments(view, phys, elastic);
    const bool lasts = limitToStrength(view.geometry.depth, phys, force.hasMoment, elastic);
    storeThree(elastic.shear, phys.shearForce.data());
    if (force.hasMoment) {
      storeThree(elastic.bend, phys.moment_bending.data());
      storeThree(elastic.twist, phys.moment_twist.data());
      force.moment = elastic.twist + elastic.bend;
    }
    if (!lasts) return false;
    const FourLanes normalForce = elastic.size * view.geometry.normal;
    storeThree(normalForce, phys.normalForce.data());
    sum(view, normalForce + elastic.shear, force);
    return true;
  }

 private:
  // Forces (N; `size`: along the normal) and moments (N m) that the strength may limit.
  struct Elastic {
    double size;
    FourLanes shear, bend, twist;
  };
  // Of a component: the square of its size and of its limit; which do not limit it if both are 0.
  struct Squares {
    double size = 0, limit = 0;
    [[nodiscard]] bool isBeyond() const { return size > limit; }
    [[gnu::always_inline]] void limitTo(FourLanes& component) const {
      if (isBeyond()) component *= std::sqrt(limit / size);
    }
  };
  struct Strength {
    Squares shear, bend, twist;
  };

  // YADE warns of limits of moments that do not fit, of the first contact that has moments.
  static void warnOnce(const F& functor, const yade::Interaction& contact) {
    if (!functor.consistencyCheck) return;
    if (!std::atomic_ref(const_cast<F&>(functor).consistencyCheck).exchange(false)) return;
    functor.checkConsistency(boost::static_pointer_cast<P>(contact.phys), contact.id1, contact.id2);
  }

  template <class View>
  [[gnu::always_inline]] void setMoments(const View& view, const P& phys, Elastic& elastic) const {
    const ContactGeometry& geometry = view.geometry;
    elastic.bend = elastic.twist = FourLanes{};
    if (!functor_.useIncrementalForm) {
      const auto& rotation = static_cast<const yade::ScGeom6D&>(*view.contact.geom);
      if (phys.kr > 0) elastic.bend = loadThree(rotation.bending.data()) * phys.kr;
      if (phys.ktw > 0) elastic.twist = (rotation.twist * phys.ktw) * geometry.normal;
      return;
    }
    const FourLanes spin = view.two.spin() - view.one.spin();
    const FourLanes about = dot(geometry.normal, spin) * geometry.normal;
    if (phys.kr > 0) {
      elastic.bend = turned(loadThree(phys.moment_bending.data()), geometry) -
                     phys.kr * (spin - about) * scene_.dt;
    }
    if (phys.ktw > 0) {
      elastic.twist =
          turned(loadThree(phys.moment_twist.data()), geometry) - phys.ktw * (about * scene_.dt);
    }
  }

  // False: the contact has ended.
  [[gnu::always_inline]] bool limitToStrength(double depth, P& phys, bool hasMoment,
                                              Elastic& elastic) const {
    Strength strength;
    while (true) {  // twice at most: a broken bond does not break
      if (phys.cohesionBroken && elastic.size < 0) return false;
      strength = strengthOf(phys, hasMoment, elastic);
      if (!breaks(depth, phys, elastic, strength)) break;
      setBroken(phys);
      if (depth < 0) return false;
    }
    if (-elastic.size > phys.normalAdhesion) {
      elastic.size = -phys.normalAdhesion;
      phys.unp = depth + phys.normalAdhesion / phys.kn;
    }
    strength.shear.limitTo(elastic.shear);
    strength.bend.limitTo(elastic.bend);
    strength.twist.limitTo(elastic.twist);
    return true;
  }

  [[gnu::always_inline]] static Strength strengthOf(const P& phys, bool hasMoment,
                                                    const Elastic& elastic) {
    const auto squares = [&](const FourLanes& component, double adhesion, double factor) {
      const double limit = limitOf(phys, adhesion, factor * elastic.size);
      return Squares{squaredNorm(component), limit * limit};
    };
    Strength all;
    if (phys.ks > 0) {
      all.shear = squares(elastic.shear, phys.shearAdhesion, phys.tangensOfFrictionAngle);
    }
    if (!hasMoment) return all;
    if (phys.kr > 0 && (phys.maxRollPl >= 0 || phys.rollingAdhesion >= 0)) {
      all.bend = squares(elastic.bend, phys.rollingAdhesion, phys.maxRollPl);
    }
    if (phys.ktw > 0 && (phys.maxTwistPl >= 0 || phys.twistingAdhesion >= 0)) {
      all.twist = squares(elastic.twist, phys.twistingAdhesion, phys.maxTwistPl);
    }
    return all;
  }

  [[gnu::always_inline]] static bool breaks(double depth, const P& phys, const Elastic& elastic,
                                            const Strength& strength) {
    const bool isBrittle = phys.fragile && !phys.cohesionBroken;
    if (isBrittle || phys.unpMax >= 0) {
      if (-elastic.size > phys.normalAdhesion) return true;
      if (phys.unpMax >= 0 && -(depth + phys.normalAdhesion / phys.kn) > phys.unpMax) return true;
    }
    return isBrittle &&
           (strength.shear.isBeyond() || (strength.bend.isBeyond() && phys.rollingAdhesion > 0) ||
            (strength.twist.isBeyond() && phys.twistingAdhesion > 0));
  }

  // YADE's CohFrictPhys::SetBreakingState, which keeps the friction of rolling.
  void setBroken(P& phys) const {
    phys.cohesionBroken = true;
    phys.normalAdhesion = phys.shearAdhesion = phys.rollingAdhesion = phys.twistingAdhesion = 0;
    if (!functor_.always_use_moment_law) phys.maxTwistPl = 0;
  }
};

template <class P, class F>
struct CohesiveOf {
  using Type = Cohesive2023;
};
template <class P, class F>
requires requires(P& phys) { phys.rollingAdhesion; }
struct CohesiveOf<P, F> {
  using Type = Cohesive2025<P, F>;
};

/// That of the YADE that is compiled for.
using Cohesive = CohesiveOf<CohesiveBase::Phys, CohesiveBase::Functor>::Type;

}  // namespace yadefrag
