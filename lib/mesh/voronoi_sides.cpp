#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <map>
#include <set>
#include <utility>

#include "core/errors.hpp"
#include "mesh/polygon.hpp"
#include "mesh/voronoi.hpp"

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

/// What may move where: a point inside anywhere, one on the outline to another there, and the
/// outline's own corners not at all.
enum Rank : std::uint8_t { kInside, kOnOutline, kCorner };

class Merging {
 public:
  Merging(const std::vector<Loop>& grains, const Loop& outline) {
    for (const Loop& grain : grains)
      for (std::size_t i = 0; i < grain.size(); ++i) {
        const Vec2 a = grain[i], b = grain[(i + 1) % grain.size()];
        sides_.insert({keyOf(a), keyOf(b)});
        places_.try_emplace(keyOf(a), Place{keyOf(a), a, 1, kInside});
      }
    for (const auto& [a, b] : sides_)
      if (!sides_.contains({b, a})) places_.at(a).rank = places_.at(b).rank = kOnOutline;
    for (const Vec2 corner : outline) {
      const auto place = places_.find(keyOf(corner));
      if (place != places_.end()) place->second.rank = kCorner;
    }
  }

  /// False if there was nothing to merge.
  bool run(double shortest) {
    bool any = false;
    for (const auto& [a, b] : sides_) {
      const Key first = rootOf(a), second = rootOf(b);
      if (first == second || std::hypot(a.first - b.first, a.second - b.second) >= shortest)
        continue;
      const bool isOuter = !sides_.contains({b, a});
      any = join(places_.at(first), places_.at(second), isOuter) || any;
    }
    return any;
  }

  [[nodiscard]] Loop moved(const Loop& grain) {
    Loop result;
    for (const Vec2 p : grain) {
      const Vec2 at = places_.at(rootOf(keyOf(p))).at;
      if (result.empty() || result.back() != at) result.push_back(at);
    }
    while (result.size() > 1 && result.front() == result.back()) result.pop_back();
    return result;
  }

 private:
  struct Place {
    Key root;  // another place that it has been joined to, or itself
    Vec2 at;
    double count;  // of points that `at` is the mean of
    Rank rank;
  };

  Key rootOf(Key key) {
    while (places_.at(key).root != key) key = places_.at(key).root;
    return key;
  }

  /// `isOuter`: is the side between them one of the outline; others must not pinch it off.
  static bool join(Place& a, Place& b, bool isOuter) {
    if (a.rank == kCorner && b.rank == kCorner) return false;
    if (a.rank != kInside && b.rank != kInside && !isOuter) return false;
    Place& stays = a.rank >= b.rank ? a : b;
    Place& goes = a.rank >= b.rank ? b : a;
    if (stays.rank == kInside) {
      stays.at = (1 / (stays.count + goes.count)) * (stays.count * stays.at + goes.count * goes.at);
      stays.count += goes.count;
    }
    goes.root = stays.root;
    return true;
  }

  std::set<std::pair<Key, Key>> sides_;
  std::map<Key, Place> places_;
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
  std::array<char, 160> text;
  (void)std::snprintf(
      text.data(), text.size(),
      "shortest is %.4g m, too long for these grains; it must be less, or the grains "
      "fewer.",
      shortest);
  throw InputError(text.data());
}

}  // namespace

std::vector<Loop> withoutShortSides(std::vector<Loop> grains, const Loop& outline,
                                    double shortest) {
  const std::size_t before = grains.size();
  // What is merged may come near to others.
  for (bool goesOn = true; goesOn;) {
    Merging merging(grains, outline);
    goesOn = merging.run(shortest);
    for (Loop& grain : grains) grain = merging.moved(grain);
    std::erase_if(grains, [](const Loop& grain) { return grain.size() < 3; });
  }
  // The outline is as it was and every other side has a grain on both sides: grains that are all
  // upright do not overlap.
  if (2 * grains.size() < before || !std::ranges::all_of(grains, isSound)) refuse(shortest);
  return grains;
}

}  // namespace yadefrag
