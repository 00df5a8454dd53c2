// What a loop computes itself, in words.

#include <functional>
#include <map>
#include <mutex>
#include <string>
#include <typeinfo>

#include "loop/curve_loop.hpp"
#include "loop/known_laws.hpp"
#include "yade/helpers.hpp"

namespace yadefrag {

namespace {

std::string shapeOf(const yade::Scene& scene, yade::Body::id_t id) {
  const yade::Body* const body = bodyAt(scene.bodies->body, id);
  return body && body->shape ? body->shape->getClassName() : "no shape";
}

// Why YADE's functor computes the forces.
std::string reasonOf(const yade::LawFunctor& functor, const yade::Scene& scene) {
  std::string reason = ", which the loop does not know";
  forEachLaw([&]<class Law>() {
    if (typeid(functor) != typeid(typename Law::Functor)) return;
    const auto* const given =
        Law::reasonForYade(static_cast<const typename Law::Functor&>(functor), scene);
    reason = ", since ";
    reason += given ? given : "the loop computes one law of a scene";
  });
  return reason;
}

}  // namespace

std::string ContactLoop::report() const {
  if (loopOnSortedInteractions)
    return "All contacts: by YADE's InteractionLoop, since loopOnSortedInteractions is set.";
  const yade::Scene& here = *yade::Omega::instance().getScene();
  const yade::Ig2_Sphere_Sphere_ScGeom* spheres = nullptr;
  std::optional<ShapeContacts> shapes;
  const yade::LawFunctor* known = nullptr;
  std::function<const char*(const yade::IPhys&)> exception;
  withLaw(*this, here, [&]<class Law>(const typename Law::Functor* functor) {
    spheres = exactly<typename Law::Geometry>(geomDispatcher->functors);
    shapes.emplace(*geomDispatcher, kUsesRotations<Law>);
    known = functor;
    if constexpr (kHasExceptions<Law>) {
      exception = [law = Law(*functor, here)](const yade::IPhys& phys) {
        return law.reasonForYade(static_cast<const typename Law::Phys&>(phys));
      };
    }
  });
  std::map<std::string, long> counts;
  const std::lock_guard lock(here.interactions->drawloopmutex);
  for (const auto& contact : *here.interactions) {
    const auto& geom = contact->functorCache.geom;
    const auto& law = contact->functorCache.constLaw;
    if (!contact->isReal() || !geom || !law) continue;
    std::string what = shapeOf(here, contact->id1);
    what += " and ", what += shapeOf(here, contact->id2);
    const bool isFast = geom.get() == spheres || shapes->know(geom.get());
    what += isFast ? ": geometry by the loop" : ": geometry by YADE's ";
    if (!isFast) what += geom->getClassName();
    const bool isKnown = law.get() == known;
    const char* const reason = isKnown && exception ? exception(*contact->phys) : nullptr;
    what += isKnown && !reason ? ", force by the loop, as " : ", force by YADE's ";
    what += law->getClassName();
    if (!isKnown) what += reasonOf(*law, here);
    if (reason) what += ", since ", what += reason;
    ++counts[what];
  }
  std::string text;
  for (const auto& [what, count] : counts) {
    if (!text.empty()) text += "\n";
    text += std::to_string(count), text += " of ", text += what, text += ".";
  }
  return text.empty() ? "No contact has been computed yet." : text;
}

void CurveLoop::pyExtra(LoopClass& loop) {
  loop.def(
      "report", +[](const CurveLoop& self) { return self.report(); },
      "A sentence for each kind of contact that the scene has: how many, and which part of it the "
      "loop computes itself, fast, or YADE's functors, and why.");
}

}  // namespace yadefrag
