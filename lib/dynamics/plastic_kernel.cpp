#include "dynamics/plastic_kernel.hpp"

#include <algorithm>
#include <array>
#include <span>

#include "core/tolerances/plasticity.hpp"
#include "dynamics/cone_lanes.hpp"
#include "dynamics/plastic_groups.hpp"
#include "dynamics/yield_lanes.hpp"

namespace yadefrag {
namespace {

/// One group of a block.
struct GroupLanes {
  Corners corners, before;
  StateLanes state;
  TrialLanes trial;
  FlowLanes flow;
  FlowedLanes fresh;
  ConeLanes cone;
};

template <bool kPlane, bool kNodal, YieldCurve::Kind kKind>
struct AddForces {
  static constexpr bool kCone = kKind == YieldCurve::Kind::kCone;

  const Chunk& chunk;
  const ElementLanes* lanes;
  const PlasticChunk& in;
  const Vec2* position;
  LaneReturn& flow;
  Vec2* force;

  [[gnu::always_inline]] bool operator()() const {
    int flat = 0;
    FlowSums sums;
    std::array<GroupLanes, tolerance::kLaneBlock> block;
    for (std::uint32_t l = chunk.firstLanes; l < chunk.lastLanes; l += tolerance::kLaneBlock) {
      const std::uint32_t count =
          std::min<std::uint32_t>(tolerance::kLaneBlock, chunk.lastLanes - l);
      std::array<std::uint32_t, tolerance::kLaneBlock> yielding;
      std::uint32_t found = 0;
      // In loops of their own: lanes are read as vectors, which must wait until the single values
      // have been written.
      for (std::uint32_t i = 0; i < count; ++i) gather(lanes[l + i], position, block[i].corners);
      for (std::uint32_t i = 0; i < count; ++i) {
        GroupLanes& g = block[i];
        const Group group = groupOf(l + i);
        group.load(in, g.state);
        group.load(in.yield, g.flow.yield);
        if constexpr (kCone && kNodal) group.load(in.opening, g.flow.opening);
        const Trials trials =
            tryLanes<kPlane, kNodal, kCone>(lanes[l + i], in, g.state, g.corners, g.flow, g.trial);
        flat += trials.flat;
        yielding[found] = i;
        found += trials.yielding != 0 ? 1 : 0;
      }
      if (found != 0) flowBlock(l, std::span(yielding).first(found), block, sums);
      for (std::uint32_t i = 0; i < count; ++i) {
        forcesOfLanes(lanes[l + i], in.moduli.shear, block[i].trial, block[i].corners);
        scatter(lanes[l + i], block[i].corners, force);
      }
    }
    addTo(flow.sums, sums);
    return flat == 0;
  }

 private:
  [[nodiscard, gnu::always_inline]] Group groupOf(std::uint32_t l) const {
    return {firstOf(l), chunk.lastElement};
  }
  [[nodiscard, gnu::always_inline]] std::uint32_t firstOf(std::uint32_t l) const {
    return chunk.firstElement + static_cast<std::uint32_t>(kLanes) * (l - chunk.firstLanes);
  }

  [[gnu::always_inline]] static void addTo(FlowSums& sums, const FlowSums& more) {
    for (std::size_t k = 0; k < kLanes; ++k) {
      sums.dissipated[k] += more.dissipated[k];
      sums.steepest[k] = std::max(sums.steepest[k], more.steepest[k]);
    }
  }

  /// In many short loops over the groups, so that the values of one need not wait for another's.
  [[gnu::always_inline]] void flowBlock(std::uint32_t l, std::span<const std::uint32_t> yielding,
                                        std::array<GroupLanes, tolerance::kLaneBlock>& block,
                                        FlowSums& sums) const {
    const auto forEach = [&](auto work) __attribute__((always_inline)) {
      for (const std::uint32_t i : yielding) work(block[i], l + i);
    };
    forEach([&](GroupLanes & g, std::uint32_t i) __attribute__((always_inline)) { prepare(i, g); });
    if constexpr (kCone)
      flowOnCone(forEach, sums);
    else if constexpr (kKind != YieldCurve::Kind::kAlone)
      flowOnCurve(forEach, sums);
    forEach([&](GroupLanes & g, std::uint32_t i)
                __attribute__((always_inline)) { returnAlone(i, g); });
  }

