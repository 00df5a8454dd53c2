// A tree over position codes that is rebuilt for every update (LBVH, Karras 2012).
#include <algorithm>
#include <array>
#include <memory>
#include <numeric>

#include "benchmark/rivals/code_tree.hpp"
#include "benchmark/rivals/rival.hpp"
#include "core/parallel.hpp"

namespace yadefrag {
namespace {

class LinearBvh final : public Rival {
 public:
  explicit LinearBvh(int threads) : threads_(std::max(threads, 1)) {}
  void build(std::span<const Box> boxes) override {
    boxes_ = boxes;
    slots_.resize(boxes.size());
    std::iota(slots_.begin(), slots_.end(), 0);
    tree_.build(boxes_, slots_, threads_);
  }
  void update(std::span<const BoxId> /*changed*/) override {
    tree_.build(boxes_, slots_, threads_);
  }
  void findPairs(std::vector<BoxPair>& pairs) override {
    std::vector<std::vector<BoxPair>> found(static_cast<std::size_t>(threads_));
    const auto slots = tree_.slots();
    const int parts =
        forEachPart(slots.size(), threads_, [&](std::size_t begin, std::size_t end, int part) {
          std::vector<BoxPair>& out = found[static_cast<std::size_t>(part)];
          for (std::size_t i = begin; i < end; ++i)
            descend(tree_.boxes()[i], i + 1, [&](std::uint32_t other) {
              out.push_back(orderedPair(BoxId(slots[i]), BoxId(other)));
            });
        });
    for (int part = 0; part < parts; ++part) {
      const auto& out = found[static_cast<std::size_t>(part)];
      pairs.insert(pairs.end(), out.begin(), out.end());
    }
  }

 private:
  /// Visits the slots whose boxes overlap `box`, from the leaf `first` on.
  template <class Visit>
  void descend(const Box& box, std::size_t first, Visit visit) const {
    std::array<std::uint32_t, 128> waiting;  // at most one node of each depth
    std::size_t size = 0;
    const auto enter = [&](std::uint32_t child) {
      const bool isLeaf = child & CodeTree::kLeafFlag;
      const std::uint32_t place = child & ~CodeTree::kLeafFlag;
      if ((isLeaf ? place : tree_.nodes()[place].last) < first) return;
      if (!overlaps(box, isLeaf ? tree_.boxes()[place] : tree_.nodes()[place].box)) return;
      if (isLeaf)
        visit(tree_.slots()[place]);
      else
        waiting[size++] = place;
    };
    if (!tree_.slots().empty()) enter(tree_.nodes().empty() ? CodeTree::kLeafFlag : 0);
    while (size > 0) {
      const CodeTree::Node& node = tree_.nodes()[waiting[--size]];
      enter(node.left);
      enter(node.right);
    }
  }

  std::span<const Box> boxes_;
  std::vector<std::uint32_t> slots_;
  CodeTree tree_;
  int threads_;
};

}  // namespace

std::unique_ptr<Rival> makeBvh(int threads) { return std::make_unique<LinearBvh>(threads); }

}  // namespace yadefrag
