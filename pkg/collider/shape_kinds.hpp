#pragma once
// What a collider must know of a shape beyond its bound: does it move as one with its body?

#include <vector>

#include "abi/yade.hpp"

namespace yadefrag {

enum class ShapeKind : signed char {
  kUnknown,
  kSphere,   ///< exactly YADE's Sphere: turning does not change its bound
  kRigid,    ///< its points move only with its own body's position and orientation
  kSegment,  ///< SurfaceSegment: FESolver moves it, and says when a search is due
  kFollower  ///< anything else: grid connections and facets, chained cylinders, other plugins'
             ///< shapes
};

/// Remembers the kind by class index, which is cheaper to ask for than the name.
class ShapeKinds {
 public:
  ShapeKind of(const yade::Shape& shape) {
    const auto index = static_cast<std::size_t>(shape.getClassIndex());
    if (index >= kinds_.size()) kinds_.resize(index + 1, ShapeKind::kUnknown);
    if (kinds_[index] == ShapeKind::kUnknown) kinds_[index] = find(shape);
    return kinds_[index];
  }

 private:
  static ShapeKind find(const yade::Shape& shape);
  std::vector<ShapeKind> kinds_;
};

}  // namespace yadefrag
