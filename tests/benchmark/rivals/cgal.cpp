// CGAL's box_self_intersection_d (streamed segment trees; Zomorodian and Edelsbrunner).
#include <CGAL/Box_intersection_d/Box_with_handle_d.h>
#include <CGAL/box_intersection_d.h>
#include <memory>

#include "benchmark/rivals/rival.hpp"

namespace yadefrag {
namespace {

template <int Dim>
class Cgal final : public Rival {
 public:
  void build(std::span<const Box> boxes) override {
    boxes_ = boxes;
    update({});
  }
  /// It keeps nothing from one time to the next: its boxes are made anew.
  void update(std::span<const BoxId> /*changed*/) override {
    items_.clear();
    for (const Box& box : boxes_) {
      Box corners = box;  // it takes no constants
      items_.emplace_back(corners.min.data(), corners.max.data(), &box);
    }
    pointers_.clear();
    for (Item& item : items_) pointers_.push_back(&item);
  }
  void findPairs(std::vector<BoxPair>& pairs) override {
    const auto slot = [&](const Item* item) {
      return BoxId(static_cast<std::size_t>(item->handle() - boxes_.data()));
    };
    CGAL::box_self_intersection_d(
        pointers_.begin(), pointers_.end(),
        [&](const Item* a, const Item* b) { pairs.push_back(orderedPair(slot(a), slot(b))); });
  }

 private:
  using Item = CGAL::Box_intersection_d::Box_with_handle_d<double, Dim, const Box*>;
  std::span<const Box> boxes_;
  std::vector<Item> items_;
  std::vector<Item*> pointers_;
};

}  // namespace

std::unique_ptr<Rival> makeCgal(int dimensions) {
  if (dimensions == 2) return std::make_unique<Cgal<2>>();
  return std::make_unique<Cgal<3>>();
}

}  // namespace yadefrag
