#pragma once
// The true-halo test (paper §4.4: a node found by its code is tested against the oriented halo):
// more than half of the spheres whose boxes overlap cannot touch before the next search.

#include <algorithm>
#include <vector>

#include "collider/body_boxes.hpp"
#include "core/ids.hpp"
#include "core/request.hpp"
#include "core/tolerances/collider.hpp"
#include "yade/yade.hpp"

namespace yadefrag {

/// Pairs of bodies that may touch before the next search.
struct Neighbours {
  std::vector<BoxPair> pairs;
  /// By pair: the shift of the second body in cells; empty in a scene that is not periodic.
  std::vector<yade::Vector3i> cellDist;

  [[nodiscard]] std::size_t size() const { return pairs.size(); }
  [[nodiscard]] yade::Body::id_t first(std::size_t i) const { return idOf(pairs[i].first); }
  [[nodiscard]] yade::Body::id_t second(std::size_t i) const { return idOf(pairs[i].second); }
  [[nodiscard]] yade::Vector3i shift(std::size_t i) const {
    return cellDist.empty() ? yade::Vector3i(yade::Vector3i::Zero()) : cellDist[i];
  }

 private:
  static yade::Body::id_t idOf(BoxId id) { return static_cast<yade::Body::id_t>(id.value); }
};

/// How two bodies are near.
struct Nearness {
  yade::Vector3i cellDist = yade::Vector3i::Zero();
  bool byHalf = true;  ///< also with sweeps half as long
};

class SphereReach {
 public:
  /// `slack` (m): the largest reduction of a distance by the cell's deformation before the next
  /// search.
  SphereReach(const std::vector<Ball>& balls, double slack) : balls_(balls), slack_(slack) {}

  [[nodiscard]] bool areBalls(const BoxPair& pair) const {
    return balls_[pair.first.value].radius >= 0 && balls_[pair.second.value].radius >= 0;
  }

  /// False if the bodies are spheres that cannot touch while both stay within their sweeps. The
  /// integrator checks each component of a displacement separately, so that the relative
  /// displacement may be anywhere in a cube of half-width s₁ + s₂: a sphere of that radius would be
  /// too small.
  [[nodiscard]] bool mayTouch(const BoxPair& pair, const yade::Vector3r& shift,
                              bool& byHalf) const {
    const Ball& a = balls_[pair.first.value];
    const Ball& b = balls_[pair.second.value];
    byHalf = true;
    if (!areBalls(pair)) return true;
    const yade::Vector3r apart = (b.centre + shift - a.centre).cwiseAbs();
    const double farthest =
        std::max(a.centre.cwiseAbs().maxCoeff(), b.centre.cwiseAbs().maxCoeff());
    const double reach = a.radius + b.radius;
    const double sum = reach + tolerance::kHaloRounding * (2 * farthest + apart.maxCoeff() + reach);
    const double cube = a.sweep + b.sweep;
    byHalf = isWithin(apart, .5 * cube + slack_, sum);
    return byHalf || isWithin(apart, cube + slack_, sum);
  }

  void prefetch(const BoxPair& pair) const {
    for (const BoxId id : {pair.first, pair.second}) {
      requestLine(&balls_[id.value]);
      requestLine(&balls_[id.value].sweep);
    }
  }

 private:
  /// True if a point at `apart` is within `reach` of the cube of the given half-width.
  static bool isWithin(const yade::Vector3r& apart, double halfWidth, double reach) {
    const double x = std::max(apart[0] - halfWidth, 0.);
    const double y = std::max(apart[1] - halfWidth, 0.);
    const double z = std::max(apart[2] - halfWidth, 0.);
    return x * x + y * y + z * z <= reach * reach;
  }

  const std::vector<Ball>& balls_;
  double slack_;
};

}  // namespace yadefrag
