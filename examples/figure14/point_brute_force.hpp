#pragma once
// Tests every slave against every master: the reference for the other point searches.

#include "figure14/point_search.hpp"

namespace yadefrag {

template <class Count>
class PointBruteForce final : public PointSearch {
 public:
  void update(std::span<const Vec2> points) override { points_ = points; }
  [[nodiscard]] Comparisons comparisons() const override { return count_.total(); }

  void find(std::span<const Rectangle> masters, double halo, Csr<EntryId>& candidates) override {
    candidates.values.clear();
    candidates.offsets.assign(1, 0);
    for (const Rectangle& master : masters) {
      const Rectangle rectangle = enlarged(master, halo);
      for (std::size_t i = 0; i < points_.size(); ++i)
        if (contains(rectangle, points_[i])) candidates.values.emplace_back(i);
      count_.test(4 * points_.size());
      candidates.offsets.push_back(static_cast<std::uint32_t>(candidates.values.size()));
    }
  }

 private:
  std::span<const Vec2> points_;
  Count count_;
};

}  // namespace yadefrag
