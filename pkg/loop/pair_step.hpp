#pragma once
// One contact in one step: geometry, physical properties, force.

#include <array>
#include <optional>
#include <utility>

#include "loop/body_rows.hpp"
#include "loop/contact_law.hpp"
#include "loop/shape_contacts.hpp"

namespace yadefrag {

/// What is the same for all contacts of a step, whatever the law; used by all threads at once.
class PairFunctors {
 public:
  /// The functors whose work is done here, or null; `properties` does nothing for a contact that
  /// has its properties.
  PairFunctors(yade::InteractionLoop& loop, yade::Scene& scene,
               const yade::Ig2_Sphere_Sphere_ScGeom* spheres, const yade::IPhysFunctor* properties,
               const yade::LawFunctor* law);

  using Contact = yade::shared_ptr<yade::Interaction>;
  /// What determines which contacts the loop computes.
  using Functors = std::array<const void*, 6>;
  [[nodiscard]] Functors functors() const {
    const auto [facet, wall, box] = shapes_.functors();
    return isAllKnown_ ? Functors{spheres_, properties_, law_, facet, wall, box} : Functors{};
  }
  /// False: YADE's functors compute all geometries.
  [[nodiscard]] bool computesGeometry() const { return spheres_ != nullptr; }
  /// False: YADE's laws compute all forces.
  [[nodiscard]] bool computesForces() const { return law_ != nullptr; }
  /// False: the loop uses no motion of bodies.
  [[nodiscard]] bool usesMotion() const { return spheres_ != nullptr || law_ != nullptr; }
  /// True: a contact whose geometry, physics and law are those that the loop computes.
  [[nodiscard]] bool isKnown(const yade::Interaction& contact) const {
    const auto& cache = contact.functorCache;
    return isAllKnown_ && (cache.geom.get() == spheres_ || shapes_.know(cache.geom.get())) &&
           cache.phys.get() == properties_ && cache.constLaw.get() == law_ && contact.geom &&
           contact.phys;
  }
  /// True: of the functor for two spheres whose geometry the loop computes.
  [[nodiscard]] bool areSpheres(const yade::Interaction& contact) const {
    return spheres_ && contact.functorCache.geom.get() == spheres_;
  }
  /// True: a contact that has not begun and does not begin in this step. Reads less than
  /// `evaluate`; if it is false, nothing is known.
  [[nodiscard]] [[gnu::noinline]] bool isFarApart(const yade::Interaction& contact) const;
  /// True: a contact of these rows, in its order, that has not begun and does not begin now.
  [[nodiscard]] [[gnu::always_inline]] bool isFarApart(const yade::Interaction& contact,
                                                       const BodyRow& one,
                                                       const BodyRow& two) const {
    if (contact.isReal()) return false;
    return areSpheres(contact) ? areApart(contact, one, two) : isFarShape(contact, two);
  }

 protected:
  /// Geometry and properties of a contact of the bodies `one` and `two`, which exist and whose
  /// order in it may be swapped. False: it has no force. Counts geometries that YADE's functors did
  /// not compute.
  bool update(const Contact& contact, const BodyRow& one, const BodyRow& two,
              bool changesProperties, long& fastGeometries) const;
  /// True: the known law.
  [[nodiscard]] bool isOfLaw(const yade::Interaction& contact) const {
    return law_ && contact.functorCache.constLaw.get() == law_;
  }
  /// True: it has properties, of the known functor.
  [[nodiscard]] bool hasProperties(const yade::Interaction& contact) const {
    return properties_ && contact.functorCache.phys.get() == properties_ && contact.phys;
  }
  void chooseLaw(yade::Interaction& contact) const;
  /// YADE's law; a contact that has ended is reset.
  static void callLaw(yade::Interaction& contact);
  void callBack(const Contact& contact) const;
  [[gnu::always_inline]] ContactGeometry updateGeometry(yade::ScGeom& geom, const BodyRow& one,
                                                        const BodyRow& two,
                                                        const ImageShift& shift) const {
    const ContactGeometry geometry = nextGeometry(loadThree(geom.normal.data()), one, two, shift,
                                                  scene_.dt, spheres_->avoidGranularRatcheting);
    geometry.write(geom);
    return geometry;
  }
  /// True: a contact of a sphere and another shape whose geometry the loop computes.
  [[nodiscard]] bool isOfShape(const yade::Interaction& contact, const BodyRow& sphere) const {
    const auto* const functor = contact.functorCache.geom.get();
    return shapes_.know(functor) && shapes_.isShapeOf(functor, bodyOf(contact.id1)) &&
           !std::isnan(sphere.radius());
  }
  /// Of such a contact, which has begun.
  [[gnu::noinline]] ContactGeometry updateShape(const yade::Interaction& contact,
                                                yade::ScGeom& geom, const BodyRow& one,
                                                const BodyRow& two, const ImageShift& shift) const {
    const ContactGeometry geometry = shapes_.next(
        contact.functorCache.geom.get(), bodyOf(contact.id1), geom, one, two, shift, scene_.dt);
    geometry.write(geom);
    return geometry;
  }
  [[gnu::always_inline]] [[nodiscard]] ImageShift shiftOf(const yade::Interaction& contact) const {
    return scene_.isPeriodic ? periodicShift(contact) : ImageShift{};
  }
  [[nodiscard]] const yade::Body& bodyOf(yade::Body::id_t id) const {
    return *(*scene_.bodies)[static_cast<unsigned>(id)];
  }

