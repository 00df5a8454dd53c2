#include "outline/narrowest.hpp"

#include <CGAL/box_intersection_d.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace yadefrag {
namespace {

constexpr int kMostPieces = 1000;  // of one side

struct Side {
  Vec2 start;
  Vec2 end;
};

double distanceOf(Vec2 p, const Side& side) {
  const Vec2 along = side.end - side.start;
  const double square = std::max(dot(along, along), std::numeric_limits<double>::min());
  const double part = std::clamp(dot(p - side.start, along) / square, 0., 1.);
  return norm(p - side.start - part * along);
}

class Search {
 public:
  explicit Search(const std::vector<std::vector<Vec2>>& loops) {
    for (const auto& loop : loops) {
      const std::size_t n = loop.size();
      const std::size_t first = sides_.size();
      for (std::size_t k = 0; k < n; ++k) sides_.push_back({loop[k], loop[k + 1 == n ? 0 : k + 1]});
      // The next sides but one are near: an upper bound, at most the shortest side.
      for (std::size_t k = 0; k < n; ++k)
        for (std::size_t next = 1; next < std::min<std::size_t>(n, 4); ++next)
          add(first + k, first + (k + next) % n);
    }
  }

  NarrowPlace find() {
    using Box = CGAL::Box_intersection_d::Box_with_info_d<double, 2, std::size_t>;
    std::vector<Box> corners;
    std::vector<Box> pieces;
    const auto append = [](std::vector<Box>& boxes, Vec2 a, Vec2 b, double around, std::size_t i) {
      const std::array<double, 2> low{std::min(a.x, b.x) - around, std::min(a.y, b.y) - around};
      const std::array<double, 2> high{std::max(a.x, b.x) + around, std::max(a.y, b.y) + around};
      boxes.emplace_back(CGAL::Bbox_2(low[0], low[1], high[0], high[1]), i);
    };
    double total = 0;
    for (const Side& side : sides_) total += norm(side.end - side.start);
    const double longest = total / static_cast<double>(sides_.size());
    for (std::size_t i = 0; i < sides_.size(); ++i) {
      const auto& [start, end] = sides_[i];
      append(corners, start, start, best_.distance, i);
      // Pieces, because the box of a long oblique side would contain many corners.
      const double wanted = norm(end - start) / longest;
      const int count = wanted < kMostPieces ? std::max(1, static_cast<int>(wanted)) : kMostPieces;
      const Vec2 piece = 1. / count * (end - start);
      for (int k = 0; k < count; ++k)
        append(pieces, start + k * piece, k + 1 == count ? end : start + (k + 1) * piece, 0, i);
    }
    CGAL::box_intersection_d(corners.begin(), corners.end(), pieces.begin(), pieces.end(),
                             [&](const Box& a, const Box& b) { add(a.info(), b.info()); });
    return best_;
  }

 private:
  void add(std::size_t corner, std::size_t side) {
    const Vec2 p = sides_[corner].start;
    if (p == sides_[side].start || p == sides_[side].end) return;
    const double distance = distanceOf(p, sides_[side]);
    if (distance < best_.distance || (distance == best_.distance && corner < best_.corner))
      best_ = {distance, corner};
  }

  std::vector<Side> sides_;
  NarrowPlace best_{std::numeric_limits<double>::infinity(), 0};
};

}  // namespace

NarrowPlace narrowestPlace(const std::vector<std::vector<Vec2>>& loops) {
  return Search(loops).find();
}

}  // namespace yadefrag
