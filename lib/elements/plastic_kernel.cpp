#include "elements/plastic_kernel.hpp"

#include <algorithm>

#include "elements/plastic_lanes.hpp"

namespace yadefrag {
namespace {

using Kind = YieldConstants::Kind;

/// std::copy_n would call memmove.
[[gnu::always_inline]] inline void copyLanes(const double* from, double* to) {
#pragma omp simd
  for (std::size_t k = 0; k < kLanes; ++k) to[k] = from[k];
}

/// Copies values of elements to lanes and back; lanes after the last element repeat its value.
class Group {
 public:
  [[gnu::always_inline]] Group(const Chunk& chunk, std::size_t index)
      : lane(index),
        first(static_cast<std::uint32_t>(chunk.firstElement + kLanes * (lane - chunk.firstLanes))),
        count(std::min<std::uint32_t>(kLanes, chunk.lastElement - first)) {}

  [[gnu::always_inline]] void load(const double* values, double* lanes) const {
    if (count == kLanes)
      copyLanes(values + first, lanes);
    else
      for (std::uint32_t k = 0; k < kLanes; ++k) lanes[k] = values[first + std::min(k, count - 1)];
  }
  [[gnu::always_inline]] void store(const double* lanes, double* values) const {
    if (count == kLanes)
      copyLanes(lanes, values + first);
    else
      std::copy_n(lanes, count, values + first);
  }

  std::size_t lane;
  std::uint32_t first, count;
};

/// The stretch along the circle around the axis of a group, for corners from `at` on.
template <std::size_t W>
struct Hoops {
  const ElementHoops& hoops;
  const Corners<W>& c;
  std::size_t at;

  [[gnu::always_inline]] Hoops(const PlasticChunk& in, const Group& group,
                               const Corners<W>& corners, std::size_t first)
      : hoops(in.hoops[group.lane]), c(corners), at(first) {}
  [[gnu::always_inline]] double operator[](std::size_t k) const {
    return c.sumOfX(at + k) * hoops.inverse[k];
  }
};

/// A function of its own: inlined, it slows down the loops of plane bodies, by 2 %.
[[gnu::noinline]] void meansByMass(const ElementLanes& e, const ElementHoops& hoops,
                                   const double* nodes, double* lanes) {
  for (std::size_t k = 0; k < kLanes; ++k) {
    lanes[k] = 0;
    for (int i = 0; i < 3; ++i) lanes[k] += hoops.share[i][k] * nodes[e.corner[i][k]];
  }
}

/// Means by the corners' parts of the mass.
[[gnu::always_inline]] inline void meansOfNodes(const ElementLanes& e, const ElementHoops* hoops,
                                                const double* nodes, double* lanes) {
  if (hoops != nullptr) return meansByMass(e, *hoops, nodes, lanes);
  for (std::size_t k = 0; k < kLanes; ++k)
    lanes[k] = (nodes[e.corner[0][k]] + nodes[e.corner[1][k]] + nodes[e.corner[2][k]]) * (1. / 3);
}

/// What `tryLanes` needs of the group of lanes from `at` on.
template <bool kNodal, bool kCone, std::size_t W>
[[gnu::always_inline]] inline void loadLanes(const ElementLanes& e, const PlasticChunk& in,
                                             const Group& group, const Corners<W>& c,
                                             std::size_t at, FlowLanes<W>& w) {
  for (std::size_t i = 0; i < 4; ++i) group.load(in.edges[i], w.edges[i] + at);
  group.load(in.thickness, w.thickness + at);
  group.load(in.yield, w.yield + at);
  if constexpr (kNodal) meansOfNodes(e, in.hoopsOf(group.lane), in.pressure, w.pressure + at);
  if constexpr (kCone) {
#pragma omp simd
    for (std::size_t k = 0; k < kLanes; ++k) {
      const double inverse =
          e.inverseEdges[0][k] * e.inverseEdges[3][k] - e.inverseEdges[1][k] * e.inverseEdges[2][k];
      w.size[at + k] = c.twiceArea(at + k) * inverse;
      w.opening[at + k] = 0;
    }
  }
  if (in.hoops == nullptr) return;
  const Hoops<W> hoop(in, group, c, at);
  for (std::size_t k = 0; k < kLanes; ++k) {
    w.thickness[at + k] *= hoop[k];
    if constexpr (kCone) w.size[at + k] *= hoop[k];
  }
}

template <std::size_t W>
[[gnu::always_inline]] inline int countFlat(const FlowLanes<W>& w, std::size_t count) {
  int flat = 0;
  for (std::size_t k = 0; k < count; ++k)
    flat += w.trial.volume[k] > tolerance::kFlat ? 0 : 1;  // also for NaN
  return flat;
}

/// Replaces the corners' coordinates by their forces −V τ ∇N, with the present gradients ∇N, and
/// `hasAxis` towards the axis −V τθθ/(3r).
template <std::size_t W>
[[gnu::always_inline]] inline void forcesOfLanes(const ElementLanes& e, double shear, bool hasAxis,
                                                 const FlowLanes<W>& w, std::size_t at,
                                                 Corners<W>& c) {
  alignas(64) double pull[kLanes];
  if (hasAxis)
    for (std::size_t k = at; k < at + kLanes; ++k)
      pull[k - at] =
          e.volume[k - at] * stressAcross(w.trial[k], w.mean[k], w.kept[k], shear) / c.sumOfX(k);
#pragma omp simd
  for (std::size_t i = 0; i < kLanes; ++i) {
    const std::size_t k = at + i;
    const double d1x = c.x[1][k] - c.x[0][k], d1y = c.y[1][k] - c.y[0][k];
    const double d2x = c.x[2][k] - c.x[0][k], d2y = c.y[2][k] - c.y[0][k];
    const double scale = e.volume[i] / (d1x * d2y - d1y * d2x);
    const PlaneStress stress(w.trial[k], w.mean[k], w.kept[k], shear);
    const double xx = scale * stress.xx, yy = scale * stress.yy, xy = scale * stress.xy;
    c.setForces(k, -(xx * d2y - xy * d2x), -(xy * d2y - yy * d2x), xx * d1y - xy * d1x,
                xy * d1y - yy * d1x);
  }
  if (hasAxis)
    for (std::size_t k = 0; k < kLanes; ++k) c.pullInwards(at + k, pull[k]);
}

template <bool kPlane, bool kNodal, Kind kKind>
struct AddForces {
  static constexpr bool kCone = kKind == Kind::kCone;
  static constexpr std::size_t kBlock = kLanes * tolerance::kLaneBlock;

