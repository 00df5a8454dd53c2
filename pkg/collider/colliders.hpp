#pragma once
// The three colliders, one for each search.

#include "collider/search_collider.hpp"
#include "yade/published.hpp"

namespace yadefrag {

class LebesgueCollider final : public Published<LebesgueCollider, SearchCollider, yade::Collider> {
 public:
  static constexpr const char* kName = "LebesgueCollider";
  static constexpr const char* kDoc =
      "Contact search by position codes on the Lebesgue (Morton) curve, for any body with an Aabb, "
      "in place of InsertionSortCollider: the same contacts, faster, without tuning. Diekmann, "
      "Hungershoefer, Lux, Taenzer, Wierum, Efficient contact search for finite element analysis, "
      "ECCOMAS 2000, section 4. Raises RuntimeError naming the body if a position is not finite or "
      "a bound is inverted; the scene is then unchanged.";
  LebesgueCollider() : Published(SearchMethod::kLebesgue) {}
};

class LinearCodeCollider final
    : public Published<LinearCodeCollider, SearchCollider, yade::Collider> {
 public:
  static constexpr const char* kName = "LinearCodeCollider";
  static constexpr const char* kDoc =
      "As LebesgueCollider, with position boxes numbered row by row (LPC: Oldenburg and Nilsson, "
      "Int. J. Numer. Meth. Eng. 37, 1994): the paper's first rival, to compare with.";
  LinearCodeCollider() : Published(SearchMethod::kLinearCode) {}
};

class HierarchyCollider final
    : public Published<HierarchyCollider, SearchCollider, yade::Collider> {
 public:
  static constexpr const char* kName = "HierarchyCollider";
  static constexpr const char* kDoc =
      "As LebesgueCollider, with a tree of boxes (HO: Zhong and Nilsson, Comp. Struct. 33, 1989): "
      "the paper's second rival, to compare with.";
  HierarchyCollider() : Published(SearchMethod::kHierarchy) {}
};

}  // namespace yadefrag
