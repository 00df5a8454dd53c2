#pragma once
// Properties of a shape, besides its bound, that a collider needs: whether it moves rigidly with
// its body.

#include <algorithm>
#include <array>
#include <atomic>
#include <cstring>
#include <string>
#include <string_view>
#include <typeinfo>
#include <vector>

#include "abi/yade.hpp"
#include "entries/surface_segment.hpp"

namespace yadefrag {

enum class ShapeKind : signed char {
  kUnknown,
  kSphere,   ///< exactly YADE's Sphere: rotation does not change its bound
  kRigid,    ///< its points move only with its own body's position and orientation
  kSegment,  ///< SurfaceSegment: FESolver moves it, and requests searches
  kFollower  ///< anything else: grid connections and facets, chained cylinders, other plugins'
             ///< shapes
};

/// Tests whether objects are exactly of one class, `Exact`. YADE's classes are declared in several
/// libraries, so that `typeid` compares their names. An object with the table of virtual functions
/// of one that has passed the test passes without that.
template <class Base, class Exact>
class IsExactly {
 public:
  bool operator()(const Base& object) const {
    const void* table = nullptr;
    std::memcpy(&table, static_cast<const void*>(&object), sizeof table);
    if (table == known_.load(std::memory_order_relaxed)) return true;
    if (typeid(object) != typeid(Exact)) return false;
    known_.store(table, std::memory_order_relaxed);
    return true;
  }

 private:
  mutable std::atomic<const void*> known_ = nullptr;
};

/// Caches the kind by class index, which is cheaper to read than the class name.
class ShapeKinds {
 public:
  ShapeKind of(const yade::Shape& shape) {
    const auto index = static_cast<std::size_t>(shape.getClassIndex());
    if (index >= kinds_.size()) kinds_.resize(index + 1, ShapeKind::kUnknown);
    if (kinds_[index] == ShapeKind::kUnknown) kinds_[index] = find(shape);
    return kinds_[index];
  }

 private:
  static ShapeKind find(const yade::Shape& shape) {
    static constexpr std::array<std::string_view, 10> rigid = {
        "Facet",    "Box",      "Wall",     "Polyhedra",      "Tetra",
        "GridNode", "LevelSet", "Cylinder", "PotentialBlock", "PotentialParticle"};
    const std::string name = shape.getClassName();
    if (name == "Sphere") return ShapeKind::kSphere;
    if (name == SurfaceSegment::kName) return ShapeKind::kSegment;
    const bool isRigid = std::find(rigid.begin(), rigid.end(), name) != rigid.end();
    return isRigid ? ShapeKind::kRigid : ShapeKind::kFollower;
  }
  std::vector<ShapeKind> kinds_;
};

}  // namespace yadefrag
