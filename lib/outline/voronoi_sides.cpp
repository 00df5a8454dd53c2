#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <utility>

#include "core/disjoint_sets.hpp"
#include "core/errors.hpp"
#include "outline/polygon.hpp"
#include "outline/voronoi.hpp"

namespace yadefrag {
namespace {

using Loop = std::vector<Vec2>;
using Key = std::pair<double, double>;

Key keyOf(Vec2 p) { return {p.x, p.y}; }

double areaOf(const Loop& loop) {
  double twice = 0;
  for (std::size_t i = 2; i < loop.size(); ++i)
    twice += cross(loop[i - 1] - loop[0], loop[i] - loop[0]);
  return twice / 2;
}

/// Permitted motion of a point: a point inside may move anywhere, a point on the outline to another
/// one on the outline; corners of the outline must not move.
enum Rank : std::uint8_t { kInside, kOnOutline, kCorner };

class Merging {
 public:
  Merging(const std::vector<Loop>& grains, const Loop& outline) {
    for (const Loop& grain : grains)
      for (std::size_t i = 0; i < grain.size(); ++i) {
        const Vec2 a = grain[i], b = grain[(i + 1) % grain.size()];
        sides_.insert({keyOf(a), keyOf(b)});
        if (numbers_.try_emplace(keyOf(a), places_.size()).second)
          places_.push_back({a, 1, kInside});
      }
    sets_.reset(places_.size());
    for (const auto& [a, b] : sides_)
      if (!sides_.contains({b, a})) placeOf(a).rank = placeOf(b).rank = kOnOutline;
    for (const Vec2 corner : outline) {
      const auto number = numbers_.find(keyOf(corner));
      if (number != numbers_.end()) places_[number->second].rank = kCorner;
    }
  }

  /// Returns false if there was no side to merge.
  bool run(double shortest) {
    bool any = false;
    for (const auto& [a, b] : sides_) {
      const std::uint32_t first = setOf(a), second = setOf(b);
      if (first == second || std::hypot(a.first - b.first, a.second - b.second) >= shortest)
        continue;
      any = join(first, second, !sides_.contains({b, a})) || any;
    }
    return any;
  }

  [[nodiscard]] Loop moved(const Loop& grain) {
    Loop result;
    for (const Vec2 p : grain) {
      const Vec2 at = placeOf(keyOf(p)).at;
      if (result.empty() || result.back() != at) result.push_back(at);
    }
    while (result.size() > 1 && result.front() == result.back()) result.pop_back();
    return result;
  }

 private:
  /// A set of merged points.
  struct Place {
    Vec2 at;
    double count;  // number of points whose mean is `at`
    Rank rank;
  };

  std::uint32_t setOf(Key key) { return sets_.find(static_cast<std::uint32_t>(numbers_.at(key))); }
  Place& placeOf(Key key) { return places_[setOf(key)]; }

  /// `isOuter`: the side between the points is on the outline. Other sides must not constrict the
  /// outline.
  bool join(std::uint32_t first, std::uint32_t second, bool isOuter) {
    const Place& a = places_[first];
    const Place& b = places_[second];
    if (a.rank == kCorner && b.rank == kCorner) return false;
    if (a.rank != kInside && b.rank != kInside && !isOuter) return false;
    Place stays = a.rank >= b.rank ? a : b;
    const Place& goes = a.rank >= b.rank ? b : a;
    if (stays.rank == kInside) {
      stays.at = (1 / (stays.count + goes.count)) * (stays.count * stays.at + goes.count * goes.at);
      stays.count += goes.count;
    }
    sets_.join(first, second);
    places_[sets_.find(first)] = stays;
    return true;
  }

  std::set<std::pair<Key, Key>> sides_;
  std::map<Key, std::size_t> numbers_;
  DisjointSets sets_;          // sets of point numbers
  std::vector<Place> places_;  // by point number; that of a set is at its representative
};

bool isSound(const Loop& grain) {
  try {
    (void)checkPolygon({grain, {}});
    return areaOf(grain) > 0;
  } catch (const InputError&) {
    return false;
  }
}

[[noreturn]] void refuse(double shortest) {
  throw InputError(fmt::format(
      "shortest is {:.4g} m, too long for these grains; it must be less, or the grains fewer.",
      shortest));
}

}  // namespace

std::vector<Loop> withoutShortSides(std::vector<Loop> grains, const Loop& outline,
                                    double shortest) {
  const std::size_t before = grains.size();
  // Merged points may come near to others: repeat.
  for (bool goesOn = true; goesOn;) {
    Merging merging(grains, outline);
    goesOn = merging.run(shortest);
    for (Loop& grain : grains) grain = merging.moved(grain);
    std::erase_if(grains, [](const Loop& grain) { return grain.size() < 3; });
  }
  // The outline is unchanged and every other side has a grain on both sides: grains with positive
  // area therefore do not overlap.
  if (2 * grains.size() < before || !std::ranges::all_of(grains, isSound)) refuse(shortest);
  return grains;
}

}  // namespace yadefrag
