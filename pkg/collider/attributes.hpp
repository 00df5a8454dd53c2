#pragma once
// The colliders' attributes as Python sees them.

#include <boost/mpl/vector.hpp>

#include "collider/search_collider.hpp"

namespace yadefrag {

constexpr auto SearchCollider::attributes() {
  using C = SearchCollider;
  using yade::Attr::noSave;
  using yade::Attr::readonly;
  return std::tuple(
      attribute("verletDist", &C::verletDist,
                "Longest length (m) by which a bound is enlarged, so that not every step needs a "
                "search; 0: search at every step; negative: that many times the smallest sphere's "
                "radius, set at the first search that sees a sphere. Paper section 4.1."),
      attribute("minSweepDistFactor", &C::minSweepDistFactor,
                "Shortest enlargement of a bound, as a share of verletDist."),
      attribute("targetInterv", &C::targetInterv,
                "Steps for which a bound should hold at its body's present speed; 0 or less: every "
                "bound is enlarged by verletDist. See adaptInterval."),
      attribute(
          "adaptInterval", &C::adaptInterval,
          "Let the interval leave targetInterv for one that balances searches against potential "
          "interactions, by counts (never by times: runs stay reproducible); False: keep it."),
      attribute("interval", &C::interval, "Steps for which bounds are made now.", readonly),
      attribute("trueHalo", &C::trueHalo,
                "Keep two spheres apart whose boxes overlap while they themselves cannot touch "
                "before the next search; False: potential interactions as from boxes alone."),
      attribute(
          "allowBiggerThanPeriod", &C::allowBiggerThanPeriod,
          "In a periodic scene, let bodies longer than half the cell overlap everything along "
          "that axis instead of raising RuntimeError."),
      attribute("overlapTolerance", &C::overlapTolerance,
                "Tolerance of overlap in a periodic scene, in cell sizes."),
      attribute("doSort", &C::doSort, "At the next search, forget all and begin from nothing."),
      attribute("numAction", &C::numAction, "Number of searches so far."),
      attribute("numReinit", &C::numReinit, "Number of searches that began from nothing.",
                readonly),
      attribute("fastestBodyMaxDist", &C::fastestBodyMaxDist,
                "The integrator's record of displacement: at 1 or more a search is due."),
      attribute("countComparisons", &C::countComparisons,
                "Count comparisons as the paper does (section 6); costs nothing when off."),
      attribute("comparisons", &C::comparisons, "Comparisons of the last search.", readonly),
      attribute("comparisonsTotal", &C::comparisonsTotal, "Comparisons of all searches.", readonly),
      attribute("searched", &C::searched,
                "Bodies that the last search gave new bounds and looked up neighbours for; all "
                "others kept theirs.",
                readonly),
      attribute("searchedTotal", &C::searchedTotal, "The same, of all searches.", readonly),
      attribute("sortAxis", &C::sortAxis, "Accepted for InsertionSortCollider; no effect."),
      attribute("sortThenCollide", &C::sortThenCollide,
                "Accepted for InsertionSortCollider; no effect."),
      attribute("updatingDispFactor", &C::updatingDispFactor,
                "Accepted for InsertionSortCollider; no effect: every bound is updated."),
      attribute("keepListsShort", &C::keepListsShort,
                "Accepted for InsertionSortCollider; no effect: erased bodies cost nothing."),
      attribute("smartInsertErase", &C::smartInsertErase,
                "Accepted for InsertionSortCollider; no effect."));
}

template <class PyClass>
void SearchCollider::pyExtra(PyClass& pyClass) {
  using Self = typename PyClass::wrapped_type;
  namespace py = yade::py;
  const auto getter = [](auto read) {
    using Value = decltype(read(std::declval<Self&>()));
    return py::make_function(read, py::default_call_policies(), boost::mpl::vector<Value, Self&>());
  };
  pyClass.def("isActivated", getter([](Self& self) { return self.isActivated(); }),
              "True if a search is due at the next step.");
  pyClass.add_property("strideActive", getter([](Self& self) { return self.strideActive(); }),
                       "True if steps without a search are possible.");
  pyClass.add_property("periodic", getter([](Self& self) { return self.periodic(); }),
                       "True if the last search was in a periodic cell.");
  pyClass.def(
      "entryPairs", getter([](Self& self) {
        yade::py::list pairs;
        for (const BoxPair& pair : self.entryPairs())
          pairs.append(yade::py::make_tuple(pair.first.value, pair.second.value));
        return pairs;
      }),
      "Pairs (id1, id2) of SurfaceSegment bodies whose bounds overlapped at the last search; "
      "they never become interactions.");
  pyClass.add_property(
      "newton", getter([](Self& self) { return self.newton; }),
      py::make_function(
          [](Self& self, const yade::shared_ptr<yade::NewtonIntegrator>& newton) {
            self.newton = newton;
          },
          py::default_call_policies(),
          boost::mpl::vector<void, Self&, const yade::shared_ptr<yade::NewtonIntegrator>&>()),
      "The integrator that calls for searches; found among O.engines at every step.");
}

}  // namespace yadefrag
