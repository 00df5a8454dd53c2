#include "dynamics/element_kernel.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/tolerances.hpp"
#include "dynamics/elastic_law.hpp"

namespace yadefrag {
namespace {

/// Coordinates, then forces, of the corners of kLanes elements.
struct alignas(64) Corners {
  double x[3][kLanes];
  double y[3][kLanes];
};

[[gnu::always_inline]] inline void gather(const ElementLanes& lanes, const Vec2* values,
                                          Corners& corners) {
  for (int i = 0; i < 3; ++i)
    for (std::size_t k = 0; k < kLanes; ++k) {
      const Vec2 value = values[lanes.corner[i][k]];
      corners.x[i][k] = value.x;
      corners.y[i][k] = value.y;
    }
}

[[gnu::always_inline]] inline void scatter(const ElementLanes& lanes, const Corners& corners,
                                           Vec2* force) {
  for (std::size_t k = 0; k < kLanes; ++k)
    for (int i = 0; i < 3; ++i) {
      Vec2& f = force[lanes.corner[i][k]];
      f.x += corners.x[i][k];
      f.y += corners.y[i][k];
    }
}

/// Numbers of lanes that hold a stressed element.
struct StressedLanes {
  std::array<std::uint32_t, tolerance::kChunkElements / kLanes> lanes;
  std::size_t count = 0;
};

/// Bad and stressed elements among kLanes.
struct Findings {
  int bad = 0, stressed = 0;
};

/// Replaces the corners' coordinates by their forces.
template <bool kWatched>
[[gnu::always_inline]] inline Findings elasticForces(const ElementLanes& e, const Chunk& chunk,
                                                     Corners& c) {
  const double lame = chunk.lame;
  const double shear = chunk.shear;
  const StressLook look{1 / (chunk.shearFactor * chunk.shearFactor), chunk.friction,
                        std::sqrt(1 + chunk.friction * chunk.friction), chunk.squaredLook};
  int bad = 0;
  int stressed = 0;
#pragma omp simd reduction(+ : bad, stressed)
  for (std::size_t k = 0; k < kLanes; ++k) {
    const double i11 = e.inverseEdges[0][k];
    const double i12 = e.inverseEdges[1][k];
    const double i21 = e.inverseEdges[2][k];
    const double i22 = e.inverseEdges[3][k];
    const Matrix2 f = deformationGradient(c.x[1][k] - c.x[0][k], c.y[1][k] - c.y[0][k],
                                          c.x[2][k] - c.x[0][k], c.y[2][k] - c.y[0][k],  //
                                          i11, i12, i21, i22);
    bad += determinant(f) > 0 ? 0 : 1;  // NaN too
    if constexpr (kWatched) stressed += isStressed(f, lame, shear, look) ? 1 : 0;
    const Matrix2 p = firstPiola(f, lame, shear);
    const double v = e.volume[k];
    const double f1x = -v * (p.xx * i11 + p.xy * i12);
    const double f1y = -v * (p.yx * i11 + p.yy * i12);
    const double f2x = -v * (p.xx * i21 + p.xy * i22);
    const double f2y = -v * (p.yx * i21 + p.yy * i22);
    c.x[0][k] = -(f1x + f2x);
    c.y[0][k] = -(f1y + f2y);
    c.x[1][k] = f1x;
    c.y[1][k] = f1y;
    c.x[2][k] = f2x;
    c.y[2][k] = f2y;
  }
  return {bad, stressed};
}

/// Everything about one chunk and where its forces go, by local node number.
struct Job {
  const Chunk& chunk;
  const ElementLanes* lanes;
  const Vec2* position;
  Vec2* force;
};

template <bool kWatched>
[[gnu::always_inline]] inline bool addChunk(const Job& job, StressedLanes& stressed) {
  int bad = 0;
  Corners corners;
  for (std::uint32_t l = job.chunk.firstLanes; l < job.chunk.lastLanes; ++l) {
    gather(job.lanes[l], job.position, corners);
    const Findings found = elasticForces<kWatched>(job.lanes[l], job.chunk, corners);
    bad += found.bad;
    if constexpr (kWatched) {
      // No branch to be foretold wrongly: what is not counted is overwritten.
      stressed.lanes[stressed.count] = l;
      stressed.count += found.stressed != 0 ? 1 : 0;
    }
    scatter(job.lanes[l], corners, job.force);
  }
  return bad == 0;
}

template <bool kWatched>
bool addBaseline(const Job& job, StressedLanes& stressed) {
  return addChunk<kWatched>(job, stressed);
}

#ifdef __x86_64__
template <bool kWatched>
[[gnu::target("avx2")]] bool addAvx2(const Job& job, StressedLanes& stressed) {
  return addChunk<kWatched>(job, stressed);
}
#endif

template <bool kWatched>
bool add(InstructionSet set, const Job& job, StressedLanes& stressed) {
#ifdef __x86_64__
  if (set == InstructionSet::kAvx2) return addAvx2<kWatched>(job, stressed);
#endif
  static_cast<void>(set);
  return addBaseline<kWatched>(job, stressed);
}

}  // namespace

InstructionSet bestInstructionSet() {
#ifdef __x86_64__
  if (__builtin_cpu_supports("avx2")) return InstructionSet::kAvx2;
#endif
  return InstructionSet::kBaseline;
}

bool addElasticForces(InstructionSet set, const Chunk& chunk, const ElementLanes* lanes,
                      const Vec2* position, Vec2* force) {
  StressedLanes none;
  return add<false>(set, {chunk, lanes, position, force}, none);
}

bool addElasticForces(InstructionSet set, const Chunk& chunk, const ElementLanes* lanes,
                      const Vec2* position, Vec2* force, std::vector<ElementRange>& stressed) {
  StressedLanes found;
  const bool good = add<true>(set, {chunk, lanes, position, force}, found);
  for (std::size_t i = 0; i < found.count; ++i) {
    const auto first = static_cast<std::uint32_t>(chunk.firstElement +
                                                  kLanes * (found.lanes[i] - chunk.firstLanes));
    const auto end = static_cast<std::uint32_t>(first + kLanes);
    stressed.push_back({first, std::min(end, chunk.lastElement)});
  }
  return good;
}

void addViscousForces(const BulkViscosity& viscosity, const Chunk& chunk, const ElementLanes* lanes,
                      const Vec2* position, const Vec2* velocity, Vec2* force) {
  for (std::uint32_t e = 0; e < chunk.lastElement - chunk.firstElement; ++e) {
    const ElementLanes& l = lanes[chunk.firstLanes + e / kLanes];
    const std::size_t k = e % kLanes;
    const std::uint16_t corner[3] = {l.corner[0][k], l.corner[1][k], l.corner[2][k]};
    const Vec2 a = position[corner[0]];
    const Vec2 b = position[corner[1]];
    const Vec2 c = position[corner[2]];
    // 2·area·∇Nᵢ: the opposite edge, turned inward.
    const Vec2 gradient[3] = {rightOf(b - c), rightOf(c - a), rightOf(a - b)};
    const double twiceArea = cross(b - a, c - a);
    const double longest =
        std::sqrt(std::max({dot(gradient[0], gradient[0]), dot(gradient[1], gradient[1]),
                            dot(gradient[2], gradient[2])}));
    const double length = twiceArea / longest;
    double rate = 0;
    for (int i = 0; i < 3; ++i) rate += dot(velocity[corner[i]], gradient[i]) / twiceArea;
    const double squeezed = viscosity.quadratic * length * std::min(rate, 0.);
    const double tension =
        chunk.density * (viscosity.linear * chunk.waveSpeed * length * rate - squeezed * squeezed);
    for (int i = 0; i < 3; ++i) force[corner[i]] -= tension * chunk.thickness / 2 * gradient[i];
  }
}

}  // namespace yadefrag
