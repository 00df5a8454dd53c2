#pragma once
// One contact in one step: geometry, physical properties, force.

#include <array>
#include <utility>

#include "loop/body_rows.hpp"

namespace yadefrag {

/// What is the same for all contacts of a step; used by all threads at once.
class PairStep {
 public:
  PairStep(yade::InteractionLoop& loop, yade::Scene& scene);

  using Contact = yade::shared_ptr<yade::Interaction>;
  /// What determines which contacts the loop computes.
  using Functors = std::array<const void*, 3>;
  [[nodiscard]] Functors functors() const {
    return isAllKnown_ ? Functors{spheres_, friction_, law_} : Functors{};
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
  /// Evaluates one contact of the bodies `one` and `two`, which exist and whose order in it may be
  /// swapped. False: it has no force, or YADE's law has added it to the scene's forces. Counts
  /// geometries that YADE's functors did not compute.
  [[gnu::noinline]] bool evaluate(const Contact& contact, const BodyRow& one, const BodyRow& two,
                                  long& fastGeometries, ContactForce& force) const;
  /// True: a contact whose geometry, physics and law are those that the loop computes.
  [[nodiscard]] bool isKnown(const yade::Interaction& contact) const {
    const auto& cache = contact.functorCache;
    return isAllKnown_ && cache.geom.get() == spheres_ && cache.phys.get() == friction_ &&
           cache.constLaw.get() == law_ && contact.geom && contact.phys;
  }
  /// Evaluates such a contact of bodies that exist, as `evaluate` does.
  [[gnu::always_inline]] bool evaluateKnown(yade::Interaction& contact, yade::ScGeom& geom,
                                            yade::FrictPhys& phys, const BodyRow& one,
                                            const BodyRow& two, ContactForce& force) const {
    const ImageShift shift = shiftOf(contact);
    const ContactGeometry geometry = nextGeometry(loadThree(geom.normal.data()), one, two, shift,
                                                  scene_.dt, spheres_->avoidGranularRatcheting);
    geometry.write(geom);
    return addLaw(contact, geometry, phys, one, two, shift, force);
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
  [[gnu::always_inline]] [[nodiscard]] ImageShift shiftOf(const yade::Interaction& contact) const {
    return scene_.isPeriodic ? periodicShift(contact) : ImageShift{};
  }
  [[nodiscard]] [[gnu::noinline]] ImageShift periodicShift(const yade::Interaction& contact) const;
  /// The known law. False: the contact has ended, and is reset.
  [[gnu::always_inline]] bool addLaw(yade::Interaction& contact, const ContactGeometry& geometry,
                                     yade::FrictPhys& phys, const BodyRow& one, const BodyRow& two,
                                     const ImageShift& shift, ContactForce& force) const {
    if (geometry.depth < 0 && !law_->neverErase) {
      contact.reset();
      return false;
    }
    force = contactForce(geometry, updateForces(geometry, phys), law_->sphericalBodies,
                         one.position(), two.position() + shift.distance);
    return true;
  }
  [[nodiscard]] const yade::Body& bodyOf(yade::Body::id_t id) const {
    return *(*scene_.bodies)[static_cast<unsigned>(id)];
  }
  bool chooseGeometry(yade::Interaction& contact) const;
  bool updateGeometryOf(const Contact& contact, const BodyRow& one, const BodyRow& two,
                        long& fastGeometries) const;
  void updateProperties(const Contact& contact, bool wasReal) const;
  void chooseLaw(yade::Interaction& contact) const;
  bool applyLaw(const Contact& contact, const BodyRow& one, const BodyRow& two,
                ContactForce& force) const;

  yade::InteractionLoop& loop_;
  yade::Scene& scene_;
  // The functors whose work is done here; null if there is none.
  const yade::Ig2_Sphere_Sphere_ScGeom* spheres_ = nullptr;
  const yade::IPhysFunctor* friction_ = nullptr;
  const yade::Law2_ScGeom_FrictPhys_CundallStrack* law_ = nullptr;
  std::vector<std::pair<yade::IntrCallback*, yade::IntrCallback::FuncPtr>> callbacks_;
  bool removesUnseen_;
  bool isAllKnown_;
};

}  // namespace yadefrag
