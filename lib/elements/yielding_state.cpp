#include "elements/element_state.hpp"

#include <algorithm>
#include <cmath>

#include "core/tolerances/dynamics.hpp"
#include "elements/plastic_flow.hpp"

namespace yadefrag {
namespace {

/// All triangles of bodies that yield, and that have not been removed.
std::vector<ElementId> allYielding(const Model& model) {
  std::vector<ElementId> all;
  if (!model.triangles.plastic.isUsed()) return all;
  for (const Component& body : model.components)
    if (body.yields())
      for (std::uint32_t e = body.firstTriangle; e < body.lastTriangle; ++e)
        if (!model.triangles.isDropped(e)) all.emplace_back(e);
  return all;
}

using Corners = std::array<Vec2, 3>;

Corners cornersOf(const Model& model, ElementId element, const std::vector<Vec2>& field) {
  const auto& nodes = model.triangles.nodes[element.value];
  return {field[nodes[0].value], field[nodes[1].value], field[nodes[2].value]};
}

TriangleEdges edgesOf(const Corners& x) { return {x[1] - x[0], x[2] - x[0], 1}; }

/// An element at xⁿ and at xⁿ⁻¹.
struct Pair {
  ElementId element;
  double volume;  // m³, stress-free
  YieldConstants constants;
  bool smoothed;
  YieldPoint point;
  Corners step;  // m, displacements of the corners
  TriangleMotion motion;
  ElasticTrial trial{Matrix2{1, 0, 0, 1}, 1}, former = trial;
  double formerMean = 0;     // Pa, of τ
  NodalPressure pressure{};  // smoothed
  double trialMean = 0;      // Pa, of τ, before any opening
  Returned present;          // after `returnStress`

  Pair(const Model& model, ElementId id, double dt)
      : element(id),
        volume(volumeOf(model, id)),
        constants(model.bodyOf(id)),
        smoothed(model.bodyOf(id).averagesVolume()),
        point(model.triangles.plastic, id.value),
        step(cornersOf(model, id, model.nodes.velocity)),
        motion{edgesOf(cornersOf(model, id, model.nodes.position)), {}, 0} {
    for (Vec2& one : step) one *= dt;
    const TriangleEdges change = edgesOf(step);
    TriangleEdges& now = motion.now;
    now.hoop = hoopStretch(model, id);
    motion.before = {now.first - change.first, now.second - change.second,
                     now.hoop - dt * overRadius(model, id, model.nodes.velocity, 0)};
    motion.size = now.twiceArea() / (2 * model.triangles.area[id.value]) * now.hoop;
    double thickness = 1;
    trial = trialOf(constants, point, now, thickness);
    former = trialOf(constants, point, motion.before, thickness);
    formerMean = meanStress(former.volume, constants.moduli.bulk);
  }
  void returnStress(double dt, bool isNodal = false) {
    present = returnToYield(constants, point, motion, dt, isNodal ? &pressure : nullptr);
  }
  void open() { pressure.opening = nodalOpening(constants, trial, motion.size, pressure.now); }
};

double pressureAt(double ratio, double bulk) { return bulk / 2 * (ratio - 1 / ratio); }

/// All pairs, and volume ratios averaged at the nodes, at xⁿ and xⁿ⁻¹.
struct Yielding {
  std::vector<Pair> pairs;
  std::vector<double> now, before;

