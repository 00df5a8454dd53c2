#pragma once
// The scenes of the paper's figures 11 to 13 as input of a search: outlines of segments,
// and a motion that stands for the mechanics. Lengths are in lengths of a square's or bar's
// segment.

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <memory>
#include <numbers>
#include <random>
#include <vector>

#include "figure14/point_search.hpp"
#include "search/contact_search.hpp"

namespace yadefrag::figure14 {

/// Outlines that move. Entry i is the node i and the segment to the next node of its loop.
class MovingOutlines {
 public:
  MovingOutlines() = default;
  MovingOutlines(const MovingOutlines&) = delete;
  MovingOutlines& operator=(const MovingOutlines&) = delete;
  virtual ~MovingOutlines() = default;

  /// Moves on until the fastest node has gone `way`, or about so. False when there is no more.
  virtual bool advance(double way) = 0;

  [[nodiscard]] const std::vector<Vec2>& points() const { return points_; }
  [[nodiscard]] std::vector<Rectangle> masters() const {
    std::vector<Rectangle> all;
    all.reserve(points_.size());
    forEachSegment([&](Vec2 a, Vec2 b) {
      all.push_back(
          {{std::min(a.x, b.x), std::min(a.y, b.y)}, {std::max(a.x, b.x), std::max(a.y, b.y)}});
    });
    return all;
  }
  [[nodiscard]] double shortestSegment() const {
    double shortest = std::numeric_limits<double>::infinity();
    forEachSegment([&](Vec2 a, Vec2 b) { shortest = std::min(shortest, norm(b - a)); });
    return shortest;
  }
  [[nodiscard]] PointSearchPlan plan() const {
    Vec2 low = points_.front();
    for (const Vec2 p : points_) low = {std::min(low.x, p.x), std::min(low.y, p.y)};
    return {edge_, low - Vec2{edge_, edge_}, loopStart_};
  }

 protected:
  void beginLoop() { loopStart_.push_back(static_cast<std::uint32_t>(points_.size())); }
  /// Nodes from a (with) to b (without), about one length apart.
  void line(Vec2 a, Vec2 b) {
    const double parts = std::max(1., std::round(norm(b - a)));
    for (double k = 0; k < parts; ++k) points_.push_back(a + (k / parts) * (b - a));
  }
  /// Clockwise where `hole`.
  void rectangle(Vec2 low, Vec2 high, bool hole = false) {
    const Vec2 right{high.x, low.y}, left{low.x, high.y};
    beginLoop();
    line(low, hole ? left : right);
    line(hole ? left : right, high);
    line(high, hole ? right : left);
    line(hole ? right : left, low);
  }

  double edge_ = 1;  // b
  std::vector<Vec2> points_;
  std::vector<std::uint32_t> loopStart_;

 private:
  template <class Visit>
  void forEachSegment(Visit visit) const {
    for (std::size_t l = 0; l < loopStart_.size(); ++l) {
      const std::size_t begin = loopStart_[l];
      const std::size_t end = l + 1 < loopStart_.size() ? loopStart_[l + 1] : points_.size();
      for (std::size_t i = begin; i < end; ++i)
        visit(points_[i], points_[i + 1 < end ? i + 1 : begin]);
    }
  }
};

/// Fig. 11: n × n unit squares in a frame, of which 25 % start with one speed in random directions.
/// They stay upright; where two meet, or one meets the frame, the velocities along the normal are
/// exchanged or turned round (equal masses, no friction, no loss).
class Squares final : public MovingOutlines {
 public:
  explicit Squares(int n) : side_(n * kPitch + kGap) {
    std::uniform_real_distribution<double> angle(0, 2 * std::numbers::pi);
    for (int row = 0; row < n; ++row)
      for (int column = 0; column < n; ++column) {
        corners_.push_back({kGap + column * kPitch, kGap + row * kPitch});
        velocities_.push_back({});
      }
    std::vector<std::size_t> order(corners_.size());
    for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
    std::shuffle(order.begin(), order.end(), random_);
    for (std::size_t i = 0; i < order.size() / 4; ++i) {
      const double a = angle(random_);
      velocities_[order[i]] = {std::cos(a), std::sin(a)};
    }
    rectangle({0, 0}, {side_, side_}, true);
    for (const Vec2 corner : corners_) rectangle(corner, corner + Vec2{1, 1});
  }