  const Chunk& chunk;
  const ElementLanes* lanes;
  const PlasticChunk& in;
  const Vec2* position;
  FlowRoom& room;
  Vec2* force;

  [[gnu::always_inline]] bool operator()() const {
    int flat = 0;
    Corners<kBlock> now, before;
    const ReturnInput<kBlock> input{in.constants, in.dt, now, before};
    FlowLanes<kBlock> w;
    Sums sums;
    for (std::uint32_t l = chunk.firstLanes; l < chunk.lastLanes; l += tolerance::kLaneBlock) {
      const std::uint32_t count =
          std::min<std::uint32_t>(tolerance::kLaneBlock, chunk.lastLanes - l);
      // In a loop of its own: lanes are read as vectors, which must wait until the single values
      // have been written.
      for (std::uint32_t i = 0; i < count; ++i) gather(lanes[l + i], position, now, i * kLanes);
      w.groups.count = 0;
      for (std::uint32_t i = 0; i < count; ++i) {
        const Group group(chunk, l + i);
        loadLanes<kNodal, kCone>(lanes[l + i], in, group, now, i * kLanes, w);
        if constexpr (kCone && kNodal) group.load(in.opening, w.opening + i * kLanes);
        w.groups.add(i * kLanes);
      }
      tryLanes<kPlane, kNodal, kCone>(input, w);
      flat += countFlat(w, count * kLanes);
      w.groups = w.groups.with([&](std::size_t k)
                                   __attribute__((always_inline)) { return w.over[k] > 0; });
      if (w.groups.count > 0) flowBlock(l, input, before, w, sums);
      for (std::uint32_t i = 0; i < count; ++i) {
        forcesOfLanes(lanes[l + i], in.constants.moduli.shear, in.hoops != nullptr, w, i * kLanes,
                      now);
        scatter(lanes[l + i], now, force, i * kLanes);
      }
    }
    for (std::size_t k = 0; k < kLanes; ++k) {
      room.dissipated += sums.dissipated[k];
      room.squaredSteepest = std::max(room.squaredSteepest, sums.steepest[k]);
    }
    return flat == 0;
  }

 private:
  struct alignas(64) Sums {
    double dissipated[kLanes] = {}, steepest[kLanes] = {};
  };

