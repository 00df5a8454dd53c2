#pragma once
// One point against one body, step by step.

#include <gtest/gtest.h>

#include <cmath>

#include "contact/contact_scenes.hpp"
#include "contact/local_search.hpp"

namespace yadefrag::test {

/// Beyond any scene's size: nothing is left out for its distance.
constexpr double kUnlimited = 1e9;

inline std::vector<SlaveMaster> pairsOf(const std::vector<Active>& actives) {
  std::vector<SlaveMaster> pairs;
  pairs.reserve(actives.size());
  for (const Active& active : actives) pairs.push_back(active.pair);
  return pairs;
}

/// The tip of a needle and all pieces of a body as its masters.
class PointAgainstBody {
 public:
  PointAgainstBody(const std::vector<Vec2>& points, const std::vector<std::uint8_t>& smooth,
                   Vec2 direction, Vec2 from) {
    body_ = scene_.addBody(points, smooth);
    tip_ = scene_.addNeedle(direction);
    scene_.moveNeedle(tip_, from);
    at_ = from;
    std::vector<SlaveMaster> pairs;
    for (EntryId master = body_; master < tip_; master = master + 1)
      pairs.push_back({tip_, master});
    replaceCandidates(candidates_, pairs);
  }

  /// The actives where the tip is predicted to be; it ends the step at `corrected`.
  std::vector<Active> step(Vec2 predicted, Vec2 corrected) {
    before_ = scene_.at;
    scene_.moveNeedle(tip_, predicted);
    Candidates all = candidates_;
    const std::vector<Active> wanted = find(all, kUnlimited);
    // As far as World looks ahead: twice the largest displacement.
    std::vector<Active> actives = find(candidates_, 2 * norm(predicted - at_) + 1e-9);
    EXPECT_EQ(pairsOf(actives), pairsOf(wanted));
    scene_.moveNeedle(tip_, corrected);
    at_ = corrected;
    touches_.clear();
    for (const Active& active : actives) touches_.push_back({active.pair, 0, 0, 0});
    return actives;
  }
  std::vector<Active> step(Vec2 to) { return step(to, to); }

  /// Numbers of the pieces on which the tip is active.
  std::vector<std::size_t> masters(Vec2 predicted, Vec2 corrected) {
    std::vector<std::size_t> found;
    for (const Active& active : step(predicted, corrected))
      found.push_back(active.pair.master.value - body_.value);
    return found;
  }
  std::vector<std::size_t> masters(Vec2 to) { return masters(to, to); }

  [[nodiscard]] const SurfaceScene& scene() const { return scene_; }
  [[nodiscard]] EntryId body() const { return body_; }
  [[nodiscard]] EntryId tip() const { return tip_; }

  double halo = kUnlimited;
  static constexpr double kDepth = 1e-4;  ///< m, of PathStart

 private:
  std::vector<Vec2> before_;
  std::vector<Touch> touches_;
  std::vector<Active> find(Candidates& candidates, double reach) {
    std::vector<Active> actives;
    const PathStart start{before_, touches_, kDepth, .1};
    search_.scan(candidates, scene_.surfaces, scene_.at, start, reach, 1);
    search_.findActives(candidates, scene_.surfaces, scene_.at, halo, actives);
    return actives;
  }

  SurfaceScene scene_;
  EntryId body_, tip_;
  Vec2 at_;
  Candidates candidates_;
  LocalSearch search_;
};

}  // namespace yadefrag::test