  Yielding(const Model& model, std::span<const ElementId> elements, double dt) {
    for (const ElementId e : elements)
      if (model.bodyOf(e).yields() && !model.triangles.isDropped(e.value))
        pairs.emplace_back(model, e, dt);
    if (pairs.empty()) return;
    now = average(model, [](const Pair& p) { return p.trial.volume; });
    before = average(model, [](const Pair& p) { return p.former.volume; });
    for (Pair& p : pairs) {
      if (!p.smoothed) continue;
      p.pressure = {meanPressure(model, p, now), meanPressure(model, p, before)};
      p.formerMean = p.pressure.before * p.former.volume;
      p.trialMean = p.pressure.now * p.trial.volume;
      if (isOpening(p)) p.open();
    }
    // Flow changes volumes: the stresses are those of the volumes after it.
    if (std::ranges::any_of(pairs, isOpening)) {
      now = average(model,
                    [](const Pair& p) { return p.trial.volume * expOfSmall(-p.pressure.opening); });
      for (Pair& p : pairs)
        if (isOpening(p)) p.pressure.now = meanPressure(model, p, now);
    }
    for (Pair& p : pairs) {
      p.returnStress(dt, p.smoothed);
      if (isOpening(p)) p.present.trialMean = p.trialMean;
    }
  }
  Yielding(const Model& model, double dt) : Yielding(model, allYielding(model), dt) {}