  template <class ForEach>
  [[gnu::always_inline]] void flowOnCurve(const ForEach& forEach, FlowSums& sums) const {
    constexpr bool kCurved = kKind == YieldCurve::Kind::kCurved;
    const YieldCurve c = in.curve;
    forEach([&](GroupLanes & g, std::uint32_t) __attribute__((always_inline)) {
      lookBack<kKind>(g.before, g.state, g.trial, in.moduli.shear, g.flow);
    });
    if constexpr (kCurved)
      stepOnCurve(c, forEach);
    else
      forEach([&](GroupLanes & g, std::uint32_t)
                  __attribute__((always_inline)) { stepOnLine(c, g.flow); });
    forEach([&](GroupLanes & g, std::uint32_t) __attribute__((always_inline)) {
      markLanes(c, g.trial, g.flow);
      hardenLanes<kCurved>(c, g.trial, g.flow, g.fresh);
    });
    forEach([&](GroupLanes & g, std::uint32_t) __attribute__((always_inline)) {
      shapeLanes<false>(g.state, g.trial, g.flow, g.fresh);
    });
    if constexpr (kCurved) yieldAfter(c, forEach);
    forEach([&](GroupLanes & g, std::uint32_t i) __attribute__((always_inline)) {
      takeFlow<kCurved>(g.fresh, lanes[i].volume, g.state, g.trial, g.flow, sums);
      put(groupOf(i), g);
    });
  }

  template <class ForEach>
  [[gnu::always_inline]] void flowOnCone(const ForEach& forEach, FlowSums& sums) const {
    const SolidModuli moduli = in.moduli;
    forEach([&](GroupLanes & g, std::uint32_t i) __attribute__((always_inline)) {
      lookBack<kKind>(g.before, g.state, g.trial, moduli.shear, g.flow);
      formerMeans(lanes[i], in.formerPressure, moduli.bulk, g.flow, g.cone);
    });
    forEach([&](GroupLanes & g, std::uint32_t) __attribute__((always_inline)) {
      returnToCone<kNodal>(in.cone, moduli, g.trial, g.flow, g.cone, g.fresh);
    });
    forEach([&](GroupLanes & g, std::uint32_t) __attribute__((always_inline)) {
      shapeLanes<true>(g.state, g.trial, g.flow, g.fresh);
    });
    forEach([&](GroupLanes & g, std::uint32_t i) __attribute__((always_inline)) {
      takeConeFlow(g.fresh, g.cone, lanes[i].volume, g.state, g.trial, g.flow, sums);
      put(groupOf(i), g);
    });
  }

  template <class ForEach>
  [[gnu::always_inline]] static void stepOnCurve(const YieldCurve& c, const ForEach& forEach) {
    forEach([&](GroupLanes & g, std::uint32_t)
                __attribute__((always_inline)) { estimateStep(c, g.flow); });
    forEach([&](GroupLanes & g, std::uint32_t) __attribute__((always_inline)) {
      takeLogarithms(g.flow.power);
      takeLogarithms(g.flow.logarithm);
    });
    forEach([&](GroupLanes & g, std::uint32_t)
                __attribute__((always_inline)) { estimateStress(c, g.flow); });
    forEach([&](GroupLanes & g, std::uint32_t)
                __attribute__((always_inline)) { improveStep<true>(c, g.flow); });
    forEach([&](GroupLanes & g, std::uint32_t)
                __attribute__((always_inline)) { settleStep(c, g.flow); });
  }

  template <class ForEach>
  [[gnu::always_inline]] static void yieldAfter(const YieldCurve& c, const ForEach& forEach) {
    forEach([&](GroupLanes & g, std::uint32_t) __attribute__((always_inline)) {
      takeLogarithms(g.flow.power);
      takeLogarithms(g.flow.heat);
    });
    forEach([&](GroupLanes & g, std::uint32_t)
                __attribute__((always_inline)) { yieldOfLanes(c, g.flow, g.fresh); });
  }

  /// Keeps the state of a group, and fetches what it needs.
  [[gnu::always_inline]] void prepare(std::uint32_t l, GroupLanes& g) const {
    const Group group = groupOf(l);
    group.load(in.strain, g.flow.strain);
    group.load(in.temperature, g.flow.temperature);
    FormerLanes& former = flow.former();
    former.first = firstOf(l), former.count = group.count();
    for (std::size_t i = 0; i < 4; ++i) copyLanes(g.state.edges[i], former.edges[i]);
    copyLanes(g.state.thickness, former.thickness);
    copyLanes(g.flow.strain, former.strain);
    copyLanes(g.flow.temperature, former.temperature);
    if constexpr (kKind == YieldCurve::Kind::kAlone) {
      copyLanes(g.flow.over, g.flow.fails);
    } else {
      if constexpr (kKind == YieldCurve::Kind::kCurved) group.load(in.thermal, g.flow.thermal);
      gather(lanes[l], flow.before(), g.before);
      for (std::uint32_t k = group.count(); k < kLanes; ++k) g.flow.over[k] = 0;
    }
  }

  [[gnu::always_inline]] void put(const Group& group, const GroupLanes& g) const {
    for (std::size_t i = 0; i < 4; ++i) group.store(g.state.edges[i], in.edges[i]);
    group.store(g.state.thickness, in.thickness);
    group.store(g.flow.strain, in.strain);
    if constexpr (kCone) return;
    group.store(g.flow.temperature, in.temperature);
    group.store(g.flow.yield, in.yield);
    if constexpr (kKind == YieldCurve::Kind::kCurved) group.store(g.flow.thermal, in.thermal);
  }

