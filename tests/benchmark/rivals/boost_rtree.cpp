// Boost's R-tree: packed where all boxes have moved, changed in place where few have.
#include <boost/geometry.hpp>
#include <boost/geometry/geometries/box.hpp>
#include <boost/geometry/geometries/point.hpp>
#include <boost/geometry/index/rtree.hpp>
#include <memory>

#include <iterator>

#include "benchmark/rivals/rival.hpp"

namespace yadefrag {
namespace {

namespace bg = boost::geometry;

template <int Dim>
class BoostTree final : public Rival {
 public:
  void build(std::span<const Box> boxes) override {
    boxes_ = boxes;
    pack();
  }
  void update(std::span<const BoxId> changed) override {
    if (changed.size() * 20 > boxes_.size()) return pack();
    for (const BoxId id : changed) {
      tree_.remove(values_[id.value]);
      values_[id.value] = valueOf(id.value);
      tree_.insert(values_[id.value]);
    }
  }
  void findPairs(std::vector<BoxPair>& pairs) override {
    std::vector<Value> found;
    for (const Value& value : values_) {
      found.clear();
      tree_.query(bg::index::intersects(value.first), std::back_inserter(found));
      for (const Value& other : found)
        if (value.second < other.second)
          pairs.push_back({BoxId(value.second), BoxId(other.second)});
    }
  }

 private:
  using Point = bg::model::point<double, Dim, bg::cs::cartesian>;
  using Value = std::pair<bg::model::box<Point>, std::uint32_t>;

  [[nodiscard]] Value valueOf(std::size_t i) const {
    const Box& b = boxes_[i];
    if constexpr (Dim == 2)
      return {{Point(b.min[0], b.min[1]), Point(b.max[0], b.max[1])},
              static_cast<std::uint32_t>(i)};
    else
      return {{Point(b.min[0], b.min[1], b.min[2]), Point(b.max[0], b.max[1], b.max[2])},
              static_cast<std::uint32_t>(i)};
  }
  void pack() {
    values_.clear();
    for (std::size_t i = 0; i < boxes_.size(); ++i) values_.push_back(valueOf(i));
    tree_ = Tree(values_.begin(), values_.end());
  }

  using Tree = bg::index::rtree<Value, bg::index::quadratic<16>>;
  std::span<const Box> boxes_;
  std::vector<Value> values_;
  Tree tree_;
};

}  // namespace

std::unique_ptr<Rival> makeBoost(int dimensions) {
  if (dimensions == 2) return std::make_unique<BoostTree<2>>();
  return std::make_unique<BoostTree<3>>();
}

}  // namespace yadefrag
