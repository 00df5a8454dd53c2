#pragma once
// What a law is for the loop. A new one is a file as `cundall_strack.hpp` and a name in
// `known_laws.hpp`.

#include <concepts>
#include <cstddef>
#include <string_view>
#include <type_traits>
#include <typeinfo>
#include <utility>

#include "loop/sphere_contact_kernels.hpp"

namespace yadefrag {

/// A contact in a step, as laws see it. `masses()` reads those of both bodies: only laws for which
/// `kUsesMasses` holds may call it.
template <class Masses>
struct ContactView {
  const yade::Interaction& contact;
  const ContactGeometry& geometry;
  const BodyRow& one;
  const BodyRow& two;
  const ImageShift& shift;
  const Masses& masses;

  /// Of the second body, or of its image that is in contact.
  [[gnu::always_inline]] [[nodiscard]] FourLanes position2() const {
    return two.position() + shift.distance;
  }
};

/// (kg) Of two bodies, of which one may not obey forces.
inline double reducedMass(const std::pair<BodyMass, BodyMass>& bodies) {
  const auto& [one, two] = bodies;
  if (!one.isDynamic && two.isDynamic) return two.mass;
  if (!two.isDynamic && one.isDynamic) return one.mass;
  return one.mass * two.mass / (one.mass + two.mass);
}

/// The functor of exactly this class, whose formulas are known; a derived one has others.
template <class Known, class Functor>
Known* exactly(const yade::vector<yade::shared_ptr<Functor>>& functors) {
  for (const auto& functor : functors) {
    Functor& one = *functor;
    if (typeid(one) == typeid(Known)) return static_cast<Known*>(&one);
  }
  return nullptr;
}

/// By the name of its type: getClassName() would allocate memory in each step.
inline const yade::IPhysFunctor* functorOf(
    const yade::vector<yade::shared_ptr<yade::IPhysFunctor>>& functors, std::string_view type) {
  for (const auto& functor : functors) {
    const yade::IPhysFunctor& one = *functor;
    if (typeid(one).name() == type) return &one;
  }
  return nullptr;
}

/// Force and, if `hasMoment`, moment (N m) on the second body; its opposite acts on the first one.
struct ForceAndMoment : ContactForce {
  FourLanes moment;
  bool hasMoment;
};

/// Energies (J) of a contact: of its springs, and what friction dissipates in the step.
struct ContactEnergy {
  double elastic = 0, dissipated = 0;
};
struct TracedForce : ContactForce {
  ContactEnergy energy;
};

/// Moments (N m) of a contact that turns with its bodies: `bend` and `twist` of the last step, and
/// the increments by the stiffnesses (N m/rad) in this one.
struct ElasticMoments {
  FourLanes bend, twist;

  template <class View>
  [[gnu::always_inline]] static ElasticMoments of(const View& view, const double* bend,
                                                  const double* twist, double bending,
                                                  double twisting, double dt) {
    const FourLanes spin = view.two.spin() - view.one.spin();
    const FourLanes about = dot(view.geometry.normal, spin) * view.geometry.normal;
    return {turned(loadThree(bend), view.geometry) - bending * ((spin - about) * dt),
            turned(loadThree(twist), view.geometry) - twisting * (about * dt)};
  }
};

using AnyMasses = std::pair<BodyMass, BodyMass> (*)();

/// The formulas of one of YADE's laws, in the order of its operations, so that every bit is the
/// same; one object for a step, used by all threads at once.
template <class Law>
concept ContactLaw = requires(const Law& law, const typename Law::Functor& functor,
                              const yade::Scene& scene, const ContactView<AnyMasses>& view,
                              typename Law::Phys& phys, typename Law::Force& force) {
  requires std::derived_from<typename Law::Functor, yade::LawFunctor>;
  requires std::derived_from<typename Law::Phys, yade::FrictPhys>;
  // Functor of two spheres whose geometry the loop computes.
  requires std::derived_from<typename Law::Geometry, yade::Ig2_Sphere_Sphere_ScGeom>;
  // What is added to the two bodies; it may have a `moment` (N m), which is then added to the
  // second body, and its opposite to the first one, if `hasMoment`.
  requires std::derived_from<typename Law::Force, ContactForce>;
  // Type of the functor that leaves properties as they are once a contact has them.
  { Law::kProperties } -> std::convertible_to<std::string_view>;
  { Law::kUsesMasses } -> std::convertible_to<bool>;
  // Bytes of `Phys` that the law reads and writes.
  { Law::kBytes } -> std::convertible_to<std::size_t>;
  // Why YADE's functor must be called; null: the law computes what it computes.
  { Law::reasonForYade(functor, scene) } -> std::same_as<const char*>;
  Law(functor, scene);
  // False: the contact has ended.
  { law.apply(view, phys, force) } -> std::same_as<bool>;
};

/// Laws whose geometry has rotations.
template <class Law>
constexpr bool kUsesRotations =
    std::same_as<typename Law::Geometry, yade::Ig2_Sphere_Sphere_ScGeom6D>;

/// Laws that trace energies on request.
template <class Law>
constexpr bool kTracesEnergy = std::same_as<typename Law::Force, TracedForce>;

/// The class of geometry that a law's functor makes.
template <class Law>
using ContactOf = std::conditional_t<kUsesRotations<Law>, yade::ScGeom6D, yade::ScGeom>;

/// Laws whose functor for properties may change those that a contact has: then, by
/// `changesProperties`, of the functor or of a contact, it is called; and whose functor may have to
/// be called for some contacts only, for which `reasonForYade` of the physics is not null.
template <class Law>
constexpr bool kHasExceptions = requires(const Law& law, const typename Law::Phys& phys,
                                         const yade::IPhysFunctor& properties) {
  { Law::changesProperties(properties) } -> std::same_as<bool>;
  { Law::changesProperties(phys) } -> std::same_as<bool>;
  { law.reasonForYade(phys) } -> std::same_as<const char*>;
};

}  // namespace yadefrag