  [[gnu::always_inline]] void flowBlock(std::uint32_t l, const ReturnInput<kBlock>& input,
                                        Corners<kBlock>& before, FlowLanes<kBlock>& w,
                                        Sums& sums) const {
    const Vec2* former = in.before(chunk, position, room.before);
    for (std::uint32_t i = 0; i < w.groups.count; ++i) {
      const std::size_t at = w.groups.first[i];
      const ElementLanes& e = lanes[l + at / kLanes];
      const Group group(chunk, l + at / kLanes);
      prepare(group, at, w);
      if constexpr (kCone && kNodal)
        meansOfNodes(e, in.hoopsOf(group.lane), in.formerPressure, w.formerPressure + at);
      gather(e, former, before, at);
      copyLanes(room.former.back().thickness, w.formerThickness + at);
      if (in.hoops == nullptr) continue;
      const Hoops<kBlock> hoop(in, group, before, at);
      for (std::size_t k = 0; k < kLanes; ++k) w.formerThickness[at + k] *= hoop[k];
    }
    returnLanes<kKind, kPlane, kNodal>(input, w);
    yieldAfter<kKind>(in.constants, w);
    for (std::uint32_t i = 0; i < w.groups.count; ++i) {
      const std::size_t at = w.groups.first[i];
      const Group group(chunk, l + at / kLanes);
      if (in.hoops != nullptr) withoutHoops(group, input.now, at, w);
      put(group, at, w);
      const double* volume = lanes[l + at / kLanes].volume;
#pragma omp simd
      for (std::size_t k = 0; k < kLanes; ++k) {
        sums.dissipated[k] += w.work[at + k] * volume[k];
        sums.steepest[k] = std::max(sums.steepest[k], w.steep[at + k]);
      }
    }
  }

  /// Keeps the state of a group, and fetches what its return needs.
  [[gnu::always_inline]] void prepare(const Group& group, std::size_t at,
                                      FlowLanes<kBlock>& w) const {
    group.load(in.strain, w.strain + at);
    group.load(in.temperature, w.temperature + at);
    if constexpr (!kCone) group.load(in.thermal, w.thermal + at);
    FormerLanes& former = room.former.emplace_back();
    former.first = group.first, former.count = group.count;
    for (std::size_t i = 0; i < 4; ++i) copyLanes(w.edges[i] + at, former.edges[i]);
    group.load(in.thickness, former.thickness);
    copyLanes(w.strain + at, former.strain);
    copyLanes(w.temperature + at, former.temperature);
    for (std::uint32_t k = group.count; k < kLanes; ++k) w.over[at + k] = 0;
  }

  /// The state's thickness after the flow: where there is none, the former one to the last bit.
  [[gnu::always_inline]] void withoutHoops(const Group& group, const Corners<kBlock>& now,
                                           std::size_t at, FlowLanes<kBlock>& w) const {
    alignas(64) double former[kLanes];
    group.load(in.thickness, former);
    const Hoops<kBlock> hoop(in, group, now, at);
    for (std::size_t k = 0; k < kLanes; ++k)
      w.thickness[at + k] = w.over[at + k] > 0 ? w.thickness[at + k] / hoop[k] : former[k];
  }

  [[gnu::always_inline]] void put(const Group& group, std::size_t at,
                                  const FlowLanes<kBlock>& w) const {
    for (std::size_t i = 0; i < 4; ++i) group.store(w.edges[i] + at, in.edges[i]);
    group.store(w.thickness + at, in.thickness);
    group.store(w.strain + at, in.strain);
    if constexpr (kCone) return;
    group.store(w.temperature + at, in.temperature);
    group.store(w.yield + at, in.yield);
    group.store(w.thermal + at, in.thermal);
  }
};

/// Chooses the loop.
struct Forces {
  InstructionSet set;
  const Chunk& chunk;
  const ElementLanes* lanes;
  const PlasticChunk& in;
  const Vec2* position;
  FlowRoom& room;
  Vec2* force;

  template <bool kPlane, bool kNodal, Kind kKind>
  [[nodiscard]] bool add() const {
    return runForWide(set,
                      AddForces<kPlane, kNodal, kKind>{chunk, lanes, in, position, room, force});
  }
  template <bool kNodal>
  [[nodiscard]] bool addInPlaneStrain() const {
    if (in.constants.kind == Kind::kLine) return add<false, kNodal, Kind::kLine>();
    if (in.constants.kind == Kind::kCurved) return add<false, kNodal, Kind::kCurved>();
    if (in.constants.kind == Kind::kCone) return add<false, kNodal, Kind::kCone>();
    return add<false, kNodal, Kind::kAny>();
  }
};

/// Adds each lane's volume to its nodes, by the corners' parts of the mass.
template <bool kHoop>
[[gnu::always_inline]] inline void addVolumes(const ElementLanes& e, const ElementHoops* hoops,
                                              const double* ratio, double* nodes) {
  alignas(64) double part[kLanes];
#pragma omp simd
  for (std::size_t k = 0; k < kLanes; ++k) part[k] = e.volume[k] * (kHoop ? 1 : 1. / 3) * ratio[k];
  for (std::size_t k = 0; k < kLanes; ++k)
    for (int i = 0; i < 3; ++i)
      nodes[e.corner[i][k]] += kHoop ? hoops->share[i][k] * part[k] : part[k];
}

struct OpenVolumes {
  const Chunk& chunk;
  const ElementLanes* lanes;
  const PlasticChunk& in;
  const Vec2* position;
  double* nodes;

