#pragma once
// One contact in one step: geometry, physical properties, force.

#include <optional>
#include <utility>

#include "loop/body_rows.hpp"

namespace yadefrag {

/// What is the same for all contacts of a step; used by all threads at once.
class PairStep {
 public:
  PairStep(yade::InteractionLoop& loop, yade::Scene& scene);

  using Contact = yade::shared_ptr<yade::Interaction>;
  /// Evaluates one contact of the bodies `one` and `two`, whose order in it may be swapped. Returns
  /// its force, or nothing if it has none or YADE's law has added it to the scene's forces. Counts
  /// geometries that YADE's functors did not compute.
  [[gnu::noinline]] std::optional<ContactForce> evaluate(const Contact& contact, const BodyRow& one,
                                                         const BodyRow& two,
                                                         long& fastGeometries) const;
  /// True: a contact whose geometry, physics and law are those that the loop computes.
  [[nodiscard]] bool isKnown(const yade::Interaction& contact) const {
    const auto& cache = contact.functorCache;
    return isAllKnown_ && cache.geom.get() == spheres_ && cache.phys.get() == friction_ &&
           cache.constLaw.get() == law_ && contact.geom && contact.phys;
  }
  /// Evaluates such a contact, as `evaluate` does.
  [[gnu::always_inline]] bool evaluateKnown(yade::Interaction& contact, const BodyRow& one,
                                            const BodyRow& two, ContactForce& force) const {
    if (!one.body || !two.body || isElsewhere(one, two)) {
      contact.reset();
      return false;
    }
    auto& geom = static_cast<yade::ScGeom&>(*contact.geom);
    auto& phys = static_cast<yade::FrictPhys&>(*contact.phys);
    updateGeometry(geom, one.motion, two.motion, scene_.dt, spheres_->avoidGranularRatcheting);
    if (!updateForces(geom, phys, law_->neverErase)) {
      contact.reset();
      return false;
    }
    force =
        contactForce(geom, phys, law_->sphericalBodies, one.motion.position, two.motion.position);
    return true;
  }
  /// True: a contact that has not begun and does not begin in this step. Reads less than
  /// `evaluate`; if it is false, nothing is known.
  [[nodiscard]] [[gnu::noinline]] bool isFarApart(const yade::Interaction& contact) const;

 private:
  [[nodiscard]] bool isKnownPair(const yade::Interaction& contact) const {
    return spheres_ && contact.functorCache.geom.get() == spheres_;
  }
  [[nodiscard]] bool areApart(const yade::Vector3r& place1, double radius1,
                              const yade::Vector3r& place2, double radius2) const;
  [[nodiscard]] bool isElsewhere([[maybe_unused]] const BodyRow& one,
                                 [[maybe_unused]] const BodyRow& two) const {
#ifdef YADE_MPI
    return one.subdomain != scene_.subdomain && two.subdomain != scene_.subdomain;
#else
    return false;
#endif
  }
  bool chooseGeometry(yade::Interaction& contact, const yade::Body& body1,
                      const yade::Body& body2) const;
  bool updateGeometryOf(const Contact& contact, const BodyRow& one, const BodyRow& two,
                        long& fastGeometries) const;
  void updateProperties(const Contact& contact, const yade::Body& body1, const yade::Body& body2,
                        bool wasReal) const;
  void chooseLaw(yade::Interaction& contact) const;
  std::optional<ContactForce> applyLaw(const Contact& contact, const BodyRow& one,
                                       const BodyRow& two) const;

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