  bool advance(double way) override {
    constexpr int kSubsteps = 4;  // much shorter than a gap each
    double fastest = 0;
    for (const Vec2 v : velocities_) fastest = std::max(fastest, norm(v));
    for (int k = 0; k < kSubsteps; ++k) {
      for (std::size_t i = 0; i < corners_.size(); ++i)
        corners_[i] += (way / fastest / kSubsteps) * velocities_[i];
      collide();
    }
    for (std::size_t i = 0; i < corners_.size(); ++i) {
      Vec2* corner = &points_[loopStart_[i + 1]];
      const Vec2 by = corners_[i] - *corner;
      for (int k = 0; k < 4; ++k) corner[k] += by;
    }
    return true;
  }

 private:
  static constexpr double kGap = .4, kPitch = 1 + kGap;  // room for the paper's large displacements

  static void exchange(double distance, double& a, double& b) {
    if ((b - a) * distance < 0) std::swap(a, b);
  }
  static void turnBack(double at, double most, double& v) {
    if ((at < 0 && v < 0) || (at > most && v > 0)) v = -v;
  }

  void collide() {
    std::vector<Box> boxes;
    for (const Vec2 c : corners_) boxes.push_back({{c.x, c.y, 0}, {c.x + 1, c.y + 1, 0}});
    std::vector<BoxPair> pairs;
    meeting_->update(boxes);
    meeting_->findPairs(pairs);
    std::sort(pairs.begin(), pairs.end());
    for (const BoxPair& pair : pairs) {
      Vec2& a = velocities_[pair.first.value];
      Vec2& b = velocities_[pair.second.value];
      const Vec2 apart = corners_[pair.second.value] - corners_[pair.first.value];
      if (std::abs(apart.x) > std::abs(apart.y))
        exchange(apart.x, a.x, b.x);
      else
        exchange(apart.y, a.y, b.y);
    }
    for (std::size_t i = 0; i < corners_.size(); ++i) {
      turnBack(corners_[i].x, side_ - 1, velocities_[i].x);
      turnBack(corners_[i].y, side_ - 1, velocities_[i].y);
    }
  }

  double side_;
  std::vector<Vec2> corners_, velocities_;
  std::mt19937_64 random_{11};
  std::unique_ptr<ContactSearch> meeting_ = makeSearch(SearchMethod::kLebesgue);
};

/// Fig. 12: n concentric rings, an inner and an outer surface each, the outer rings with slightly
/// more segments. Each starts in a direction of its own and is thrown back by its neighbours (equal
/// masses, no friction, no loss).
class Rings final : public MovingOutlines {
 public:
  explicit Rings(int n) {
    std::uniform_real_distribution<double> angle(0, 2 * std::numbers::pi);
    for (int i = 0; i < n; ++i) {
      const double inner = kInnermost + i * (kThickness + kGap);
      const int segments = kFewest + kMore * i;
      circle(inner, segments, true);
      circle(inner + kThickness, segments, false);
      const double a = angle(random_);
      velocities_.push_back({std::cos(a), std::sin(a)});
    }
    centres_.resize(velocities_.size());
    edge_ = shortestSegment();
  }

  bool advance(double way) override {
    constexpr int kSubsteps = 16;
    double fastest = 0;
    for (const Vec2 v : velocities_) fastest = std::max(fastest, norm(v));
    const std::vector<Vec2> before = centres_;
    for (int k = 0; k < kSubsteps; ++k) {
      for (std::size_t i = 0; i < centres_.size(); ++i)
        centres_[i] += (way / fastest / kSubsteps) * velocities_[i];
      for (std::size_t i = 0; i + 1 < centres_.size(); ++i) collide(i, i + 1);
    }
    for (std::size_t l = 0; l < loopStart_.size(); ++l) {
      const Vec2 by = centres_[l / 2] - before[l / 2];
      const std::size_t end = l + 1 < loopStart_.size() ? loopStart_[l + 1] : points_.size();
      for (std::size_t i = loopStart_[l]; i < end; ++i) points_[i] += by;
    }
    return true;
  }

