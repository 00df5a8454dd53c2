#include "figure14/point_search.hpp"

#include <utility>

#include "figure14/point_code_search.hpp"

namespace yadefrag {
namespace {

/// Tests every slave against every master: the reference for the other searches.
class PointBruteForce final : public PointSearch {
 public:
  void update(std::span<const Vec2> points) override { points_ = points; }
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
};

}  // namespace

std::unique_ptr<PointSearch> makePointSearch(SearchMethod method, PointSearchPlan plan) {
  switch (method) {
    case SearchMethod::kLebesgue:
      if (plan.directory)
        return std::make_unique<PointCodeSearch<LebesgueNumbering<2>, Lookup::kDirectory>>(plan);
      return std::make_unique<PointCodeSearch<LebesgueNumbering<2>, Lookup::kExponential>>(plan);
    case SearchMethod::kLinearCode:
      return std::make_unique<PointCodeSearch<LinearNumbering<2>, Lookup::kBinary>>(plan);
    case SearchMethod::kHierarchy:
      return makePointHierarchy(std::move(plan));
    case SearchMethod::kSweptRows:  // these two search boxes only
    case SearchMethod::kFastest:
    case SearchMethod::kBruteForce:
      break;
  }
  return std::make_unique<PointBruteForce>();
}

}  // namespace yadefrag
