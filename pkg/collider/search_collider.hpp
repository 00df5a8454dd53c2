#pragma once
// Common base of the three colliders: the interface between YADE and a contact search.

#include <fmt/core.h>

#include <cstddef>
#include <limits>
#include <memory>
#include <optional>
#include <vector>

#include "collider/body_boxes.hpp"
#include "collider/interaction_update.hpp"
#include "collider/sphere_reach.hpp"
#include "collider/sweep_rule.hpp"
#include "core/errors.hpp"
#include "core/parallel.hpp"
#include "search/incremental_search.hpp"
#include "search/periodic.hpp"
#include "yade/attribute.hpp"
#include "yade/yade.hpp"

namespace yadefrag {

/// YADE's integrator checks the positions if it moves every body. Otherwise (no integrator, a dead
/// one, one with a mask) they are checked here. Always checked here: rotating bodies, a deforming
/// cell, and nodes without a bound that grid connections and PFacets follow; the integrator does
/// not check these.
class MotionWatch {
 public:
  /// Starts the check for bounds that were just updated. `cellSpan`: largest distance of two
  /// neighbours in cells, per axis.
  void start(const yade::Scene& scene, const BodyBoxes& boxes, double cellSlack,
             const yade::Vector3r& cellSpan);

  [[nodiscard]] bool boundsBroken(const yade::Scene& scene) const;

  /// The integrator that moves the scene's bodies; null if there is none or it is dead.
  static yade::shared_ptr<yade::NewtonIntegrator> findIntegrator(const yade::Scene& scene);

  /// Displacement record of the integrator: 0 if it has moved no body, below 1 within bounds or if
  /// yade.mpy has searched since, otherwise outside.
  static double fastestBody(const yade::Scene& scene, const yade::NewtonIntegrator& newton);

 private:
  [[nodiscard]] bool cellMoved(const yade::Scene& scene) const;
  [[nodiscard]] bool someTurnedOut(const yade::Scene& scene) const;
  static bool someMovedOut(const yade::Scene& scene);
  [[nodiscard]] bool someNodeMovedOut(const yade::Scene& scene) const;

  struct Node {
    yade::Body::id_t id;
    yade::Vector3r position;
  };
  std::vector<Node> nodes_;
  double nodeSweep_ = 0;  // m
  std::vector<Turning> turning_;
  bool isSplit_ = false;
  double cellSlack_ = 0;
  yade::Vector3r cellSpan_ = yade::Vector3r::Zero();
  yade::Matrix3r cellBefore_ = yade::Matrix3r::Zero();
};

/// Bytes that this process can still allocate: the machine's free memory, within the limits of the
/// address space and of the control group.
double freeMemory();

/// Caches the free memory while the size of the scene is about constant: reading it takes as long
/// as a search among a thousand bodies.
class MemoryForPairs {
 public:
  /// Number of pairs that fit, including the present interactions.
  std::size_t most(std::size_t bodies, std::size_t interactions);

  /// Free memory (bytes) when it was last read.
  [[nodiscard]] double free() const { return free_; }

 private:
  static constexpr int kSearchesPerLookUp = 100;
  double free_ = 0;
  std::size_t interactions_ = 0, bodies_ = 0;  // when it was last read
  int searches_ = kSearchesPerLookUp;          // searches since then
};

/// Replaces YADE's InsertionSortCollider. Attributes with the same name have the same meaning;
/// those that concern its sorting only are accepted and have no effect.
class SearchCollider : public yade::Collider {
 public:
  explicit SearchCollider(SearchMethod method) : method_(method) {}

  void action() override;
  bool isActivated() override;
  void invalidatePersistentData() override;
  /// A body was moved in memory.
  void bodyMoved(yade::Body::id_t id, const yade::Body* before, const yade::Body* now) {
    boxes_.replace(id, before, now);
  }
  yade::vector<yade::Body::id_t> probeBoundingVolume(const yade::Bound& bound) override;
  void pySetAttr(const yade::string& key, const yade::py::object& value) override;
  yade::py::dict pyDict() const override;

  int sortAxis = 0;
  bool allowBiggerThanPeriod = false;
  bool sortThenCollide = false;
  int targetInterv = 10;
  double overlapTolerance = 1e-7;
  double updatingDispFactor = -1;
  double verletDist = -.5;
  double minSweepDistFactor = .1;
  double fastestBodyMaxDist = 0;
  int numReinit = 0;
  int numAction = 0;
  bool doSort = false;
  bool keepListsShort = false;
  bool smartInsertErase = false;
  bool trueHalo = true;
  bool adaptInterval = true;
  double interval = 0;  // steps; 0: targetInterv
  bool countComparisons = false;
  long comparisons = 0;
  long comparisonsTotal = 0;
  long searched = 0;
  long searchedTotal = 0;
  yade::shared_ptr<yade::NewtonIntegrator> newton;

  /// Pairs of surface segments that may touch each other and whose bounds overlapped at the last
  /// search, by body id; found anew by each call. They are not interactions.
  [[nodiscard]] std::vector<BoxPair> entryPairs();
  [[nodiscard]] bool strideActive() const { return strideActive_; }
  [[nodiscard]] bool periodic() const { return periodic_; }

  static Attributes attributes();
  static void pyExtra(const yade::py::object& pyClass);