  [[gnu::always_inline]] void operator()() const {
    Corners<kLanes> now;
    const ReturnInput<kLanes> input{in.constants, in.dt, now, now};
    FlowLanes<kLanes> w;
    w.groups.add(0);
    for (std::uint32_t l = chunk.firstLanes; l < chunk.lastLanes; ++l) {
      gather(lanes[l], position, now);
      const Group group(chunk, l);
      loadLanes<true, true>(lanes[l], in, group, now, 0, w);
      tryLanes<false, true, true>(input, w);
      open(w);
      group.store(w.opening, in.opening);
      if (in.hoops != nullptr)
        addVolumes<true>(lanes[l], in.hoops + l, w.trial.volume, nodes);
      else
        addVolumes<false>(lanes[l], nullptr, w.trial.volume, nodes);
    }
  }

 private:
  [[gnu::always_inline]] void open(FlowLanes<kLanes>& w) const {
    const SolidModuli m = in.constants.moduli;
    const Cone c = in.constants.cone;
    w.forAnySize([&](std::size_t k, auto isAlone) __attribute__((always_inline)) {
      constexpr bool kTiny = !decltype(isAlone)::value;
      const double volume = w.trial.volume[k];
      const ConeTrial at{m.shear * std::sqrt(w.trial[k].squaredMises() * (1. / 3)), w.mean[k],
                         nodalStiffness(w.mean[k] / volume, volume, m.bulk), w.size[k]};
      const double opening = coneFlow<kTiny>(c, m.shear, at).opening;
      w.opening[k] = w.over[k] > 0 ? opening : 0;
      w.rare[k] = w.opening[k] < tolerance::kTinyFlow ? 0 : 1;
    });
    for (std::size_t k = 0; k < kLanes; ++k) w.trial.volume[k] *= expOfSmall(-w.opening[k]);
  }
};

template <bool kHoop>
struct SumVolumes {
  const Chunk& chunk;
  const ElementLanes* lanes;
  const PlasticChunk& in;
  const Vec2* position;
  double* nodes;

  [[gnu::always_inline]] void operator()() const {
    Corners<kLanes> c;
    alignas(64) double edges[4][kLanes], thickness[kLanes], ratio[kLanes];
    for (std::uint32_t l = chunk.firstLanes; l < chunk.lastLanes; ++l) {
      gather(lanes[l], position, c);
      const Group group(chunk, l);
      for (std::size_t i = 0; i < 4; ++i) group.load(in.edges[i], edges[i]);
      group.load(in.thickness, thickness);
#pragma omp simd
      for (std::size_t k = 0; k < kLanes; ++k) {
        const double inverse = edges[0][k] * edges[3][k] - edges[1][k] * edges[2][k];
        ratio[k] = thickness[k] * inverse * c.twiceArea(k);
      }
      if constexpr (kHoop) {
        const Hoops<kLanes> hoop(in, group, c, 0);
        for (std::size_t k = 0; k < kLanes; ++k) ratio[k] *= hoop[k];
      }
      addVolumes<kHoop>(lanes[l], in.hoopsOf(l), ratio, nodes);
    }
  }
};

}  // namespace

const Vec2* PlasticChunk::before(const Chunk& chunk, const Vec2* position,
                                 std::vector<Vec2>& room) const {
  if (!room.empty()) return room.data();
  room.resize(chunk.lastNode - chunk.firstNode);
  for (std::size_t i = 0; i < room.size(); ++i)
    room[i] = position[i] - dt * velocity[nodes[i].value];
  return room.data();
}

bool addPlasticForces(InstructionSet set, const Chunk& chunk, const ElementLanes* lanes,
                      const PlasticChunk& in, const Vec2* position, FlowRoom& room, Vec2* force) {
  const Forces forces{set, chunk, lanes, in, position, room, force};
  if (in.constants.planeStress) return forces.add<true, false, Kind::kAny>();
  return in.pressure != nullptr ? forces.addInPlaneStrain<true>()
                                : forces.addInPlaneStrain<false>();
}

void openVolumes(InstructionSet set, const Chunk& chunk, const ElementLanes* lanes,
                 const PlasticChunk& in, const Vec2* position, double* nodes) {
  runForWide(set, OpenVolumes{chunk, lanes, in, position, nodes});
}

void sumVolumes(InstructionSet set, const Chunk& chunk, const ElementLanes* lanes,
                const PlasticChunk& in, const Vec2* position, double* nodes) {
  if (in.hoops == nullptr)
    return runForWide(set, SumVolumes<false>{chunk, lanes, in, position, nodes});
  runForWide(set, SumVolumes<true>{chunk, lanes, in, position, nodes});
}

}  // namespace yadefrag