  [[gnu::always_inline]] void returnAlone(std::uint32_t l, GroupLanes& g) const {
    double any = 0;
    for (const double fails : g.flow.fails) any = std::max(any, fails);
    if (any <= 0) return;
    std::array<bool, kLanes> alone;
    for (std::size_t k = 0; k < kLanes; ++k)
      alone[k] = g.flow.fails[k] > 0 && firstOf(l) + k < chunk.lastElement;
    flow(firstOf(l), lanes[l].corner, alone, g.trial);
  }
};

struct OpenVolumes {
  const Chunk& chunk;
  const ElementLanes* lanes;
  const PlasticChunk& in;
  const Vec2* position;
  double* nodes;

  [[gnu::always_inline]] void operator()() const {
    GroupLanes g;
    alignas(64) double third[kLanes];
    std::uint32_t first = chunk.firstElement;
    for (std::uint32_t l = chunk.firstLanes; l < chunk.lastLanes; ++l, first += kLanes) {
      gather(lanes[l], position, g.corners);
      const Group group(first, chunk.lastElement);
      group.load(in, g.state);
      group.load(in.yield, g.flow.yield);
      for (double& one : g.flow.opening) one = 0;
      const Trials trials =
          tryLanes<false, true, true>(lanes[l], in, g.state, g.corners, g.flow, g.trial);
      if (trials.yielding != 0) open(g.trial, g.flow);
      group.store(g.flow.opening, in.opening);
#pragma omp simd
      for (std::size_t k = 0; k < kLanes; ++k)
        third[k] = lanes[l].volume[k] * (1. / 3) * g.trial.volume[k];
      for (std::size_t k = 0; k < kLanes; ++k)
        for (const auto& corner : lanes[l].corner) nodes[corner[k]] += third[k];
    }
  }

 private:
  [[gnu::always_inline]] void open(TrialLanes& t, FlowLanes& w) const {
    const SolidModuli m = in.moduli;
    const Cone c = in.cone;
    double most = 0;
    const auto trialOf = [&](std::size_t k) __attribute__((always_inline)) {
      const double volume = t.volume[k];
      return ConeTrial{m.shear * std::sqrt(t.squaredMises[k] * (1. / 3)), t.mean[k],
                       nodalStiffness(t.mean[k] / volume, volume, m.bulk), w.size[k]};
    };
#pragma omp simd reduction(max : most)
    for (std::size_t k = 0; k < kLanes; ++k) {
      const double opening = coneFlow<true>(c, m.shear, trialOf(k)).opening;
      w.opening[k] = w.over[k] > 0 ? opening : 0;
      most = std::max(most, w.opening[k]);
    }
    for (std::size_t k = 0; most >= tolerance::kTinyFlow && k < kLanes; ++k)
      if (w.opening[k] >= tolerance::kTinyFlow)
        w.opening[k] = coneFlow<false>(c, m.shear, trialOf(k)).opening;
    for (std::size_t k = 0; k < kLanes; ++k) t.volume[k] *= expOfSmall(-w.opening[k]);
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
      StateLanes s;
      Group(first, chunk.lastElement).load(in, s);
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

template <bool kPlane, bool kNodal>
bool addForces(InstructionSet set, const Chunk& chunk, const ElementLanes* lanes,
               const PlasticChunk& in, const Vec2* position, LaneReturn& flow, Vec2* force) {
  using enum YieldCurve::Kind;
  if constexpr (!kPlane) {
    if (in.curve.kind == kLine)
      return runForWide(set,
                        AddForces<kPlane, kNodal, kLine>{chunk, lanes, in, position, flow, force});
    if (in.curve.kind == kCurved)
      return runForWide(
          set, AddForces<kPlane, kNodal, kCurved>{chunk, lanes, in, position, flow, force});
    if (in.curve.kind == kCone)
      return runForWide(set,
                        AddForces<kPlane, kNodal, kCone>{chunk, lanes, in, position, flow, force});
  }
  return runForWide(set,
                    AddForces<kPlane, kNodal, kAlone>{chunk, lanes, in, position, flow, force});
}

}  // namespace

bool addPlasticForces(InstructionSet set, const Chunk& chunk, const ElementLanes* lanes,
                      const PlasticChunk& in, const Vec2* position, LaneReturn& flow, Vec2* force) {
  if (in.planeStress) return addForces<true, false>(set, chunk, lanes, in, position, flow, force);
  if (in.pressure != nullptr)
    return addForces<false, true>(set, chunk, lanes, in, position, flow, force);
  return addForces<false, false>(set, chunk, lanes, in, position, flow, force);
}

void openVolumes(InstructionSet set, const Chunk& chunk, const ElementLanes* lanes,
                 const PlasticChunk& in, const Vec2* position, double* nodes) {
  runForWide(set, OpenVolumes{chunk, lanes, in, position, nodes});
}

void sumVolumes(InstructionSet set, const Chunk& chunk, const ElementLanes* lanes,
                const PlasticChunk& in, const Vec2* position, double* nodes) {
  runForWide(set, SumVolumes{chunk, lanes, in, position, nodes});
}

}  // namespace yadefrag
