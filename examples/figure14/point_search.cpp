#include "figure14/point_search.hpp"

#include <type_traits>
#include <utility>

#include "figure14/point_code_search.hpp"

namespace yadefrag {
namespace {

/// Tests every slave against every master: the reference for the other searches.
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

template <class Numbering, Lookup kLookup, class Count>
std::unique_ptr<PointSearch> makeCodes(const PointSearchPlan& plan) {
  return std::make_unique<PointCodeSearch<Numbering, kLookup, Count>>(plan);
}

template <class Count>
std::unique_ptr<PointSearch> make(SearchMethod method, PointSearchPlan plan) {
  switch (method) {
    case SearchMethod::kLebesgue:
      if (plan.directory) return makeCodes<LebesgueNumbering<2>, Lookup::kDirectory, Count>(plan);
      return makeCodes<LebesgueNumbering<2>, Lookup::kExponential, Count>(plan);
    case SearchMethod::kLinearCode:
      return makeCodes<LinearNumbering<2>, Lookup::kBinary, Count>(plan);
    case SearchMethod::kHierarchy:
      return makePointHierarchy(std::move(plan), std::is_same_v<Count, CountAll>);
    case SearchMethod::kSweptRows:  // these two search boxes only
    case SearchMethod::kFastest:
    case SearchMethod::kBruteForce:
      break;
  }
  return std::make_unique<PointBruteForce<Count>>();
}

}  // namespace

std::unique_ptr<PointSearch> makePointSearch(SearchMethod method, PointSearchPlan plan,
                                             bool countComparisons) {
  return countComparisons ? make<CountAll>(method, std::move(plan))
                          : make<CountNothing>(method, std::move(plan));
}

}  // namespace yadefrag
