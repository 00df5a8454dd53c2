#pragma once
// One contact in one step: geometry, physical properties, force.

#include <array>
#include <optional>
#include <utility>

#include "loop/body_rows.hpp"
#include "loop/contact_law.hpp"

namespace yadefrag {

/// What is the same for all contacts of a step, whatever the law; used by all threads at once.
class PairFunctors {
 public:
  /// `law`: the functor whose work is done here, or null; `properties`: the type of that for the
  /// properties.
  PairFunctors(yade::InteractionLoop& loop, yade::Scene& scene, const yade::LawFunctor* law,
               std::string_view properties);

  using Contact = yade::shared_ptr<yade::Interaction>;
  /// What determines which contacts the loop computes.
  using Functors = std::array<const void*, 3>;
  [[nodiscard]] Functors functors() const {
    return isAllKnown_ ? Functors{spheres_, properties_, law_} : Functors{};
  }
  /// False: YADE's functors compute all geometries.
  [[nodiscard]] bool computesGeometry() const { return spheres_ != nullptr; }
  /// False: YADE's laws compute all forces.
  [[nodiscard]] bool computesForces() const { return law_ != nullptr; }
  /// True: YADE's law may compute the force of this contact.
  [[nodiscard]] bool isForYade(const yade::Interaction& contact) const {
    return contact.functorCache.constLaw.get() != law_;
  }
  /// False: the loop uses no motion of bodies.
  [[nodiscard]] bool usesMotion() const { return spheres_ != nullptr || law_ != nullptr; }
  /// True: a contact whose geometry, physics and law are those that the loop computes.
  [[nodiscard]] bool isKnown(const yade::Interaction& contact) const {
    const auto& cache = contact.functorCache;
    return isAllKnown_ && cache.geom.get() == spheres_ && cache.phys.get() == properties_ &&
           cache.constLaw.get() == law_ && contact.geom && contact.phys;
  }
  /// True: a contact that has not begun and does not begin in this step. Reads less than
  /// `evaluate`; if it is false, nothing is known.
  [[nodiscard]] [[gnu::noinline]] bool isFarApart(const yade::Interaction& contact) const;
  /// The same for bodies in rows, in the order of the contact.
  [[nodiscard]] [[gnu::always_inline]] bool isFarApart(const yade::Interaction& contact,
                                                       const BodyRow& one,
                                                       const BodyRow& two) const {
    return isKnownPair(contact) && !contact.isReal() && areApart(contact, one, two);
  }

 protected:
  /// Geometry and properties of a contact of the bodies `one` and `two`, which exist and whose
  /// order in it may be swapped. False: it has no force. Counts geometries that YADE's functors did
  /// not compute.
  bool update(const Contact& contact, const BodyRow& one, const BodyRow& two,
              long& fastGeometries) const;
  /// False: the known law; otherwise YADE's law has computed the contact.
  bool isLeftToYade(yade::Interaction& contact) const;
  void callBack(const Contact& contact) const;
  [[gnu::always_inline]] ContactGeometry updateGeometry(yade::ScGeom& geom, const BodyRow& one,
                                                        const BodyRow& two,
                                                        const ImageShift& shift) const {
    const ContactGeometry geometry = nextGeometry(loadThree(geom.normal.data()), one, two, shift,
                                                  scene_.dt, spheres_->avoidGranularRatcheting);
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
  [[nodiscard]] bool isKnownPair(const yade::Interaction& contact) const {
    return spheres_ && contact.functorCache.geom.get() == spheres_;
  }
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
  [[nodiscard]] [[gnu::noinline]] ImageShift periodicShift(const yade::Interaction& contact) const;
  bool chooseGeometry(yade::Interaction& contact) const;
  bool updateGeometryOf(const Contact& contact, const BodyRow& one, const BodyRow& two,
                        long& fastGeometries) const;
  void updateProperties(const Contact& contact, bool wasReal) const;
  void chooseLaw(yade::Interaction& contact) const;

  yade::InteractionLoop& loop_;
  yade::Scene& scene_;
  // The functors whose work is done here; null if there is none.
  const yade::Ig2_Sphere_Sphere_ScGeom* spheres_ = nullptr;
  const yade::IPhysFunctor* properties_ = nullptr;
  const yade::LawFunctor* law_;
  std::vector<std::pair<yade::IntrCallback*, yade::IntrCallback::FuncPtr>> callbacks_;
  bool removesUnseen_;
  bool isAllKnown_;
};

/// The same, with the known law. Compiled for each law, so that a contact costs no virtual call.
template <ContactLaw Law>
class PairStep : public PairFunctors {
 public:
  using Phys = typename Law::Phys;
  using Force = typename Law::Force;

  /// `functor`: of the law; null: YADE's laws compute all forces.
  PairStep(yade::InteractionLoop& loop, yade::Scene& scene, const typename Law::Functor* functor)
      : PairFunctors(loop, scene, functor, Law::kProperties) {
    if (functor) lawOfStep_.emplace(*functor, scene);
  }

  /// Evaluates one contact of the bodies `one` and `two`, which exist and whose order in it may be
  /// swapped. False: it has no force, or YADE's law has added it to the scene's forces. Counts
  /// geometries that YADE's functors did not compute.
  [[gnu::noinline]] bool evaluate(const Contact& contact, const BodyRow& one, const BodyRow& two,
                                  long& fastGeometries, Force& force) const {
    const auto id1 = contact->id1;
    if (!update(contact, one, two, fastGeometries)) return false;
    const bool isSwapped = contact->id1 != id1;
    bool isForce = false;
    if (!isLeftToYade(*contact)) {
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
  /// Evaluates a known contact of bodies that exist, in its order, as `evaluate` does.
  template <class Masses>
  [[gnu::always_inline]] bool evaluateKnown(yade::Interaction& contact, yade::ScGeom& geom,
                                            yade::FrictPhys& phys, const BodyRow& one,
                                            const BodyRow& two, const Masses& masses,
                                            Force& force) const {
    const ImageShift shift = shiftOf(contact);
    return addLaw(contact, updateGeometry(geom, one, two, shift), static_cast<Phys&>(phys), one,
                  two, shift, masses, force);
  }

 private:
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

  std::optional<Law> lawOfStep_;
};

}  // namespace yadefrag