 private:
  static bool isOpening(const Pair& p) { return p.smoothed && p.constants.plastic.isFrictional(); }
  static double meanPressure(const Model& model, const Pair& p, const std::vector<double>& ratio) {
    double sum = 0;
    for (std::size_t i = 0; i < 3; ++i) {
      const NodeId node = model.triangles.nodes[p.element.value][i];
      sum += pressureAt(ratio[node.value], p.constants.moduli.bulk) / 3 *
             model.massShare(p.element, i);
    }
    return sum;
  }
  template <class Read>
  [[nodiscard]] std::vector<double> average(const Model& model, Read read) const {
    std::vector<double> sum(model.nodes.size()), volume(model.nodes.size());
    for (const Pair& p : pairs)
      if (p.smoothed)
        for (std::size_t i = 0; i < 3; ++i) {
          const NodeId node = model.triangles.nodes[p.element.value][i];
          const double part = p.volume * model.massShare(p.element, i);
          volume[node.value] += part;
          sum[node.value] += part * read(p);
        }
    for (std::size_t n = 0; n < sum.size(); ++n)
      if (volume[n] > 0) sum[n] /= volume[n];
    return sum;
  }
};

/// (N) −V τ ∇N at the corners; with an axis also towards it. `radius` (m): stress-free; 0: none.
Corners forcesOf(const Pair& p, const TriangleEdges& x, const PlaneStress& t, double across,
                 double radius) {
  const double scale = p.volume / x.twiceArea();
  const auto force = [&](Vec2 n) {
    return -scale * Vec2{t.xx * n.x + t.xy * n.y, t.xy * n.x + t.yy * n.y};
  };
  const Vec2 first = force({x.second.y, -x.second.x}), second = force({-x.first.y, x.first.x});
  const Vec2 pull = radius > 0 ? Vec2{p.volume * across / (3 * radius * x.hoop), 0} : Vec2{};
  return {-(first + second) - pull, first - pull, second - pull};
}

PlaneStress presentStress(const Pair& p) {
  return {p.present.trial, p.present.mean, p.present.kept, p.constants.moduli.shear};
}
double presentAcross(const Pair& p) {
  return stressAcross(p.present.trial, p.present.mean, p.present.kept, p.constants.moduli.shear);
}

}  // namespace

std::vector<YieldPoint> presentPoints(const Model& model, double dt) {
  std::vector<YieldPoint> points(model.triangles.size());
  for (const Pair& p : Yielding(model, dt).pairs) points[p.element.value] = p.present.point;
  return points;
}

Returned presentState(const Model& model, ElementId element, double dt) {
  Pair pair(model, element, dt);
  pair.returnStress(dt);
  return pair.present;
}

YieldingEnergy yieldingEnergy(const Model& model, std::span<const ElementId> elements, double dt) {
  YieldingEnergy sum;
  const Yielding all(model, elements, dt);
  for (const Pair& p : all.pairs) {
    const auto [bulk, shear] = p.constants.moduli;
    double twice =
        deviatorEnergy(p.present.trial, p.present.kept, shear) + deviatorEnergy(p.former, 1, shear);
    if (p.smoothed) {
      for (std::size_t i = 0; i < 3; ++i) {
        const NodeId node = model.triangles.nodes[p.element.value][i];
        twice +=
            (volumeEnergy(all.now[node.value], bulk) + volumeEnergy(all.before[node.value], bulk)) /
            3 * model.massShare(p.element, i);
      }
    } else {
      twice += volumeEnergy(p.present.volume(), bulk) + volumeEnergy(p.former.volume, bulk);
    }
    const double radius = model.axisymmetric ? model.triangles.radius[p.element.value] : 0;
    const Corners now = forcesOf(p, p.motion.now, presentStress(p), presentAcross(p), radius);
    const Corners before =
        forcesOf(p, p.motion.before, PlaneStress(p.former, p.formerMean, 1, shear),
                 stressAcross(p.former, p.formerMean, 1, shear), radius);
    double work = 0;
    for (std::size_t i = 0; i < 3; ++i) work += dot(now[i] - before[i], p.step[i]);
    const double modulus = model.bodyOf(p.element).material.waveModulus();
    const Deformation f = deformation(model, p.element);
    const Deformation last = deformationBefore(model, p.element, f, dt);
    sum.strain += p.volume * (twice + twiceBarrierEnergy(f, last, modulus)) / 2 + work / 4;
    sum.dissipated += p.volume * p.present.dissipation / 2;
  }
  return sum;
}

YieldingEnergy yieldingEnergy(const Model& model, double dt) {
  return yieldingEnergy(model, allYielding(model), dt);
}

std::vector<double> presentDamage(const Model& model, double dt) {
  std::vector<double> damage(model.triangles.size());
  const std::vector<double>& stored = model.triangles.plastic.damage;
  if (stored.empty()) return damage;
  for (const Pair& p : Yielding(model, dt).pairs) {
    const std::uint32_t e = p.element.value;
    const PlasticMaterial& material = p.constants.plastic;
    if (!material.fails() || stored[e] >= 1) {
      damage[e] = stored[e];
      continue;
    }
    const Returned& now = p.present;
    const double shear = p.constants.moduli.shear;
    const FlowStep step{now.point.strain - p.point.strain,
                        p.point.temperature,
                        material.isFrictional() ? now.trialMean : now.mean,
                        shear * now.kept * std::sqrt(now.trial.squaredMises()),
                        material.isFrictional() ? p.motion.size : now.volume(),
                        model.triangles.plastic.resistanceOf(e)};
    damage[e] = damageAfter(material, stored[e], step, dt);
  }
  return damage;
}

namespace {

/// `set(pair, τ/σ, mean of the barrier's stress (Pa))`
template <class Set>
void forStresses(const Model& model, double dt, Set set) {
  for (const Pair& p : Yielding(model, dt).pairs) {
    const double size = p.motion.size;
    const double mean = CollapseBarrier(size, model.bodyOf(p.element).material.waveModulus()).slope;
    set(p, p.constants.planeStress ? p.present.trial.volume : size, mean);
  }
}

}  // namespace

void setYieldingStresses(const Model& model, double dt,
                         std::vector<std::array<double, 3>>& stresses) {
  forStresses(model, dt, [&](const Pair& p, double volume, double mean) {
    const PlaneStress t = presentStress(p);
    stresses[p.element.value] = {t.xx / volume + mean, t.yy / volume + mean, t.xy / volume};
  });
}

void setYieldingAcross(const Model& model, double dt, std::vector<double>& stresses) {
  forStresses(model, dt, [&](const Pair& p, double volume, double mean) {
    if (p.constants.planeStress) return;
    stresses[p.element.value] = presentAcross(p) / volume + mean;
  });
}

std::size_t countYielding(const Model& model, ComponentId body) {
  std::size_t count = 0;
  for (const Pair& p : Yielding(model, 0).pairs)
    if (model.triangles.component[p.element.value] == body &&
        p.present.point.strain - p.point.strain > tolerance::kNoFlow)
      ++count;
  return count;
}

}  // namespace yadefrag
