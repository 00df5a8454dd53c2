// Bullet's btDbvtBroadphase: dynamic trees and a hash of pairs, in single precision.
#ifdef YADEFRAG_BULLET
#include <BulletCollision/BroadphaseCollision/btDbvtBroadphase.h>
#include <memory>

#include "benchmark/rivals/rival.hpp"

namespace yadefrag {
namespace {

class Bullet final : public Rival {
 public:
  ~Bullet() override {
    for (btBroadphaseProxy* proxy : proxies_) broadphase_.destroyProxy(proxy, nullptr);
  }
  void build(std::span<const Box> boxes) override {
    boxes_ = boxes;
    slots_.resize(boxes.size());
    for (std::size_t i = 0; i < boxes.size(); ++i) {
      const auto [low, high] = cornersOf(boxes[i]);
      slots_[i] = i;
      proxies_.push_back(broadphase_.createProxy(low, high, 0, &slots_[i], 1, 1, nullptr));
    }
  }
  void update(std::span<const BoxId> changed) override {
    for (const BoxId id : changed) {
      const auto [low, high] = cornersOf(boxes_[id.value]);
      broadphase_.setAabb(proxies_[id.value], low, high, nullptr);
    }
  }
  void findPairs(std::vector<BoxPair>& pairs) override {
    broadphase_.calculateOverlappingPairs(nullptr);
    auto& found = broadphase_.getOverlappingPairCache()->getOverlappingPairArray();
    for (int i = 0; i < found.size(); ++i) {
      const BoxId a = slotOf(found[i].m_pProxy0), b = slotOf(found[i].m_pProxy1);
      if (overlaps(boxes_[a.value], boxes_[b.value])) pairs.push_back(orderedPair(a, b));
    }
  }

 private:
  static BoxId slotOf(const btBroadphaseProxy* proxy) {
    return BoxId(*static_cast<const std::size_t*>(proxy->m_clientObject));
  }
  static std::pair<btVector3, btVector3> cornersOf(const Box& box) {
    const FloatBox f(box);
    return {{f.min[0], f.min[1], f.min[2]}, {f.max[0], f.max[1], f.max[2]}};
  }

  btDbvtBroadphase broadphase_;
  std::span<const Box> boxes_;
  std::vector<std::size_t> slots_;  // to which the proxies point
  std::vector<btBroadphaseProxy*> proxies_;
};

}  // namespace

std::unique_ptr<Rival> makeBullet() { return std::make_unique<Bullet>(); }

}  // namespace yadefrag
#endif
