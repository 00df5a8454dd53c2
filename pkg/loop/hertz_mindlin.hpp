#pragma once
// YADE's Law2_ScGeom_MindlinPhys_Mindlin: Hertz's normal force, Mindlin's shear force without slip,
// friction, with the law's options damping, adhesion (DMT) and moments of rolling and twisting.

#include <cmath>
#include <iostream>

#include "core/lanes.hpp"
#include "loop/contact_law.hpp"

namespace yadefrag {

/// Coefficients (N s/m) of a contact in a step.
struct HertzDamping {
  bool isUsed = false;
  double normal = 0, shear = 0;

  template <class View, class Phys>
  [[gnu::always_inline]] static HertzDamping of(const View& view, const Phys& phys, long step) {
    if (phys.betan != 0. || phys.betas != 0.) {
      const double mass = reducedMass(view.masses());
      if (phys.kn < 0 || phys.ks < 0) warnOfStiffness(view.contact, phys, step);
      return {true, 2. * std::sqrt(mass * phys.kn) * phys.betan,
              2. * std::sqrt(mass * phys.ks) * phys.betas};
    }
    if constexpr (requires { phys.beta; }) {  // YADE from 2025.2 on
      if (phys.beta != 0.) {
        const double mass = reducedMass(view.masses());
        const double both = 2. * phys.beta * std::pow(phys.kno / mass, -.4) / 3 * phys.kn;
        return {true, both, both};
      }
    }
    return {};
  }

 private:
  // In the words of YADE, which goes on, too, with forces that are no numbers.
  [[gnu::cold, gnu::noinline]] static void warnOfStiffness(const yade::Interaction& contact,
                                                           const yade::MindlinPhys& phys,
                                                           long step) {
    std::cerr << "Negative stiffness kn=" << phys.kn << " ks=" << phys.ks << " for ##"
              << contact.id1 << "+" << contact.id2 << ", step " << step << std::endl;
  }
};

class HertzMindlin {
 public:
  using Functor = yade::Law2_ScGeom_MindlinPhys_Mindlin;
  using Geometry = yade::Ig2_Sphere_Sphere_ScGeom;
  using Phys = yade::MindlinPhys;
  using Force = ForceAndMoment;
  static constexpr std::string_view kProperties = "N4yade33Ip2_FrictMat_FrictMat_MindlinPhysE";
  static constexpr bool kUsesMasses = true;
  static constexpr std::size_t kBytes = offsetof(Phys, prevU);

  HertzMindlin(const Functor& functor, const yade::Scene& scene)
      : functor_(functor), scene_(scene) {}

  static const char* reasonForYade(const Functor& functor, const yade::Scene& /*scene*/) {
    return functor.calcEnergy ? "calcEnergy is set" : nullptr;
  }

  template <class View>
  [[gnu::always_inline]] bool apply(const View& view, Phys& phys, Force& force) const {
    const ContactGeometry& geometry = view.geometry;
    noteBegin(view.contact, geometry, phys);
    force = Force{};
    if (geometry.depth < 0) return keepApart(phys);
    FourLanes normalForce = elasticNormal(geometry, phys);
    const auto damping = HertzDamping::of(view, phys, scene_.iter);
    if (damping.isUsed) dampNormal(view, damping.normal, phys, normalForce);
    storeThree(normalForce, phys.normalForce.data());
    const double pressure = norm(normalForce);
    const FourLanes shearForce = shearOf(geometry, damping, pressure, phys);
    static_cast<ContactForce&>(force) =
        contactForce(geometry, normalForce + shearForce, scene_.isPeriodic, view.one.position(),
                     view.two.position());
    force.hasMoment = functor_.includeMoment;
    if (force.hasMoment) force.moment = momentOf(view, pressure, phys);
    return true;
  }

 private:
  // Only YADE with the feature PARTIALSAT has this member.
  template <class P>
  void noteBegin(const yade::Interaction& contact, const ContactGeometry& geometry, P& phys) const {
    if constexpr (requires { phys.initD; }) {
      if (contact.iterMadeReal == scene_.iter) phys.initD = geometry.depth;
    }
  }

