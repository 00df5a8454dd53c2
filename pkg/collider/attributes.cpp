// Colliders in Python: attributes, and what scripts ask them.

#include <boost/mpl/vector.hpp>

#include <algorithm>
#include <stdexcept>

#include "collider/search_collider.hpp"
#include "materials/surface_segment.hpp"
#include "search/contact_search.hpp"

namespace yadefrag {

using yade::Body;
using yade::Vector3r;

Attributes SearchCollider::attributes() {
  using C = SearchCollider;
  using yade::Attr::noSave;
  using yade::Attr::readonly;
  return attributeList(
      attribute("verletDist", &C::verletDist,
                "Longest enlargement (m) of a bound, so that not every step needs a "
                "search; 0: search at every step; negative: that multiple of the smallest sphere's "
                "radius, set at the first search with a sphere. Paper section 4.1."),
      attribute("minSweepDistFactor", &C::minSweepDistFactor,
                "Shortest enlargement of a bound, as a fraction of verletDist."),
      attribute("targetInterv", &C::targetInterv,
                "Steps for which a bound should hold at its body's present speed; 0 or less: every "
                "bound is enlarged by verletDist. See adaptInterval."),
      attribute("adaptInterval", &C::adaptInterval,
                "Adapt the interval, starting from targetInterv, to balance searches and potential "
                "interactions, by counts (never by times: runs are reproducible); False: constant "
                "interval."),
      attribute("interval", &C::interval, "Steps for which bounds are made at present.", readonly),
      attribute("trueHalo", &C::trueHalo,
                "Exclude pairs of spheres whose boxes overlap but that cannot touch "
                "before the next search; False: potential interactions from boxes only."),
      attribute(
          "allowBiggerThanPeriod", &C::allowBiggerThanPeriod,
          "In a periodic scene, let bodies longer than half the cell overlap all others along "
          "that axis instead of raising RuntimeError."),
      attribute("overlapTolerance", &C::overlapTolerance,
                "Tolerance of overlap in a periodic scene, in cell sizes."),
      attribute("doSort", &C::doSort, "Delete all data of the search; the next one starts anew."),
      attribute("numAction", &C::numAction, "Number of searches so far."),
      attribute("numReinit", &C::numReinit, "Number of searches that started anew.", readonly),
      attribute("fastestBodyMaxDist", &C::fastestBodyMaxDist,
                "The integrator's record of displacement: at 1 or more a search is due."),
      attribute("countComparisons", &C::countComparisons,
                "Count comparisons as the paper does (section 6); no cost if False."),
      attribute("comparisons", &C::comparisons, "Comparisons of the last search.", readonly),
      attribute("comparisonsTotal", &C::comparisonsTotal, "Comparisons of all searches.", readonly),
      attribute("searched", &C::searched,
                "Number of bodies with new bounds and new neighbours in the last search; all "
                "others kept theirs.",
                readonly),
      attribute("searchedTotal", &C::searchedTotal, "The same, for all searches.", readonly),
      attribute("sortAxis", &C::sortAxis, "Accepted for InsertionSortCollider; no effect."),
      attribute("sortThenCollide", &C::sortThenCollide,
                "Accepted for InsertionSortCollider; no effect."),
      attribute("updatingDispFactor", &C::updatingDispFactor,
                "Accepted for InsertionSortCollider; no effect: every bound is updated."),
      attribute("keepListsShort", &C::keepListsShort,
                "Accepted for InsertionSortCollider; no effect: erased bodies cause no cost."),
      attribute("smartInsertErase", &C::smartInsertErase,
                "Accepted for InsertionSortCollider; no effect."));
}

void SearchCollider::pyExtra(const yade::py::object& pyClass) {
  namespace py = yade::py;
  // Python knows the three classes, not their common base.
  const auto method = [](auto call) {
    using Value = decltype(call(std::declval<SearchCollider&>()));
    return py::make_function(
        [call](yade::Collider& self) { return call(dynamic_cast<SearchCollider&>(self)); },
        py::default_call_policies(), boost::mpl::vector<Value, yade::Collider&>());
  };
  const auto define = [&](const char* name, const py::object& attribute, const char* doc) {
    py::objects::add_to_namespace(pyClass, name, attribute, doc);
  };
  const py::object builtin = py::import("builtins").attr("property");
  const auto property = [&](const char* name, const py::object& get, const py::object& set,
                            const char* doc) {
    py::setattr(pyClass, name, builtin(get, set, py::object(), doc));
  };
  define("isActivated", method([](SearchCollider& self) { return self.isActivated(); }),
         "True if a search is due at the next step.");
  property("strideActive", method([](SearchCollider& self) { return self.strideActive(); }), {},
           "True if steps without a search are possible.");
  property("periodic", method([](SearchCollider& self) { return self.periodic(); }), {},
           "True if the last search was in a periodic cell.");
  define("entryPairs", method([](SearchCollider& self) {
           py::list pairs;
           for (const BoxPair& pair : self.entryPairs())
             pairs.append(py::make_tuple(pair.first.value, pair.second.value));
           return pairs;
         }),
         "Pairs (id1, id2) of SurfaceSegment bodies whose bounds overlapped at the last search. "
         "They never become interactions, and FESolver does not use them: it searches itself.");
  using Newton = yade::shared_ptr<yade::NewtonIntegrator>;
  property(
      "newton", method([](SearchCollider& self) { return self.newton; }),
      py::make_function(
          [](yade::Collider& self, const Newton& newton) {
            dynamic_cast<SearchCollider&>(self).newton = newton;
          },
          py::default_call_policies(), boost::mpl::vector<void, yade::Collider&, const Newton&>()),
      "The integrator that requests searches; found in O.engines at every step.");
}

std::vector<BoxPair> SearchCollider::entryPairs() {
  const std::vector<std::uint8_t>& isSegment = boxes_.isSegment();
  if (isSegment.empty()) return {};
  std::vector<Box> boxes(boxes_.boxes().begin(), boxes_.boxes().end());
  for (std::size_t id = 0; id < boxes.size(); ++id)
    if (id >= isSegment.size() || isSegment[id] == 0) boxes[id] = Box::absent();
  std::vector<BoxPair> pairs = overlappingPairs(boxes);
  const auto& bodies = scene->bodies->body;
  std::erase_if(pairs, [&](const BoxPair& pair) {
    const Body *first = bodies[pair.first.value].get(), *second = bodies[pair.second.value].get();
    if (!first || !second || !mayMeet(first, second)) return true;
    const auto& a = static_cast<const SurfaceSegment&>(*first->shape);
    const auto& b = static_cast<const SurfaceSegment&>(*second->shape);
    // Pieces created by scripts are one rigid body.
    return a.component == b.component && !(a.component >= 0 && a.selfContact);
  });
  return pairs;
}

/// Bodies whose present bounds, without sweeps, overlap `bound`.
yade::vector<Body::id_t> SearchCollider::probeBoundingVolume(const yade::Bound& bound) {
  if (periodic_)
    throw std::invalid_argument(getClassName() +
                                ".probeBoundingVolume: not possible in a periodic scene.");
  yade::vector<Body::id_t> found;
  if (!search_ || boxes_.boxes().empty()) return found;
  std::vector<BoxId> near;
  search_->findOverlaps(
      {{bound.min[0], bound.min[1], bound.min[2]}, {bound.max[0], bound.max[1], bound.max[2]}},
      near);
  for (const BoxId id : near) {
    const auto& bodies = scene->bodies->body;
    if (id.value >= bodies.size() || !bodies[id.value] || !bodies[id.value]->bound) continue;
    const Body& body = *bodies[id.value];
    const Vector3r sweep = Vector3r::Constant(body.bound->sweepLength);
    const Vector3r moved = body.state->se3.position - body.bound->refPos;
    const Vector3r low = body.bound->min + sweep + moved;
    const Vector3r high = body.bound->max - sweep + moved;
    if ((low.array() <= bound.max.array()).all() && (high.array() >= bound.min.array()).all())
      found.push_back(body.getId());
  }
  std::sort(found.begin(), found.end());
  return found;
}

void SearchCollider::pySetAttr(const yade::string& key, const yade::py::object& value) {
  if (key == "newton")
    newton = yade::py::extract<yade::shared_ptr<yade::NewtonIntegrator>>(value)();
  else
    Collider::pySetAttr(key, value);
}

yade::py::dict SearchCollider::pyDict() const {
  yade::py::dict result = Collider::pyDict();
  result["newton"] = newton;
  return result;
}

}  // namespace yadefrag