 private:
  void searchAll(int threads);
  bool searchChanged(int threads);
  [[nodiscard]] bool mayKeep() const;
  [[nodiscard]] double remainingWork() const;
  [[nodiscard]] bool someErased() const;
  [[nodiscard]] bool isStillNear(yade::Body::id_t id1, yade::Body::id_t id2) const;
  void chooseVerletDist();
  void chooseInterval();
  void countWork(double checked, double searchedNow, double halves);
  SweepRule chooseSweeps();
  void startSearchIfNeeded();
  void updateSearch(int threads);
  template <class Find>
  void findPairs(Find find);
  void removeSegmentPairs();
  template <class Bodies>
  double keepNear(int threads, Bodies searchedOf);
  bool isNear(const BoxPair& pair, const SphereReach& reach, Nearness& out) const;
  [[nodiscard]] bool ballsFit(const BoxPair& pair) const;
  [[nodiscard]] yade::Vector3i nearestImage(const yade::Vector3r& a, const yade::Vector3r& b) const;
  [[nodiscard]] yade::Vector3r cellSpan() const;
  void sceneIsSearched();
  [[nodiscard]] bool bodiesCame() const;
  [[nodiscard]] double cellSlack() const;

  SearchMethod method_;
  std::unique_ptr<IncrementalSearch> search_;
  bool searchCounts_ = false;
  /// Settings with which the stored interactions were found.
  struct Choices {
    bool trueHalo;
    yade::mask_t avoided;
    int subdomain;
    friend bool operator==(const Choices&, const Choices&) = default;
  };
  [[nodiscard]] Choices choices() const {
    return {trueHalo, avoidSelfInteractionMask, subdomain()};
  }
  /// Number of this process's part of the scene; 0 in a YADE without MPI.
  [[nodiscard]] int subdomain() const {
#ifdef YADE_MPI
    return scene->subdomain;
#else
    return 0;
#endif
  }
  /// False for two bodies that YADE keeps apart: masks, clumps, parts of other processes.
  [[nodiscard]] bool mayMeet(const yade::Body* a, const yade::Body* b) {
#ifdef YADE_MPI
    return mayCollide(a, b, scene->subdomain);
#else
    return mayCollide(a, b);
#endif
  }
  std::optional<Choices> keptWith_;  // no value: all bodies must be searched
  BodyBoxes boxes_;
  PeriodicImages images_;
  std::optional<Lattice> lattice_;  // lattice of a periodic cell
  MemoryForPairs memory_;
  MotionWatch watch_;
  InteractionUpdate interactions_;
  Neighbours near_;                   // before keepNear: pairs whose boxes overlap
  Interval counts_;                   // counts since the interval was chosen
  bool quickCheck_ = false;           // this search is due only because bodies were added
  std::size_t searchedSinceAll_ = 0;  // bodies searched since the last full search
  long lastCheck_ = -1;               // step at which all bodies were checked
  long lastIter_ = -1;                // step of the last search
  bool sweepsEnded_ = false;          // this search is due because a body left its bound
  double slack_ = 0;                  // m, margin for the cell's deformation in every box
  std::size_t numBodies_ = 0;         // at the last search
  bool periodic_ = false;
  bool strideActive_ = false;
  bool onlySegments_ = false;  // there are no bodies that segments could meet
};

/// An interaction takes far more memory than a pair: too many pairs are refused before interactions
/// are created.
template <class Find>
void SearchCollider::findPairs(Find find) {
  const std::size_t bodies = scene->bodies->body.size();
  const std::size_t most = memory_.most(bodies, scene->interactions->size());
  near_.pairs.clear();
  search_->setMostPairs(most);
  try {
    find();
  } catch (const TooManyPairs&) {
    throw RunError(fmt::format(
        "Of {} bodies more than {} pairs have overlapping bounds; their interactions do not fit "
        "into the {:g} GB of free memory. Many bodies overlap, or they or verletDist are too large "
        "for the scene or its periodic cell.",
        bodies, most, memory_.free() / 1e9));
  }
}

/// Removes the pairs that are not near, in place. Returns the number of neighbours of searched
/// bodies that are near only because sweeps are not half as long; `searchedOf(pair)`: how many of
/// the two bodies were searched.
template <class Bodies>
double SearchCollider::keepNear(int threads, Bodies searchedOf) {
  const SphereReach reach(boxes_.balls(), 2 * slack_);
  std::vector<BoxPair>& pairs = near_.pairs;
  near_.cellDist.clear();
  struct Kept {
    std::size_t begin = 0, end = 0, halves = 0;
  };
  std::vector<Kept> kept(static_cast<std::size_t>(threads));
  const auto work = [&](std::size_t begin, std::size_t end, int part) {
    Kept mine{begin, begin, 0};
    constexpr std::size_t ahead = 12;  // the balls are in the order of the bodies' ids: prefetch
    for (std::size_t i = begin; i < end; ++i) {
      if (i + ahead < end) reach.prefetch(pairs[i + ahead]);
      Nearness how;
      if (!isNear(pairs[i], reach, how)) continue;
      if (!how.byHalf) mine.halves += static_cast<std::size_t>(searchedOf(pairs[i]));
      pairs[mine.end++] = pairs[i];
      if (scene->isPeriodic) near_.cellDist.push_back(how.cellDist);
    }
    kept[static_cast<std::size_t>(part)] = mine;
  };
  // In a periodic cell one part only, which fills one list of shifts.
  forEachPart(pairs.size(), scene->isPeriodic ? 1 : threads, work);
  auto end = pairs.begin();
  std::size_t halves = 0;
  for (const Kept& part : kept) {
    const auto from = pairs.begin() + static_cast<std::ptrdiff_t>(part.begin);
    const auto to = pairs.begin() + static_cast<std::ptrdiff_t>(part.end);
    end = end == from ? to : std::move(from, to, end);
    halves += part.halves;
  }
  pairs.erase(end, pairs.end());
  return static_cast<double>(halves);
}

}  // namespace yadefrag
