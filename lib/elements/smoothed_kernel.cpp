#include "elements/strain_smoothing.hpp"

#include <cmath>

#include "core/tolerances/dynamics.hpp"
#include "elements/elastic_law.hpp"
#include "elements/lane_corners.hpp"

namespace yadefrag {
namespace {

/// With an axis, `weighted` are not thirds, and `around` are strains along its circle.
template <bool kWatched, bool kHoop>
[[gnu::always_inline]] inline Findings splitGradients(const ElementLanes& e,
                                                      const ElementHoops* hoops, const Chunk& chunk,
                                                      const Corners<kLanes>& c,
                                                      DistortionLanes& kept,
                                                      SplitGradient* weighted, double* around) {
  const StressLimit limit(chunk.shearFactor, chunk.friction, chunk.squaredStressLimit);
  int flat = 0;
  int stressed = 0;
#pragma omp simd reduction(+ : flat, stressed)
  for (std::size_t k = 0; k < kLanes; ++k) {
    const Matrix2 f = c.gradient(e.inverseEdges, k);
    double size = determinant(f), further = -0.;
    if constexpr (kHoop) {
      around[k] = c.sumOfX(k) * hoops->inverse[k] - 1;
      further = chunk.lame * around[k], size *= 1 + around[k];
    }
    flat += size > tolerance::kFlat ? 0 : 1;  // also for NaN
    if constexpr (kWatched)
      stressed += isStressed(f, chunk.lame, chunk.shear, limit, further) ? 1 : 0;
    const double third = kHoop ? e.volume[k] : e.volume[k] * (1. / 3);
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

template <bool kWatched, bool kHoop>
struct SumGradients {
  const Chunk& chunk;
  const ElementLanes* lanes;
  const ElementHoops* hoops;
  const Vec2* position;
  DistortionLanes* kept;
  SmoothedNodes nodes;
  StressedLanes& stressed;

  [[gnu::always_inline]] bool operator()() const {
    alignas(64) SplitGradient weighted[kLanes];
    alignas(64) double around[kLanes];
    const auto sum = [&](std::uint32_t l, const Corners<kLanes>& corners)
        __attribute__((always_inline)) {
      const ElementHoops* round = kHoop ? hoops + l : nullptr;
      const Findings found = splitGradients<kWatched, kHoop>(lanes[l], round, chunk, corners,
                                                             kept[l], weighted, around);
      for (int i = 0; i < 3; ++i)
        for (std::size_t k = 0; k < kLanes; ++k) {
          const std::uint16_t node = lanes[l].corner[i][k];
          if constexpr (kHoop) {
            const double share = round->share[i][k];
            nodes.gradient[node] += share * weighted[k];
            nodes.around[node] += share * lanes[l].volume[k] * around[k];
          } else {
            nodes.gradient[node] += weighted[k];
          }
        }
      return found;
    };
    return forEachLanes<kWatched>(chunk, lanes, position, stressed, sum);
  }
};

template <bool kHoop>
struct StressNodes {
  const Chunk& chunk;
  const double* mass;
  NodeFactors factors;
  SmoothedNodes nodes;

  [[gnu::always_inline]] void operator()() const {
    const std::size_t count = chunk.lastNode - chunk.firstNode;
    for (std::size_t n = 0; n < count; ++n) {
      const double* part = nodes.gradient[n].part;
      factors.similar[n] = part[0] * part[0] + part[1] * part[1];
    }
    // With the sum A = Σa, the stress is κ(|⟨a⟩| − 2)⟨a⟩/|⟨a⟩| = κ(ρ/m − 2/|A|) A, as V = m/ρ.
    const double third = kHoop ? 1 : 1. / 3;
    const double bulk = third * (chunk.lame + chunk.shear);
    const double shear = third * kSmoothedShare * chunk.shear;
    const double density = chunk.density;
    if constexpr (kHoop) stressAround(count);
#pragma omp simd
    for (std::size_t n = 0; n < count; ++n) {
      const double m = mass[n];
      const double length = std::sqrt(factors.similar[n]);
      const double inverse = 1 / (m * length);
      double similar = bulk * (density * length - 2 * m) * inverse;
      if constexpr (kHoop) similar += factors.distorted[n];
      const double distorted = shear * (density * length) * inverse;
      factors.similar[n] = m > 0 ? similar : 0;
      factors.distorted[n] = m > 0 ? distorted : 0;
    }
    for (std::size_t n = 0; n < count; ++n) {
      const double s = factors.similar[n];
      const double d = factors.distorted[n];
      const double by[4] = {s, s, d, d};
      for (int j = 0; j < 4; ++j) nodes.gradient[n].part[j] *= by[j];
    }
  }

 private:
  /// Pθ = λ(|⟨a⟩| − 2 + ⟨h⟩) + 2μ⟨h⟩ in place of the sum of h, and the part of ⟨h⟩ in the mean
  /// stress.
  [[gnu::always_inline]] void stressAround(std::size_t count) const {
    const double lame = chunk.lame, twice = 2 * chunk.shear, density = chunk.density;
    double* const around = nodes.around;
#pragma omp simd
    for (std::size_t n = 0; n < count; ++n) {
      const double m = mass[n];
      const double length = std::sqrt(factors.similar[n]);
      const double strain = density * around[n] / m;
      const double stress = lame * (density * length / m - 2 + strain) + twice * strain;
      factors.distorted[n] = lame * strain / length;
      around[n] = m > 0 ? stress : 0;
    }
  }
};

template <bool kHoop>
struct AddForces {
  const Chunk& chunk;
  const ElementLanes* lanes;
  const ElementHoops* hoops;
  const DistortionLanes* kept;
  SmoothedNodes nodes;
  Vec2* force;

  [[gnu::always_inline]] void operator()() const {
    Corners<kLanes> c;
    alignas(64) SplitGradient stress[kLanes];
    alignas(64) double pull[kLanes];
    const double own = (1 - kSmoothedShare) * chunk.shear;
    for (std::uint32_t l = chunk.firstLanes; l < chunk.lastLanes; ++l) {
      const ElementLanes& e = lanes[l];
      for (std::size_t k = 0; k < kLanes; ++k) {
        const std::uint16_t c0 = e.corner[0][k], c1 = e.corner[1][k], c2 = e.corner[2][k];
        const double* n0 = nodes.gradient[c0].part;
        const double* n1 = nodes.gradient[c1].part;
        const double* n2 = nodes.gradient[c2].part;
        if constexpr (kHoop) {
          const ElementHoops& h = hoops[l];
          const double s0 = h.share[0][k], s1 = h.share[1][k], s2 = h.share[2][k];
          for (int j = 0; j < 4; ++j) stress[k].part[j] = s0 * n0[j] + s1 * n1[j] + s2 * n2[j];
          pull[k] = e.volume[k] * h.inverse[k] *
                    (s0 * nodes.around[c0] + s1 * nodes.around[c1] + s2 * nodes.around[c2]);
        } else {
          for (int j = 0; j < 4; ++j) stress[k].part[j] = n0[j] + n1[j] + n2[j];
        }
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
        if constexpr (kHoop) c.pullInwards(k, pull[k]);
      }
      scatter(e, c, force);
    }
  }
};

}  // namespace

bool sumGradients(InstructionSet set, const Chunk& chunk, const ElementLanes* lanes,
                  const ElementHoops* hoops, const Vec2* position, DistortionLanes* kept,
                  SmoothedNodes nodes, std::vector<ElementRange>& stressed) {
  StressedLanes found;
  const auto run = [&]<bool kWatched>() {
    if (hoops == nullptr)
      return runFor(
          set, SumGradients<kWatched, false>{chunk, lanes, hoops, position, kept, nodes, found});
    return runFor(set,
                  SumGradients<kWatched, true>{chunk, lanes, hoops, position, kept, nodes, found});
  };
  if (!std::isfinite(chunk.squaredStressLimit)) return run.template operator()<false>();
  const bool good = run.template operator()<true>();
  found.appendTo(stressed, chunk);
  return good;
}

void stressNodes(InstructionSet set, const Chunk& chunk, const double* mass, NodeFactors factors,
                 SmoothedNodes nodes) {
  if (nodes.around == nullptr) return runFor(set, StressNodes<false>{chunk, mass, factors, nodes});
  runFor(set, StressNodes<true>{chunk, mass, factors, nodes});
}

void addSmoothedForces(InstructionSet set, const Chunk& chunk, const ElementLanes* lanes,
                       const ElementHoops* hoops, const DistortionLanes* kept, SmoothedNodes nodes,
                       Vec2* force) {
  if (hoops == nullptr)
    return runFor(set, AddForces<false>{chunk, lanes, hoops, kept, nodes, force});
  runFor(set, AddForces<true>{chunk, lanes, hoops, kept, nodes, force});
}

}  // namespace yadefrag