 private:
  static constexpr double kInnermost = 4, kThickness = 1, kGap = .1;
  static constexpr int kFewest = 32, kMore = 2;  // segments around a surface

  void circle(double radius, int segments, bool hole) {
    beginLoop();
    for (int k = 0; k < segments; ++k) {
      const double a = (hole ? -2 : 2) * std::numbers::pi * k / segments;
      points_.push_back({radius * std::cos(a), radius * std::sin(a)});
    }
  }

  void collide(std::size_t i, std::size_t j) {
    const Vec2 apart = centres_[j] - centres_[i];
    const double distance = norm(apart);
    const Vec2 velocity = velocities_[j] - velocities_[i];
    if (distance <= kGap || dot(velocity, apart) <= 0) return;
    const Vec2 along = (dot(velocity, apart) / (distance * distance)) * apart;
    velocities_[i] += along;
    velocities_[j] -= along;
  }

  std::vector<Vec2> centres_, velocities_;
  std::mt19937_64 random_{12};
};

/// Fig. 13: n slender bars, upright side by side, which a heavy block presses down until they lie
/// folded into each other: each bends like an elastica, at the angle φ·cos(2πms/L) from upright at
/// the length s of its centreline, which keeps its length; they make room to the sides.
class Bars final : public MovingOutlines {
 public:
  explicit Bars(int n) : bars_(n) { place(0); }

  bool advance(double way) override {
    if (angle_ >= kMostAngle) return false;
    const std::vector<Vec2> before = points_;
    const auto gone = [&] {
      double most = 0;
      for (std::size_t i = 0; i < before.size(); ++i)
        most = std::max(most, norm(points_[i] - before[i]));
      return most;
    };
    for (step_ *= 1.2; place(angle_ + step_), gone() > way;) step_ *= .9;
    angle_ += step_;
    return true;
  }

 private:
  static constexpr int kLength = 120, kWaves = 2;
  static constexpr double kThickness = 2, kGap = .1, kBlock = 6, kMostAngle = 1.05;

  void place(double angle) {
    points_.clear();
    loopStart_.clear();
    bend(angle);
    const double pitch = kThickness / std::cos(angle) + kGap;
    for (int bar = 0; bar < bars_; ++bar) addBar(pitch * (bar - .5 * (bars_ - 1)));
    const double wide = 2.5 * bars_ + 15;
    const double corner = .5 * kThickness * std::sin(angle);  // of the tilted ends
    const double floor = -corner - kGap, ceiling = axis_.back().y + corner + kGap;
    rectangle({-wide, floor - kBlock}, {wide, floor});
    rectangle({-wide, ceiling}, {wide, ceiling + kBlock});
  }

  /// The centreline, and the half thickness to its right.
  void bend(double angle) {
    constexpr int kParts = 16;  // of a length, to integrate the bent line
    const auto at = [&](double s) {
      return angle * std::cos(2 * std::numbers::pi * kWaves * s / kLength);
    };
    axis_.assign(1, {});
    toRight_.clear();
    for (int k = 0; k <= kLength; ++k) {
      toRight_.push_back(.5 * kThickness * Vec2{std::cos(at(k)), -std::sin(at(k))});
      Vec2 next = axis_.back();
      for (int p = 0; p < kParts; ++p) {
        const double s = at(k + (p + .5) / kParts);
        next += (1. / kParts) * Vec2{std::sin(s), std::cos(s)};
      }
      if (k < kLength) axis_.push_back(next);
    }
  }

  void addBar(double x) {
    const Vec2 foot{x, 0};
    beginLoop();
    line(foot + axis_.front() - toRight_.front(), foot + axis_.front() + toRight_.front());
    for (int k = 0; k < kLength; ++k) points_.push_back(foot + axis_[k] + toRight_[k]);
    line(foot + axis_.back() + toRight_.back(), foot + axis_.back() - toRight_.back());
    for (int k = kLength; k > 0; --k) points_.push_back(foot + axis_[k] - toRight_[k]);
  }

  int bars_;
  double angle_ = 0, step_ = .05;
  std::vector<Vec2> axis_, toRight_;
};

}  // namespace yadefrag::figure14
