#include "benchmark/rivals/rival.hpp"

#include <cmath>
#include <limits>

namespace yadefrag {

const std::vector<RivalName>& rivalNames() {
  static const std::vector<RivalName> names = {
      {"Lebesgue", 0, true},     {"Lebesgue, moved boxes given", 0, true},
      {"LinearCode", 0, true},   {"SweptRows", 0, true},
      {"Hierarchy", 0, true},    {"LinearBvh", 0, true},
      {"cell list", 0, false},   {"CGAL", 0, true},
      {"Boost R-tree", 0, true},
#ifdef YADEFRAG_BULLET
      {"Bullet", 0, true},
#endif
#ifdef YADEFRAG_BOX2D
      {"Box2D", 2, true},
#endif
  };
  return names;
}

std::unique_ptr<Rival> makeRival(const std::string& name, int dimensions, int threads) {
  if (name == "LinearBvh") return makeBvh(threads);
  if (name == "cell list") return makeCells(dimensions);
  if (name == "CGAL") return makeCgal(dimensions);
  if (name == "Boost R-tree") return makeBoost(dimensions);
#ifdef YADEFRAG_BULLET
  if (name == "Bullet") return makeBullet();
#endif
#ifdef YADEFRAG_BOX2D
  if (name == "Box2D") return makeBox2d();
#endif
  return makeOwn(name, threads);
}

FloatBox::FloatBox(const Box& box) {
  constexpr float kInfinity = std::numeric_limits<float>::infinity();
  for (int axis = 0; axis < 3; ++axis) {
    min[axis] = std::nextafter(static_cast<float>(box.min[axis]), -kInfinity);
    max[axis] = std::nextafter(static_cast<float>(box.max[axis]), kInfinity);
  }
}

}  // namespace yadefrag
