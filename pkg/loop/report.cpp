// What a loop computes itself, in words.

#include <boost/python.hpp>

#include <map>
#include <mutex>
#include <string>
#include <tuple>
#include <typeinfo>

#include "abi/helpers.hpp"
#include "loop/curve_loop.hpp"
#include "loop/known_laws.hpp"

namespace yadefrag {

namespace {

// What all contacts of a kind have in common.
using Kind =
    std::tuple<std::string, std::string, const yade::IGeomFunctor*, const yade::LawFunctor*>;

std::map<Kind, long> kindsOf(const yade::Scene& scene) {
  std::map<Kind, long> kinds;
  const auto& bodies = *scene.bodies;
  const std::lock_guard lock(scene.interactions->drawloopmutex);
  for (const auto& contact : *scene.interactions) {
    const auto& cache = contact->functorCache;
    if (!contact->isReal() || !cache.geom || !cache.constLaw) continue;
    const auto shapeOf = [&](yade::Body::id_t id) {
      const yade::Body* const body = bodyAt(bodies.body, id);
      return body && body->shape ? body->shape->getClassName() : std::string("nothing");
    };
    ++kinds[{shapeOf(contact->id1), shapeOf(contact->id2), cache.geom.get(), cache.constLaw.get()}];
  }
  return kinds;
}

// Why YADE's functor computes the forces.
std::string reasonOf(const yade::LawFunctor& functor, const yade::Scene& scene) {
  std::string reason = "which the loop does not know";
  forEachLaw([&]<class Law>() {
    if (typeid(functor) != typeid(typename Law::Functor)) return;
    const char* const given =
        Law::reasonForYade(static_cast<const typename Law::Functor&>(functor), scene);
    reason = given ? std::string("since ") + given : "since the loop computes one law of a scene";
  });
  return reason;
}

}  // namespace

std::string ContactLoop::report() const {
  const yade::Scene& here = *yade::Omega::instance().getScene();
  if (loopOnSortedInteractions) {
    return "All contacts: by YADE's InteractionLoop, since loopOnSortedInteractions is set.";
  }
  const auto* const spheres = exactly<yade::Ig2_Sphere_Sphere_ScGeom>(geomDispatcher->functors);
  const yade::LawFunctor* known = nullptr;
  withLaw(*this, here, [&]<class Law>(const typename Law::Functor* functor) { known = functor; });
  std::map<std::string, long> counts;  // in the order of their texts
  for (const auto& [kind, count] : kindsOf(here)) {
    const auto& [shape1, shape2, geometry, law] = kind;
    std::string what = shape1;
    what += " and ", what += shape2;
    what += geometry == spheres ? ": geometry by the loop" : ": geometry by YADE's ";
    if (geometry != spheres) what += geometry->getClassName();
    what += law == known ? ", force by the loop, as " : ", force by YADE's ";
    what += law->getClassName();
    if (law != known) what += ", ", what += reasonOf(*law, here);
    counts[what] += count;
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
