#include "dynamics/plastic_kernel.hpp"

#include <algorithm>
#include <cmath>

#include "core/tolerances/dynamics.hpp"
#include "core/tolerances/plasticity.hpp"
#include "dynamics/lane_corners.hpp"

namespace yadefrag {
namespace {

/// State of kLanes elements; lanes after the chunk's last element repeat that element.
struct alignas(64) StateLanes {
  double edges[4][kLanes], thickness[kLanes], yield[kLanes];

  [[gnu::always_inline]] StateLanes(const PlasticChunk& in, std::uint32_t first,
                                    std::uint32_t end) {
    if (first + kLanes <= end) {
      for (std::size_t i = 0; i < 4; ++i) std::copy_n(in.edges[i] + first, kLanes, edges[i]);
      std::copy_n(in.thickness + first, kLanes, thickness);
      std::copy_n(in.yield + first, kLanes, yield);
      return;
    }
    for (std::uint32_t k = 0; k < kLanes; ++k) {
      const std::uint32_t e = std::min(first + k, end - 1);
      for (std::size_t i = 0; i < 4; ++i) edges[i][k] = in.edges[i][e];
      thickness[k] = in.thickness[e], yield[k] = in.yield[e];
    }
  }
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

template <bool kPlane, bool kNodal>
[[gnu::always_inline]] inline Trials tryLanes(const ElementLanes& e, const PlasticChunk& in,
                                              const StateLanes& s, const Corners& c,
                                              double* squaredOver, TrialLanes& out) {
  const SolidModuli moduli = in.moduli;
  const double squaredShear = moduli.shear * moduli.shear;
  const double slope = in.slope, limit = in.tensionLimit;
  alignas(64) double pressure[kLanes];
  if constexpr (kNodal)
    for (std::size_t k = 0; k < kLanes; ++k)
      pressure[k] = (in.pressure[e.corner[0][k]] + in.pressure[e.corner[1][k]] +
                     in.pressure[e.corner[2][k]]) *
                    (1. / 3);
  int flat = 0, yielding = 0;
#pragma omp simd reduction(+ : flat, yielding)
  for (std::size_t k = 0; k < kLanes; ++k) {
    const Matrix2 f = deformationGradient(
        c.x[1][k] - c.x[0][k], c.y[1][k] - c.y[0][k], c.x[2][k] - c.x[0][k], c.y[2][k] - c.y[0][k],
        s.edges[0][k], s.edges[1][k], s.edges[2][k], s.edges[3][k]);
    double thickness = s.thickness[k];
    if constexpr (kPlane) thickness = elasticThickness(f, thickness, moduli);
    const ElasticTrial t(f, thickness);
    flat += t.volume > tolerance::kFlat ? 0 : 1;  // also for NaN
    double mean = 0;
    if constexpr (kNodal)
      mean = pressure[k] * t.volume;
    else
      mean = meanStress(t.volume, moduli.bulk);
    const double yield = std::max(0., s.yield[k] - slope * mean);
    const double over = mean > limit ? 1 : squaredShear * t.squaredMises() - yield * yield;
    squaredOver[k] = over;
    yielding += over > 0 ? 1 : 0;
    out.mean[k] = mean, out.volume[k] = t.volume;
    out.zx[k] = t.zx, out.zy[k] = t.zy, out.wx[k] = t.wx, out.wy[k] = t.wy;
    out.squaredZ[k] = t.squaredZ, out.part[k] = t.part, out.across[k] = t.across;
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
    const double by = shear * t.kept[k] * t.part[k] / t.squaredZ[k];
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

template <bool kPlane, bool kNodal>
struct AddForces {
  const Chunk& chunk;
  const ElementLanes* lanes;
  const PlasticChunk& in;
  const Vec2* position;
  LaneReturn& flow;
  Vec2* force;

  [[gnu::always_inline]] bool operator()() const {
    int flat = 0;
    Corners corners;
    TrialLanes trial;
    alignas(64) double over[kLanes];
    std::uint32_t first = chunk.firstElement;
    for (std::uint32_t l = chunk.firstLanes; l < chunk.lastLanes; ++l, first += kLanes) {
      gather(lanes[l], position, corners);
      const StateLanes state(in, first, chunk.lastElement);
      const Trials found = tryLanes<kPlane, kNodal>(lanes[l], in, state, corners, over, trial);
      flat += found.flat;
      if (found.yielding != 0 && found.flat == 0) {
        std::array<bool, kLanes> yields;
        for (std::size_t k = 0; k < kLanes; ++k)
          yields[k] = over[k] > 0 && first + k < chunk.lastElement;
        flow(first, lanes[l].corner, yields, trial);
      }
      forcesOfLanes(lanes[l], in.moduli.shear, trial, corners);
      scatter(lanes[l], corners, force);
    }
    return flat == 0;
  }
};

struct SumVolumes {
  const Chunk& chunk;
  const ElementLanes* lanes;
  const PlasticChunk& in;
  const Vec2* position;
  double* nodes;

  [[gnu::always_inline]] void operator()() const {
    Corners c;
    alignas(64) double third[kLanes];
    std::uint32_t first = chunk.firstElement;
    for (std::uint32_t l = chunk.firstLanes; l < chunk.lastLanes; ++l, first += kLanes) {
      gather(lanes[l], position, c);
      const StateLanes s(in, first, chunk.lastElement);
#pragma omp simd
      for (std::size_t k = 0; k < kLanes; ++k) {
        const double d1x = c.x[1][k] - c.x[0][k], d1y = c.y[1][k] - c.y[0][k];
        const double d2x = c.x[2][k] - c.x[0][k], d2y = c.y[2][k] - c.y[0][k];
        const double inverse = s.edges[0][k] * s.edges[3][k] - s.edges[1][k] * s.edges[2][k];
        third[k] =
            lanes[l].volume[k] * (1. / 3) * s.thickness[k] * inverse * (d1x * d2y - d1y * d2x);
      }
      for (std::size_t k = 0; k < kLanes; ++k)
        for (const auto& corner : lanes[l].corner) nodes[corner[k]] += third[k];
    }
  }
};

}  // namespace

bool addPlasticForces(InstructionSet set, const Chunk& chunk, const ElementLanes* lanes,
                      const PlasticChunk& in, const Vec2* position, LaneReturn& flow, Vec2* force) {
  if (in.planeStress)
    return runFor(set, AddForces<true, false>{chunk, lanes, in, position, flow, force});
  if (in.pressure != nullptr)
    return runFor(set, AddForces<false, true>{chunk, lanes, in, position, flow, force});
  return runFor(set, AddForces<false, false>{chunk, lanes, in, position, flow, force});
}

void sumVolumes(InstructionSet set, const Chunk& chunk, const ElementLanes* lanes,
                const PlasticChunk& in, const Vec2* position, double* nodes) {
  runFor(set, SumVolumes{chunk, lanes, in, position, nodes});
}

}  // namespace yadefrag