 private:
  // YADE's test, to the last bit.
  [[nodiscard]] [[gnu::always_inline]] bool areApart(const FourLanes& between, double radius1,
                                                     double radius2) const {
    const double reach = spheres_->interactionDetectionFactor * (radius1 + radius2);
    return reach * reach - squaredNorm(between) < 0;
  }
  [[nodiscard]] [[gnu::always_inline]] bool areApart(const yade::Interaction& contact,
                                                     const BodyRow& one, const BodyRow& two) const {
    return areApart(two.position() + shiftOf(contact).distance - one.position(), one.radius(),
                    two.radius());
  }
  [[nodiscard]] [[gnu::noinline]] bool isFarShape(const yade::Interaction& contact,
                                                  const BodyRow& sphere) const;
  [[nodiscard]] [[gnu::noinline]] ImageShift periodicShift(const yade::Interaction& contact) const;
  bool chooseGeometry(yade::Interaction& contact) const;
  bool updateGeometryOf(const Contact& contact, const BodyRow& one, const BodyRow& two,
                        long& fastGeometries) const;
  void updateProperties(const Contact& contact, bool wasReal, bool changesProperties) const;

  yade::InteractionLoop& loop_;
  yade::Scene& scene_;
  // The functors whose work is done here; null if there is none.
  const yade::Ig2_Sphere_Sphere_ScGeom* spheres_;
  const yade::IPhysFunctor* properties_;
  const yade::LawFunctor* law_;
  bool hasRotations_;  // of its geometry: YADE's functor is called for one that is not known
  ShapeContacts shapes_;
  std::vector<std::pair<yade::IntrCallback*, yade::IntrCallback::FuncPtr>> callbacks_;
  bool removesUnseen_;
  bool isAllKnown_;
};

/// PairFunctors with the known law. Compiled for each law: a contact costs no virtual call.
template <ContactLaw Law>
class PairStep : public PairFunctors {
 public:
  using Phys = typename Law::Phys;
  using Force = typename Law::Force;

  /// `functor`: of the law; null: YADE's laws compute all forces.
  PairStep(yade::InteractionLoop& loop, yade::Scene& scene, const typename Law::Functor* functor)
      : PairFunctors(loop, scene, exactly<typename Law::Geometry>(loop.geomDispatcher->functors),
                     propertiesOf(loop), functor),
        geometry_(exactly<typename Law::Geometry>(loop.geomDispatcher->functors)) {
    if (functor) lawOfStep_.emplace(*functor, scene);
  }
  [[nodiscard]] bool tracesEnergy() const { return lawOfStep_->tracesEnergy(); }
  /// True: YADE's law may compute the force of this contact.
  [[nodiscard]] bool isForYade(const yade::Interaction& contact) const {
    return !isOfLaw(contact) || !contact.phys || isException(*contact.phys);
  }
  /// True: a known contact for which YADE's functors must be called.
  [[gnu::always_inline]] [[nodiscard]] bool isException(const yade::IPhys& phys) const {
    if constexpr (kHasExceptions<Law>) {
      const auto& known = static_cast<const Phys&>(phys);
      return Law::changesProperties(known) || lawOfStep_->reasonForYade(known);
    }
    return false;
  }

