#include "elements/strain_smoothing.hpp"

#include <cmath>

#include "core/tolerances/dynamics.hpp"
#include "elements/elastic_law.hpp"
#include "elements/lane_corners.hpp"

namespace yadefrag {
namespace {

template <bool kWatched>
[[gnu::always_inline]] inline Findings splitGradients(const ElementLanes& e, const Chunk& chunk,
                                                      const Corners<kLanes>& c,
                                                      DistortionLanes& kept,
                                                      SplitGradient* weighted) {
  const StressLimit limit(chunk.shearFactor, chunk.friction, chunk.squaredStressLimit);
  int flat = 0;
  int stressed = 0;
#pragma omp simd reduction(+ : flat, stressed)
  for (std::size_t k = 0; k < kLanes; ++k) {
    const Matrix2 f = c.gradient(e.inverseEdges, k);
    flat += determinant(f) > tolerance::kFlat ? 0 : 1;  // also for NaN
    if constexpr (kWatched) stressed += isStressed(f, chunk.lame, chunk.shear, limit) ? 1 : 0;
    const double third = e.volume[k] * (1. / 3);
    const double c1 = f.xx - f.yy;
    const double c2 = f.yx + f.xy;
    kept.part[0][k] = c1;
    kept.part[1][k] = c2;
    weighted[k].part[0] = third * (f.xx + f.yy);
    weighted[k].part[1] = third * (f.yx - f.xy);
    weighted[k].part[2] = third * c1;
    weighted[k].part[3] = third * c2;
  }
  return {flat, stressed};
}

template <bool kWatched>
struct SumGradients {
  const Chunk& chunk;
  const ElementLanes* lanes;
  const Vec2* position;
  DistortionLanes* kept;
  SplitGradient* nodes;
  StressedLanes& stressed;

  [[gnu::always_inline]] bool operator()() const {
    alignas(64) SplitGradient weighted[kLanes];
    const auto sum = [&](std::uint32_t l, const Corners<kLanes>& corners)
        __attribute__((always_inline)) {
      const Findings found = splitGradients<kWatched>(lanes[l], chunk, corners, kept[l], weighted);
      for (const auto& corner : lanes[l].corner)
        for (std::size_t k = 0; k < kLanes; ++k) nodes[corner[k]] += weighted[k];
      return found;
    };
    return forEachLanes<kWatched>(chunk, lanes, position, stressed, sum);
  }
};

struct StressNodes {
  const Chunk& chunk;
  const double* mass;
  NodeFactors factors;
  SplitGradient* nodes;

  [[gnu::always_inline]] void operator()() const {
    const std::size_t count = chunk.lastNode - chunk.firstNode;
    for (std::size_t n = 0; n < count; ++n) {
      const double* part = nodes[n].part;
      factors.similar[n] = part[0] * part[0] + part[1] * part[1];
    }
    // With the sum A = Σa, the stress is κ(|⟨a⟩| − 2)⟨a⟩/|⟨a⟩| = κ(ρ/m − 2/|A|) A, as V = m/ρ.
    const double third = 1. / 3;
    const double bulk = third * (chunk.lame + chunk.shear);
    const double shear = third * kSmoothedShare * chunk.shear;
    const double density = chunk.density;
#pragma omp simd
    for (std::size_t n = 0; n < count; ++n) {
      const double m = mass[n];
      const double length = std::sqrt(factors.similar[n]);
      const double inverse = 1 / (m * length);
      const double similar = bulk * (density * length - 2 * m) * inverse;
      const double distorted = shear * (density * length) * inverse;
      factors.similar[n] = m > 0 ? similar : 0;
      factors.distorted[n] = m > 0 ? distorted : 0;
    }
    for (std::size_t n = 0; n < count; ++n) {
      const double s = factors.similar[n];
      const double d = factors.distorted[n];
      const double by[4] = {s, s, d, d};
      for (int j = 0; j < 4; ++j) nodes[n].part[j] *= by[j];
    }
  }
};

struct AddForces {
  const Chunk& chunk;
  const ElementLanes* lanes;
  const DistortionLanes* kept;
  const SplitGradient* nodes;
  Vec2* force;

  [[gnu::always_inline]] void operator()() const {
    Corners<kLanes> c;
    alignas(64) SplitGradient stress[kLanes];
    const double own = (1 - kSmoothedShare) * chunk.shear;
    for (std::uint32_t l = chunk.firstLanes; l < chunk.lastLanes; ++l) {
      const ElementLanes& e = lanes[l];
      for (std::size_t k = 0; k < kLanes; ++k) {
        const double* n0 = nodes[e.corner[0][k]].part;
        const double* n1 = nodes[e.corner[1][k]].part;
        const double* n2 = nodes[e.corner[2][k]].part;
        for (int j = 0; j < 4; ++j) stress[k].part[j] = n0[j] + n1[j] + n2[j];
      }
#pragma omp simd
      for (std::size_t k = 0; k < kLanes; ++k) {
        const double v = e.volume[k];
        const double s1 = v * stress[k].part[0];
        const double s2 = v * stress[k].part[1];
        const double d1 = v * (stress[k].part[2] + own * kept[l].part[0][k]);
        const double d2 = v * (stress[k].part[3] + own * kept[l].part[1][k]);
        // V P, from P = ∂W/∂F.
        const double xx = s1 + d1;
        const double yy = s1 - d1;
        const double yx = d2 + s2;
        const double xy = d2 - s2;
        const double f1x = -(xx * e.inverseEdges[0][k] + xy * e.inverseEdges[1][k]);
        const double f1y = -(yx * e.inverseEdges[0][k] + yy * e.inverseEdges[1][k]);
        const double f2x = -(xx * e.inverseEdges[2][k] + xy * e.inverseEdges[3][k]);
        const double f2y = -(yx * e.inverseEdges[2][k] + yy * e.inverseEdges[3][k]);
        c.setForces(k, f1x, f1y, f2x, f2y);
      }
      scatter(e, c, force);
    }
  }
};

}  // namespace

bool sumGradients(InstructionSet set, const Chunk& chunk, const ElementLanes* lanes,
                  const Vec2* position, DistortionLanes* kept, SplitGradient* nodes,
                  std::vector<ElementRange>& stressed) {
  StressedLanes found;
  if (!std::isfinite(chunk.squaredStressLimit))
    return runFor(set, SumGradients<false>{chunk, lanes, position, kept, nodes, found});
  const bool good = runFor(set, SumGradients<true>{chunk, lanes, position, kept, nodes, found});
  found.appendTo(stressed, chunk);
  return good;
}

void stressNodes(InstructionSet set, const Chunk& chunk, const double* mass, NodeFactors factors,
                 SplitGradient* nodes) {
  runFor(set, StressNodes{chunk, mass, factors, nodes});
}

void addSmoothedForces(InstructionSet set, const Chunk& chunk, const ElementLanes* lanes,
                       const DistortionLanes* kept, const SplitGradient* nodes, Vec2* force) {
  runFor(set, AddForces{chunk, lanes, kept, nodes, force});
}

}  // namespace yadefrag
