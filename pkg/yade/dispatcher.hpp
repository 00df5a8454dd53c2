#pragma once
// The dispatchers: that which updates the bounds of bodies, and those for contacts; and the engines
// that have them.

#include <cstddef>
#include <list>
#include <optional>
#include <stdexcept>
#include <utility>

#include "yade/functor.hpp"

namespace yade {

class Dispatcher : public Engine {
 public:
  Dispatcher() = delete;
  ~Dispatcher() override;
};

template <class FunctorType>
class Dispatcher1D : public Dispatcher {
  alignas(8) unsigned char callTable_[48];  // YADE's second base class, without virtual functions

 public:
  Dispatcher1D() = delete;
};

// YADE's second base class of dispatchers by two classes: the functor for each pair of class
// indices, and whether its arguments are swapped.
template <class FunctorType, class First, class Second>
class DynLibDispatcher {
  vector<vector<shared_ptr<FunctorType>>> callBacks;
  vector<vector<int>> callBacksInfo;

 public:
  // The functor of the nearest base classes, or null; throws std::runtime_error for two that are
  // equally near. YADE stores what it has found; here nothing is changed.
  shared_ptr<FunctorType> getFunctor2D(shared_ptr<First>& first, shared_ptr<Second>& second,
                                       bool& swap) {
    const auto at = nearest(*first, *second);
    if (!at) return {};
    swap = callBacksInfo[at->first][at->second] != 0;
    return callBacks[at->first][at->second];
  }

 private:
  using Place = std::pair<std::size_t, std::size_t>;

  // Class index of a base class, 0: of the class itself; negative above the last one.
  template <class T>
  static int indexAbove(const T& object, int depth) {
    return depth == 0 ? object.getClassIndex() : object.getBaseClassIndex(depth);
  }

  std::optional<Place> nearest(const First& first, const Second& second) const {
    for (int distance = 0;; ++distance) {
      std::optional<Place> found;
      bool isBeyond = true;
      for (int depth = 0; depth <= distance; ++depth) {
        const auto place = filled(first, depth, second, distance - depth, isBeyond);
        if (!place) continue;
        if (found && functorAt(*found) != functorAt(*place)) {
          throw std::runtime_error("Ambiguous dispatch for " + first.getClassName() + " and " +
                                   second.getClassName() + ".");
        }
        found = place;
      }
      if (found || isBeyond) return found;
    }
  }

  // Place of the functor for two base classes, if there is one; isBeyond: false if they exist.
  std::optional<Place> filled(const First& first, int depth1, const Second& second, int depth2,
                              bool& isBeyond) const {
    // YADE's classes return −1 once above the last base, and must not be asked beyond that.
    for (int depth = 1; depth < depth1; ++depth)
      if (first.getBaseClassIndex(depth) < 0) return {};
    for (int depth = 1; depth < depth2; ++depth)
      if (second.getBaseClassIndex(depth) < 0) return {};
    const int index1 = indexAbove(first, depth1), index2 = indexAbove(second, depth2);
    if (index1 < 0 || index2 < 0) return {};
    isBeyond = false;
    const Place place(index1, index2);
    if (place.first >= callBacks.size() || place.second >= callBacks[place.first].size()) return {};
    return functorAt(place) ? std::optional(place) : std::nullopt;
  }

  const shared_ptr<FunctorType>& functorAt(const Place& place) const {
    return callBacks[place.first][place.second];
  }

  friend struct LayoutProbe;
};

template <class FunctorType, class First, class Second>
class Dispatcher2D : public Dispatcher, public DynLibDispatcher<FunctorType, First, Second> {
 public:
  Dispatcher2D() = delete;
};

class BoundDispatcher : public Dispatcher1D<BoundFunctor> {
 public:
  vector<shared_ptr<BoundFunctor>> functors;
  bool activated;
  Real sweepDist;
  Real minSweepDistFactor;
  Real updatingDispFactor;
  Real targetInterv;

  BoundDispatcher() = delete;
  ~BoundDispatcher() override;
  bool isActivated() override;
  void action() override;
  void processBody(const shared_ptr<Body>& body);
};

// The base of every collider.
class Collider : public GlobalEngine {
 public:
  shared_ptr<BoundDispatcher> boundDispatcher;
  mask_t avoidSelfInteractionMask;

  Collider();
  ~Collider() override;
  YADEFRAG_YADE_FUNCTIONS;
  void pyHandleCustomCtorArgs(py::tuple& args, py::dict& kw) override;
  virtual vector<Body::id_t> probeBoundingVolume(const Bound& bound);
  virtual void invalidatePersistentData();
  bool mayCollide(const Body* a, const Body* b, Body::id_t subdomain);
};

class IntrCallback : public Serializable {
 public:
  using FuncPtr = void (*)(IntrCallback*, Interaction*);
  Scene* scene;
  IntrCallback() = delete;
  ~IntrCallback() override;
  virtual FuncPtr stepInit();
};

class IGeomDispatcher : public Dispatcher2D<IGeomFunctor, Shape, Shape> {
  bool alreadyWarnedNoCollider;

 public:
  vector<shared_ptr<IGeomFunctor>> functors;
  IGeomDispatcher() = delete;
  ~IGeomDispatcher() override;

 private:
  friend struct LayoutProbe;
};

class IPhysDispatcher : public Dispatcher2D<IPhysFunctor, Material, Material> {
 public:
  vector<shared_ptr<IPhysFunctor>> functors;
  IPhysDispatcher() = delete;
  ~IPhysDispatcher() override;
};

class LawDispatcher : public Dispatcher2D<LawFunctor, IGeom, IPhys> {
 public:
  vector<shared_ptr<LawFunctor>> functors;
  LawDispatcher() = delete;
  ~LawDispatcher() override;
};

class InteractionLoop : public GlobalEngine {
  bool alreadyWarnedNoCollider;
  vector<std::list<std::pair<Body::id_t, Body::id_t>>> eraseAfterLoopIds;

 public:
  shared_ptr<IGeomDispatcher> geomDispatcher;
  shared_ptr<IPhysDispatcher> physDispatcher;
  shared_ptr<LawDispatcher> lawDispatcher;
  vector<shared_ptr<IntrCallback>> callbacks;
  bool loopOnSortedInteractions;
#if YADEFRAG_YADE >= 202601
  bool warnRoleIg2;
#endif

  InteractionLoop();
  ~InteractionLoop() override;
  YADEFRAG_YADE_FUNCTIONS;
  void pyHandleCustomCtorArgs(py::tuple& args, py::dict& kw) override;
  void action() override;

 private:
  friend struct LayoutProbe;
};

}  // namespace yade