  /// Evaluates one contact of the bodies `one` and `two`, which exist and whose order in it may be
  /// swapped. False: it has no force, or YADE's law has added it to the scene's forces. Counts
  /// geometries that YADE's functors did not compute.
  [[gnu::noinline]] bool evaluate(const Contact& contact, const BodyRow& one, const BodyRow& two,
                                  long& fastGeometries, Force& force) const {
    const auto id1 = contact->id1;
    if (!update(contact, one, two, changesProperties(*contact), fastGeometries)) return false;
    const bool isSwapped = contact->id1 != id1;
    bool isForce = false;
    if (!contact->functorCache.constLaw) chooseLaw(*contact);
    if (isForYade(*contact)) {
      callLaw(*contact);
    } else {
      const auto masses = [&] {
        return std::pair(BodyRows::massOf(bodyOf(contact->id1)),
                         BodyRows::massOf(bodyOf(contact->id2)));
      };
      isForce = addLaw(*contact, ContactGeometry::read(static_cast<yade::ScGeom&>(*contact->geom)),
                       static_cast<Phys&>(*contact->phys), isSwapped ? two : one,
                       isSwapped ? one : two, shiftOf(*contact), masses, force);
    }
    callBack(contact);
    return isForce;
  }
  /// Evaluates a known contact of bodies that exist, in its order, as `evaluate` does. `turns()`
  /// gives their orientations.
  template <class Masses, class Turns>
  [[gnu::always_inline]] bool evaluateKnown(yade::Interaction& contact, const PairRows& pair,
                                            const BodyRow& one, const BodyRow& two,
                                            const Masses& masses, const Turns& turns,
                                            Force& force) const {
    const ImageShift shift = shiftOf(contact);
    ContactGeometry geometry;
    if (pair.isOfSpheres) [[likely]] {
      geometry = updateGeometry(*pair.geom, one, two, shift);
    } else if (isOfShape(contact, two)) {
      geometry = updateShape(contact, *pair.geom, one, two, shift);
    } else {
      contact.reset();  // as `update` does
      return false;
    }
    if constexpr (kUsesRotations<Law>) {
      if (!pair.isOfSpheres || geometry_->updateRotations) {
        updateRotations(static_cast<yade::ScGeom6D&>(*pair.geom), geometry.normal, turns(),
                        pair.isOfSpheres && geometry_->creep);
      }
    }
    return addLaw(contact, geometry, static_cast<Phys&>(*pair.phys), one, two, shift, masses,
                  force);
  }

 private:
  static const yade::IPhysFunctor* propertiesOf(const yade::InteractionLoop& loop) {
    const auto* const properties = functorOf(loop.physDispatcher->functors, Law::kProperties);
    if constexpr (kHasExceptions<Law>) {
      if (properties && Law::changesProperties(*properties)) return nullptr;
    }
    return properties;
  }
  [[nodiscard]] bool changesProperties(const yade::Interaction& contact) const {
    if constexpr (kHasExceptions<Law>) {
      if (!contact.functorCache.phys) return true;  // of a scene that was loaded
      return hasProperties(contact) &&
             Law::changesProperties(static_cast<const Phys&>(*contact.phys));
    }
    return false;
  }
  // False: the contact has ended, and is reset.
  template <class Masses>
  [[gnu::always_inline]] bool addLaw(yade::Interaction& contact, const ContactGeometry& geometry,
                                     Phys& phys, const BodyRow& one, const BodyRow& two,
                                     const ImageShift& shift, const Masses& masses,
                                     Force& force) const {
    const ContactView<Masses> view{contact, geometry, one, two, shift, masses};
    if (lawOfStep_->apply(view, phys, force)) return true;
    contact.reset();
    return false;
  }

  const typename Law::Geometry* geometry_;
  std::optional<Law> lawOfStep_;
};

}  // namespace yadefrag
