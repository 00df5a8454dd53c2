// Box2D's b2DynamicTree: boxes with a margin, in the plane and in single precision.
#ifdef YADEFRAG_BOX2D
#include <box2d/b2_dynamic_tree.h>
#include <memory>

#include "benchmark/rivals/rival.hpp"

namespace yadefrag {
namespace {

class Box2d final : public Rival {
 public:
  void build(std::span<const Box> boxes) override {
    boxes_ = boxes;
    here_.assign(boxes.begin(), boxes.end());
    slots_.resize(boxes.size());
    for (std::size_t i = 0; i < boxes.size(); ++i) {
      slots_[i] = i;
      proxies_.push_back(tree_.CreateProxy(boxOf(boxes[i]), &slots_[i]));
    }
  }
  void update(std::span<const BoxId> changed) override {
    for (const BoxId id : changed) {
      const Box& was = here_[id.value];
      const Box& is = boxes_[id.value];
      const b2Vec2 way(static_cast<float>(is.min[0] - was.min[0]),
                       static_cast<float>(is.min[1] - was.min[1]));
      tree_.MoveProxy(proxies_[id.value], boxOf(is), way);
      here_[id.value] = is;
    }
  }
  void findPairs(std::vector<BoxPair>& pairs) override {
    pairs_ = &pairs;
    for (std::size_t i = 0; i < boxes_.size(); ++i) {
      asking_ = i;
      tree_.Query(this, boxOf(boxes_[i]));
    }
  }
  /// Called by Box2D for each box that is met.
  bool QueryCallback(std::int32_t proxy) {
    const std::size_t other = *static_cast<const std::size_t*>(tree_.GetUserData(proxy));
    if (asking_ < other && overlaps(boxes_[asking_], boxes_[other]))
      pairs_->push_back({BoxId(asking_), BoxId(other)});
    return true;
  }

 private:
  static b2AABB boxOf(const Box& box) {
    const FloatBox f(box);
    b2AABB result;
    result.lowerBound.Set(f.min[0], f.min[1]);
    result.upperBound.Set(f.max[0], f.max[1]);
    return result;
  }

  b2DynamicTree tree_;
  std::span<const Box> boxes_;
  std::vector<Box> here_;
  std::vector<std::size_t> slots_;  // to which the proxies point
  std::vector<std::int32_t> proxies_;
  std::vector<BoxPair>* pairs_ = nullptr;
  std::size_t asking_ = 0;
};

}  // namespace

std::unique_ptr<Rival> makeBox2d() { return std::make_unique<Box2d>(); }

}  // namespace yadefrag
#endif
