#pragma once
// Common code of the loops of plastic_kernel.cpp: state to lanes and back, the trial, the forces.

#include <algorithm>
#include <cstdint>
#include <limits>
#include <numbers>

#include "core/tolerances/dynamics.hpp"
#include "core/tolerances/plasticity.hpp"
#include "dynamics/lane_corners.hpp"
#include "dynamics/yield_lanes.hpp"

namespace yadefrag {

/// std::copy_n would call memmove.
[[gnu::always_inline]] inline void copyLanes(const double* from, double* to) {
#pragma omp simd
  for (std::size_t k = 0; k < kLanes; ++k) to[k] = from[k];
}

/// Copies values of elements to lanes and back; lanes after the last element repeat its value.
class Group {
 public:
  [[gnu::always_inline]] Group(std::uint32_t first, std::uint32_t end)
      : first_(first), count_(std::min<std::uint32_t>(kLanes, end - first)) {}

  [[gnu::always_inline]] void load(const double* values, double (&lanes)[kLanes]) const {
    if (count_ == kLanes)
      copyLanes(values + first_, lanes);
    else
      for (std::uint32_t k = 0; k < kLanes; ++k)
        lanes[k] = values[first_ + std::min(k, count_ - 1)];
  }
  [[gnu::always_inline]] void store(const double (&lanes)[kLanes], double* values) const {
    if (count_ == kLanes)
      copyLanes(lanes, values + first_);
    else
      std::copy_n(lanes, count_, values + first_);
  }
  [[gnu::always_inline]] void load(const PlasticChunk& in, StateLanes& s) const {
    for (std::size_t i = 0; i < 4; ++i) load(in.edges[i], s.edges[i]);
    load(in.thickness, s.thickness);
  }
  [[nodiscard]] std::uint32_t count() const { return count_; }

 private:
  std::uint32_t first_, count_;
};

/// Newton's method for the stretch across the plane at which the stress there is zero.
[[gnu::always_inline]] inline double elasticThickness(const Matrix2& f, double thickness,
                                                      const SolidModuli& m) {
  for (int i = 0; i < tolerance::kElasticThicknesses; ++i) {
    const ElasticTrial t(f, thickness);
    const double stress = meanStress(t.volume, m.bulk) + 2 * m.shear * t.across / 3;
    const double slope = m.bulk * t.volume * t.volume + 4. / 3 * m.shear;
    const double change = stress / slope;
    thickness *= 1 - change + change * change / 2;
  }
  return thickness;
}

struct Trials {
  int flat = 0, yielding = 0;
};

/// `w`: yield stresses, and of a cone with nodal pressures the opening.
template <bool kPlane, bool kNodal, bool kCone>
[[gnu::always_inline]] inline Trials tryLanes(const ElementLanes& e, const PlasticChunk& in,
                                              const StateLanes& s, const Corners& c, FlowLanes& w,
                                              TrialLanes& out) {
  const SolidModuli moduli = in.moduli;
  const double squaredShear = moduli.shear * moduli.shear;
  const double slope = std::numbers::sqrt3 * in.cone.slope, most = in.cone.limit;
  alignas(64) double pressure[kLanes];
  if constexpr (kNodal)
    for (std::size_t k = 0; k < kLanes; ++k)
      pressure[k] = (in.pressure[e.corner[0][k]] + in.pressure[e.corner[1][k]] +
                     in.pressure[e.corner[2][k]]) *
                    (1. / 3);
  int flat = 0, yielding = 0;
#pragma omp simd reduction(+ : flat, yielding)
  for (std::size_t k = 0; k < kLanes; ++k) {
    const double d1x = c.x[1][k] - c.x[0][k], d1y = c.y[1][k] - c.y[0][k];
    const double d2x = c.x[2][k] - c.x[0][k], d2y = c.y[2][k] - c.y[0][k];
    const Matrix2 f = deformationGradient(d1x, d1y, d2x, d2y, s.edges[0][k], s.edges[1][k],
                                          s.edges[2][k], s.edges[3][k]);
    double thickness = s.thickness[k];
    if constexpr (kPlane) thickness = elasticThickness(f, thickness, moduli);
    const ElasticTrial t(f, thickness);
    flat += t.volume > tolerance::kFlat ? 0 : 1;  // also for NaN
    double mean = 0;
    if constexpr (kNodal)
      mean = pressure[k] * t.volume;
    else
      mean = meanStress(t.volume, moduli.bulk);
    out.squaredMises[k] = t.squaredMises();
    double yield = w.yield[k], limit = std::numeric_limits<double>::infinity();
    if constexpr (kCone) {
      const double inverse =
          e.inverseEdges[0][k] * e.inverseEdges[3][k] - e.inverseEdges[1][k] * e.inverseEdges[2][k];
      w.size[k] = (d1x * d2y - d1y * d2x) * inverse;
      yield = std::max(0., yield * w.size[k] - slope * mean), limit = most * w.size[k];
    }
    double over = squaredShear * out.squaredMises[k] - yield * yield;
    if constexpr (kCone) over = mean > limit ? 1 : over;
    if constexpr (kCone && kNodal) over = std::max(over, w.opening[k]);
    over = t.volume > 0 ? over : 0;  // an inverted one is refused
    w.over[k] = over;
    yielding += over > 0 ? 1 : 0;
    out.mean[k] = mean, out.volume[k] = t.volume;
    out.zx[k] = t.zx, out.zy[k] = t.zy, out.wx[k] = t.wx, out.wy[k] = t.wy;
    out.inverseZ[k] = t.inverseZ, out.part[k] = t.part, out.across[k] = t.across;
    out.kept[k] = 1;
  }
  return {flat, yielding};
}

/// Replaces the corners' coordinates by their forces −V τ ∇N, with the present gradients ∇N.
[[gnu::always_inline]] inline void forcesOfLanes(const ElementLanes& e, double shear,
                                                 const TrialLanes& t, Corners& c) {
#pragma omp simd
  for (std::size_t k = 0; k < kLanes; ++k) {
    const double d1x = c.x[1][k] - c.x[0][k], d1y = c.y[1][k] - c.y[0][k];
    const double d2x = c.x[2][k] - c.x[0][k], d2y = c.y[2][k] - c.y[0][k];
    const double scale = e.volume[k] / (d1x * d2y - d1y * d2x);
    const double middle = t.mean[k] - shear * t.kept[k] * t.across[k] / 3;
    const double by = shear * t.kept[k] * t.part[k] * t.inverseZ[k];
    const double half = by * (t.wx[k] * t.zx[k] - t.wy[k] * t.zy[k]);
    const double xy = scale * by * (t.wx[k] * t.zy[k] + t.wy[k] * t.zx[k]);
    const double xx = scale * (middle + half), yy = scale * (middle - half);
    const double f1x = -(xx * d2y - xy * d2x), f1y = -(xy * d2y - yy * d2x);
    const double f2x = xx * d1y - xy * d1x, f2y = xy * d1y - yy * d1x;
    c.x[0][k] = -(f1x + f2x);
    c.y[0][k] = -(f1y + f2y);
    c.x[1][k] = f1x;
    c.y[1][k] = f1y;
    c.x[2][k] = f2x;
    c.y[2][k] = f2y;
  }
}

}  // namespace yadefrag