  // False: the contact has ended.
  bool keepApart(Phys& phys) const {
    if (!functor_.neverErase) return false;
    phys.shearForce.setZero(), phys.normalForce.setZero();
    phys.kn = phys.ks = 0;
    return true;
  }

  [[gnu::always_inline]] FourLanes elasticNormal(const ContactGeometry& geometry,
                                                 Phys& phys) const {
    // YADE calls std::pow: products with a square root have other bits.
    const auto [root, threeHalves] = halfPowersOf(geometry.depth);
    double size = phys.kno * threeHalves;
    if (functor_.includeAdhesion) {
      size -= phys.adhesionForce;
      phys.isAdhesive = size < 0;
    }
    phys.kn = 3. / 2. * phys.kno * root;
    phys.ks = phys.kso * root;
    return size * geometry.normal;
  }

  // By damping the bodies do not attract each other; with adhesion by no more than that.
  template <class View>
  [[gnu::always_inline]] void dampNormal(const View& view, double damping, Phys& phys,
                                         FourLanes& force) const {
    const FourLanes& normal = view.geometry.normal;
    const FourLanes velocity = velocityAt(view.geometry.point, view.one, view.two, view.shift);
    FourLanes viscous = damping * (dot(normal, velocity) * normal);
    const FourLanes both = force - viscous;
    const bool isPulling = dot(both, normal) < 0.;
    if (phys.adhesionForce == 0. || !functor_.includeAdhesion) {
      force = isPulling ? FourLanes{} : both;
      if (isPulling) viscous += both;
    } else {
      if (const double size = norm(viscous); isPulling && size > phys.adhesionForce)
        viscous = phys.adhesionForce * (viscous / size);
      force -= viscous;
    }
    storeThree(viscous, phys.normalViscous.data());
  }

  // The shear force up to the limit of friction; damped unless it slips.
  [[gnu::always_inline]] FourLanes shearOf(const ContactGeometry& geometry,
                                           const HertzDamping& damping, double pressure,
                                           Phys& phys) const {
    const FourLanes speed = geometry.shearing / scene_.dt, way = speed * scene_.dt;
    FourLanes shear = turned(loadThree(phys.shearElastic.data()), geometry) - phys.ks * way;
    FourLanes elastic = turned(loadThree(phys.usElastic.data()), geometry) - way;
    storeThree(turned(loadThree(phys.usTotal.data()), geometry) - way, phys.usTotal.data());
    const double limit = phys.tangensOfFrictionAngle *
                         (functor_.includeAdhesion ? phys.adhesionForce + pressure : pressure);
    const double square = squaredNorm(shear);
    const bool isSliding = square > limit * limit;
    FourLanes viscous{};
    if (isSliding) {
      const double ratio = limit / std::sqrt(square);
      shear *= ratio, elastic *= ratio;
    } else if (damping.isUsed) {
      viscous = damping.shear * speed;
    }
    const FourLanes force = shear - viscous;
    phys.isSliding = isSliding;
    storeThree(shear, phys.shearElastic.data()), storeThree(force, phys.shearForce.data());
    storeThree(elastic, phys.usElastic.data()), storeThree(viscous, phys.shearViscous.data());
    return force;
  }

  template <class View>
  [[gnu::always_inline]] FourLanes momentOf(const View& view, double pressure, Phys& phys) const {
    auto [bend, twist] = ElasticMoments::of(view, phys.momentBend.data(), phys.momentTwist.data(),
                                            phys.kr, phys.ktw, scene_.dt);
    const double limit = phys.maxBendPl * pressure, size = norm(bend);
    if (limit > 0 && size > limit) bend *= limit / size;
    storeThree(bend, phys.momentBend.data()), storeThree(twist, phys.momentTwist.data());
    return twist + bend;
  }

  const Functor& functor_;
  const yade::Scene& scene_;
};

}  // namespace yadefrag
