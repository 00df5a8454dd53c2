#include "elements/element_kernel.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/tolerances/dynamics.hpp"
#include "elements/elastic_law.hpp"
#include "elements/lane_corners.hpp"

namespace yadefrag {
namespace {

/// Replaces the corners' coordinates by their forces. `laws`: laws of the lanes, if `kMixed`;
/// `hoops`: if `kHoop`.
template <bool kWatched, bool kMixed, bool kHoop>
[[gnu::always_inline]] inline Findings elasticForces(const ElementLanes& e, const Chunk& chunk,
                                                     const ElementLaws* laws,
                                                     const ElementHoops* hoops,
                                                     Corners<kLanes>& c) {
  const double chunkLame = chunk.lame;
  const double chunkShear = chunk.shear;
  const StressLimit limit(chunk.shearFactor, chunk.friction, chunk.squaredStressLimit);
  int flat = 0;
  int stressed = 0;
#pragma omp simd reduction(+ : flat, stressed)
  for (std::size_t k = 0; k < kLanes; ++k) {
    double lame = chunkLame, shear = chunkShear;
    if constexpr (kMixed) lame = laws->lame[k], shear = laws->shear[k];
    const double i11 = e.inverseEdges[0][k];
    const double i12 = e.inverseEdges[1][k];
    const double i21 = e.inverseEdges[2][k];
    const double i22 = e.inverseEdges[3][k];
    const Matrix2 f = c.gradient(e.inverseEdges, k);
    const double v = e.volume[k];
    double size = determinant(f), h = 0;
    if constexpr (kHoop) {
      h = c.sumOfX(k) * hoops->inverse[k] - 1;
      size *= 1 + h;
    }
    flat += size > tolerance::kFlat ? 0 : 1;  // also for NaN
    if constexpr (kWatched)
      stressed += isStressed(f, lame, shear, limit, kHoop ? lame * h : -0.) ? 1 : 0;
    const HoopStress stress =
        kHoop ? hoopStress(f, h, lame, shear) : HoopStress{firstPiola(f, lame, shear), 0};
    const Matrix2& p = stress.plane;
    const double f1x = -v * (p.xx * i11 + p.xy * i12);
    const double f1y = -v * (p.yx * i11 + p.yy * i12);
    const double f2x = -v * (p.xx * i21 + p.xy * i22);
    const double f2y = -v * (p.yx * i21 + p.yy * i22);
    c.setForces(k, f1x, f1y, f2x, f2y);
    if constexpr (kHoop) c.pullInwards(k, v * stress.hoop * hoops->inverse[k]);
  }
  return {flat, stressed};
}

template <bool kWatched, bool kMixed, bool kHoop>
struct AddForces {
  const Chunk& chunk;
  const ElementLanes* lanes;
  const ElementLaws* laws;
  const ElementHoops* hoops;
  const Vec2* position;
  Vec2* force;
  StressedLanes& stressed;

  [[gnu::always_inline]] bool operator()() const {
    const auto add = [this](std::uint32_t l, Corners<kLanes> & corners)
        __attribute__((always_inline)) {
      const ElementLaws* own = kMixed ? laws + (l - chunk.firstLanes) : nullptr;
      const ElementHoops* round = kHoop ? hoops + l : nullptr;
      const Findings found =
          elasticForces<kWatched, kMixed, kHoop>(lanes[l], chunk, own, round, corners);
      scatter(lanes[l], corners, force);
      return found;
    };
    return forEachLanes<kWatched>(chunk, lanes, position, stressed, add);
  }
};

template <bool kWatched>
bool addForces(InstructionSet set, const Chunk& chunk, const ElementLanes* lanes,
               const ElementLaws* laws, const ElementHoops* hoops, const Vec2* position,
               Vec2* force, StressedLanes& stressed) {
  const auto run = [&]<bool kMixed, bool kHoop>() {
    return runFor(set, AddForces<kWatched, kMixed, kHoop>{chunk, lanes, laws, hoops, position,
                                                          force, stressed});
  };
  if (hoops != nullptr)
    return chunk.isMixed ? run.template operator()<true, true>()
                         : run.template operator()<false, true>();
  return chunk.isMixed ? run.template operator()<true, false>()
                       : run.template operator()<false, false>();
}

}  // namespace

bool addElasticForces(InstructionSet set, const Chunk& chunk, const ElementLanes* lanes,
                      const ElementLaws* laws, const ElementHoops* hoops, const Vec2* position,
                      Vec2* force, std::vector<ElementRange>& stressed) {
  StressedLanes found;
  if (!std::isfinite(chunk.squaredStressLimit))
    return addForces<false>(set, chunk, lanes, laws, hoops, position, force, found);
  const bool good = addForces<true>(set, chunk, lanes, laws, hoops, position, force, found);
  found.appendTo(stressed, chunk);
  return good;
}

void addViscousForces(const BulkViscosity& viscosity, const Chunk& chunk, const ElementLanes* lanes,
                      const ElementLaws* laws, bool axisymmetric, const Vec2* position,
                      const Vec2* velocity, Vec2* force) {
  double density = chunk.density, waveSpeed = chunk.waveSpeed;
  for (std::uint32_t e = 0; e < chunk.lastElement - chunk.firstElement; ++e) {
    const ElementLanes& l = lanes[chunk.firstLanes + e / kLanes];
    const std::size_t k = e % kLanes;
    if (chunk.isMixed) {
      const ElementLaws& own = laws[e / kLanes];
      density = own.density[k];
      waveSpeed = std::sqrt((own.lame[k] + 2 * own.shear[k]) / density);
    }
    const std::uint16_t corner[3] = {l.corner[0][k], l.corner[1][k], l.corner[2][k]};
    const Vec2 a = position[corner[0]];
    const Vec2 b = position[corner[1]];
    const Vec2 c = position[corner[2]];
    // 2·area·∇Nᵢ: the opposite edge, rotated to point inwards.
    const Vec2 gradient[3] = {rightOf(b - c), rightOf(c - a), rightOf(a - b)};
    const double twiceArea = cross(b - a, c - a);
    const double longest =
        std::sqrt(std::max({dot(gradient[0], gradient[0]), dot(gradient[1], gradient[1]),
                            dot(gradient[2], gradient[2])}));
    const double length = twiceArea / longest;
    double rate = 0;
    for (int i = 0; i < 3; ++i) rate += dot(velocity[corner[i]], gradient[i]) / twiceArea;
    // With an axis, the strain along the circle belongs to the volume, and the circle is the depth.
    const double sum = axisymmetric ? a.x + b.x + c.x : 1;
    if (axisymmetric)
      rate += (velocity[corner[0]].x + velocity[corner[1]].x + velocity[corner[2]].x) / sum;
    const double squeezed = viscosity.quadratic * length * std::min(rate, 0.);
    const double tension =
        density * (viscosity.linear * waveSpeed * length * rate - squeezed * squeezed);
    const double depth = axisymmetric ? 2 * std::numbers::pi / 3 * sum : chunk.thickness;
    for (int i = 0; i < 3; ++i) force[corner[i]] -= tension * depth / 2 * gradient[i];
    if (!axisymmetric) continue;
    const double pull = tension * depth / 2 * twiceArea / sum;
    for (const std::uint16_t i : corner) force[i].x -= pull;
  }
}

}  // namespace yadefrag
