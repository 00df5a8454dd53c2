#include "loop/pair_step.hpp"

#include <cmath>
#include <stdexcept>
#include <string>

#include "loop/known_laws.hpp"
#include "yade/helpers.hpp"

namespace yadefrag {

namespace {

std::string bodiesOf(const yade::Interaction& contact) {
  return "the bodies " + std::to_string(contact.id1) + " and " + std::to_string(contact.id2);
}

}  // namespace

PairFunctors::PairFunctors(yade::InteractionLoop& loop, yade::Scene& scene,
                           const yade::Ig2_Sphere_Sphere_ScGeom* spheres,
                           const yade::IPhysFunctor* properties, const yade::LawFunctor* law)
    : loop_(loop),
      scene_(scene),
      spheres_(spheres),
      properties_(properties),
      law_(law),
      hasRotations_(spheres && typeid(*spheres) == typeid(yade::Ig2_Sphere_Sphere_ScGeom6D)),
      shapes_(*loop.geomDispatcher, hasRotations_) {
  for (const auto& callback : loop.callbacks) {
    callback->scene = &scene;
    if (const auto function = callback->stepInit()) {
      callbacks_.emplace_back(callback.get(), function);
    }
  }
  const long lastRun = scene.interactions->iterColliderLastRun;
  isAllKnown_ = spheres_ && properties_ && law_ && callbacks_.empty();
  removesUnseen_ = lastRun >= 0 && lastRun == scene.iter;
}

// YADE's InteractionLoop::action, for one interaction.
bool PairFunctors::update(const Contact& contact, const BodyRow& one, const BodyRow& two,
                          bool changesProperties, long& fastGeometries) const {
  if (removesUnseen_ && !contact->isReal() && contact->iterLastSeen < scene_.iter) return false;
  const auto id1 = contact->id1;
  const auto hasOtherShape = [&] {
    if (areSpheres(*contact)) return std::isnan(one.radius() + two.radius());
    return shapes_.know(contact->functorCache.geom.get()) && !isOfShape(*contact, two);
  };
  if (hasOtherShape()) {
    contact->reset();  // a script has changed it: the next step chooses a functor for it
    return false;
  }
  // A clump has no sphere of its own.
  if (!areSpheres(*contact)) {
    if (bodyOf(id1).isClump() || bodyOf(contact->id2).isClump()) return false;
    if (!chooseGeometry(*contact)) return false;
  }
  const bool isSwapped = contact->id1 != id1;
  const bool wasReal = contact->isReal();
  if (!updateGeometryOf(contact, isSwapped ? two : one, isSwapped ? one : two, fastGeometries)) {
    if (wasReal) contact->reset();
    return false;
  }
  updateProperties(contact, wasReal, changesProperties);
  return true;
}

void PairFunctors::callBack(const Contact& contact) const {
  if (!contact->isReal()) return;
  for (const auto& [callback, function] : callbacks_) function(callback, contact.get());
}

bool PairFunctors::isFarApart(const yade::Interaction& contact) const {
  if (contact.isReal()) return false;
  const auto& bodies = scene_.bodies->body;
  const yade::Body *const body1 = bodyAt(bodies, contact.id1), *const body2 =
                                                                   bodyAt(bodies, contact.id2);
  if (!BodyRows::hasMotion(body1) || !BodyRows::hasMotion(body2)) return false;
  if (!areSpheres(contact)) {
    if (!shapes_.know(contact.functorCache.geom.get())) return false;
    BodyRow sphere;
    BodyRows::read(*body2, sphere);
    return isFarShape(contact, sphere);
  }
  const auto placeOf = [](const yade::Body& body) {
    return loadThree(body.state->se3.position.data());
  };
  const auto radiusOf = [](const yade::Body& body) {
    return static_cast<const yade::Sphere&>(*body.shape).radius;
  };
  return areApart(placeOf(*body2) + shiftOf(contact).distance - placeOf(*body1), radiusOf(*body1),
                  radiusOf(*body2));
}

bool PairFunctors::isFarShape(const yade::Interaction& contact, const BodyRow& sphere) const {
  return isOfShape(contact, sphere) &&
         shapes_.areApart(contact.functorCache.geom.get(), bodyOf(contact.id1), sphere,
                          shiftOf(contact));
}

ImageShift PairFunctors::periodicShift(const yade::Interaction& contact) const {
  const yade::Vector3r distance = scene_.cell->intrShiftPos(contact.cellDist);
  const yade::Vector3r velocity =
      (*scene_.cell).*exposed(GradientTimesCell{}) * contact.cellDist.cast<double>();
  return {loadThree(distance.data()), loadThree(velocity.data())};
}

// False: no functor accepts the two shapes. The order of the bodies may be swapped.
bool PairFunctors::chooseGeometry(yade::Interaction& contact) const {
  const yade::Body &body1 = bodyOf(contact.id1), &body2 = bodyOf(contact.id2);
  if (!contact.functorCache.geomExists) return false;
  if (contact.functorCache.geom) return true;
  bool isSwapped = false;
  auto shape1 = body1.shape, shape2 = body2.shape;
  contact.functorCache.geom = loop_.geomDispatcher->getFunctor2D(shape1, shape2, isSwapped);
  contact.functorCache.geomExists = contact.functorCache.geom != nullptr;
  if (isSwapped) contact.swapOrder();
  return contact.functorCache.geomExists;
}

// False: they do not touch.
bool PairFunctors::updateGeometryOf(const Contact& contact, const BodyRow& one, const BodyRow& two,
                                    long& fastGeometries) const {
  const bool areOfSpheres = areSpheres(*contact);
  if (areOfSpheres || shapes_.know(contact->functorCache.geom.get())) {
    if (isFarApart(*contact, one, two)) return false;
    if (contact->geom && !hasRotations_) {
      ++fastGeometries;
      auto& geom = static_cast<yade::ScGeom&>(*contact->geom);
      areOfSpheres ? updateGeometry(geom, one, two, shiftOf(*contact))
                   : updateShape(*contact, geom, one, two, shiftOf(*contact));
      return true;
    }
  }
  yade::Vector3r shift = yade::Vector3r::Zero();
  if (scene_.isPeriodic) shift = scene_.cell->intrShiftPos(contact->cellDist);
  const yade::Body &body1 = bodyOf(contact->id1), &body2 = bodyOf(contact->id2);
  return contact->functorCache.geom->go(body1.shape, body2.shape, *body1.state, *body2.state, shift,
                                        false, contact);
}

void PairFunctors::updateProperties(const Contact& contact, bool wasReal,
                                    bool changesProperties) const {
  const yade::Body &body1 = bodyOf(contact->id1), &body2 = bodyOf(contact->id2);
  auto& functor = contact->functorCache.phys;
  if (!functor) {
    bool isSwapped = false;
    auto material1 = body1.material, material2 = body2.material;
    if (!material1 || !material2) {
      throw std::runtime_error("CurveLoop: of " + bodiesOf(*contact) + ", which touch, #" +
                               std::to_string(material1 ? contact->id2 : contact->id1) +
                               " has no material.");
    }
    functor = loop_.physDispatcher->getFunctor2D(material1, material2, isSwapped);
    if (!functor) {
      throw std::runtime_error("CurveLoop has no Ip2 functor for the materials " +
                               material1->getClassName() + " and " + material2->getClassName() +
                               " of " + bodiesOf(*contact) + ".");
    }
  }
  // The known functor does nothing for a contact that has its properties.
  if (functor.get() != properties_ || !contact->phys || changesProperties) {
    functor->go(body1.material, body2.material, contact);
  }
  if (!wasReal) contact->iterMadeReal = scene_.iter;
}

void PairFunctors::chooseLaw(yade::Interaction& contact) const {
  bool isSwapped = false;
  contact.functorCache.constLaw =
      loop_.lawDispatcher->getFunctor2D(contact.geom, contact.phys, isSwapped);
  if (!contact.functorCache.constLaw) {
    throw std::runtime_error("CurveLoop has no Law2 functor for the contact of " +
                             bodiesOf(contact) + ", with " + contact.geom->getClassName() +
                             " and " + contact.phys->getClassName() + ".");
  }
}

void PairFunctors::callLaw(yade::Interaction& contact) {
  if (!contact.functorCache.constLaw->go(contact.geom, contact.phys, &contact)) contact.reset();
}

}  // namespace yadefrag
