#include "elements/element_state.hpp"

#include <algorithm>

namespace yadefrag {
namespace {

/// (J) Twice the triangle's own energy at the half step.
double twiceOwnEnergy(const Model& model, ElementId element, double dt) {
  const Deformation f = deformation(model, element);
  const Deformation last = deformationBefore(model, element, f, dt);
  const SplitGradient now = splitGradient(f.plane), before = splitGradient(last.plane);
  const ElasticMaterial& material = model.bodyOf(element).material;
  return (1 - kSmoothedShare) * material.shearModulus() * volumeOf(model, element) *
             (now.part[2] * before.part[2] + now.part[3] * before.part[3]) +
         volumeOf(model, element) * twiceBarrierEnergy(f, last, material.waveModulus());
}

bool isSmoothed(const Component& body) {
  return body.element == ElementKind::kSmoothed && !body.yields();
}

/// Calls `use(element)` for all triangles with smoothed strains that have not been removed.
template <class Use>
void forEachSmoothed(const Model& model, Use use) {
  for (const Component& body : model.components)
    if (isSmoothed(body))
      for (std::uint32_t e = body.firstTriangle; e < body.lastTriangle; ++e)
        if (!model.triangles.isDropped(e)) use(ElementId(e));
}

/// Means by node; zero at nodes of other bodies.
struct Means {
  std::vector<SplitGradient> plane;
  std::vector<double> around;

  explicit Means(const Model& model) : plane(model.nodes.size()), around(model.nodes.size()) {
    forEachSmoothed(model, [&](ElementId element) {
      const double mass = model.bodyOf(element).material.density * volumeOf(model, element) / 3;
      const SplitGradient weighted = mass * splitGradient(deformationGradient(model, element));
      for (std::size_t i = 0; i < 3; ++i) {
        const std::uint32_t node = model.triangles.nodes[element.value][i].value;
        const double part = model.massShare(element, i) / model.nodes.mass[node];
        plane[node] += part * weighted;
        around[node] += part * mass * (hoopStretch(model, element) - 1);
      }
    });
  }
};

bool anySmoothed(const Model& model) {
  return std::any_of(model.components.begin(), model.components.end(), isSmoothed);
}

const ElasticMaterial& materialAt(const Model& model, NodeId node) {
  return model.components[model.nodes.component[node.value].value].material;
}

}  // namespace

void NodeSum::add(const Model& model, ElementId element, double share, double dt) {
  const double third = volumeOf(model, element) / 3 * share;
  const double strain = hoopStretch(model, element) - 1;
  const Matrix2 f = deformationGradient(model, element);
  volume += third;
  now += third * splitGradient(f);
  before += third * splitGradient(f - deformationStep(model, element, dt));
  around += third * strain;
  wasAround += third * (strain - dt * overRadius(model, element, model.nodes.velocity, 0));
}

NodeSum& NodeSum::operator+=(const NodeSum& other) {
  volume += other.volume;
  now += other.now;
  before += other.before;
  around += other.around, wasAround += other.wasAround;
  return *this;
}

NodeSum operator*(double factor, const NodeSum& sum) {
  return {factor * sum.now, factor * sum.before, factor * sum.around, factor * sum.wasAround,
          factor * sum.volume};
}

double NodeSum::energy(const ElasticMaterial& material) const {
  if (volume == 0) return 0;
  const SplitGradient x = 1 / volume * now;
  const SplitGradient y = 1 / volume * before;
  const double h = around / volume, g = wasAround / volume;
  const SplitGradient stress = nodeStress(x, material, h) - nodeStress(y, material, g);
  const SplitGradient step = x - y;
  double work = (stressAround(x, material, h) - stressAround(y, material, g)) * (h - g);
  for (int j = 0; j < 4; ++j) work += stress.part[j] * step.part[j];
  return volume *
         (nodeEnergyDensity(x, material, h) + nodeEnergyDensity(y, material, g) - work / 2) / 2;
}

double smoothedEnergy(const Model& model, std::span<const ElementId> elements, double dt) {
  if (!anySmoothed(model)) return 0;
  std::vector<std::uint32_t> numbers(model.nodes.size());  // of the nodes in `sums`, from 1
  std::vector<NodeId> nodes;
  std::vector<NodeSum> sums;
  double sum = 0;
  for (const ElementId e : elements) {
    if (!isSmoothed(model.bodyOf(e))) continue;
    NodeSum one;
    one.add(model, e, 1, dt);
    for (std::size_t i = 0; i < 3; ++i) {
      const NodeId node = model.triangles.nodes[e.value][i];
      std::uint32_t& number = numbers[node.value];
      if (number == 0) {
        nodes.push_back(node);
        sums.emplace_back();
        number = static_cast<std::uint32_t>(nodes.size());
      }
      sums[number - 1] += model.massShare(e, i) * one;
    }
    sum += twiceOwnEnergy(model, e, dt) / 2;
  }
  for (std::size_t i = 0; i < nodes.size(); ++i) sum += sums[i].energy(materialAt(model, nodes[i]));
  return sum;
}

void setSmoothedStresses(const Model& model, std::vector<std::array<double, 3>>& stresses) {
  if (!anySmoothed(model)) return;
  const Means means(model);
  forEachSmoothed(model, [&](ElementId element) {
    const ElasticMaterial& material = model.bodyOf(element).material;
    const Matrix2 f = deformationGradient(model, element);
    const SplitGradient split = splitGradient(f);
    const double own = (1 - kSmoothedShare) * material.shearModulus();
    SplitGradient stress{{0, 0, own * split.part[2], own * split.part[3]}};
    for (std::size_t i = 0; i < 3; ++i) {
      const std::uint32_t node = model.triangles.nodes[element.value][i].value;
      stress += model.massShare(element, i) / 3 *
                nodeStress(means.plane[node], material, means.around[node]);
    }
    const Matrix2 p = piolaOf(stress);
    const double det = deformation(model, element).volume();
    // σ = P Fᵀ / det F; its two shear components differ if neighbours rotate differently.
    const double mean = CollapseBarrier(det, material.waveModulus()).slope;
    stresses[element.value] = {(p.xx * f.xx + p.xy * f.xy) / det + mean,
                               (p.yx * f.yx + p.yy * f.yy) / det + mean,
                               (p.xx * f.yx + p.xy * f.yy + p.yx * f.xx + p.yy * f.xy) / (2 * det)};
  });
}

void setSmoothedAround(const Model& model, std::vector<double>& stresses) {
  if (!anySmoothed(model)) return;
  const Means means(model);
  forEachSmoothed(model, [&](ElementId element) {
    double stress = 0;
    for (std::size_t i = 0; i < 3; ++i) {
      const std::uint32_t node = model.triangles.nodes[element.value][i].value;
      stress += model.massShare(element, i) / 3 *
                stressAround(means.plane[node], model.bodyOf(element).material, means.around[node]);
    }
    const Deformation now = deformation(model, element);
    stresses[element.value] =
        stress / determinant(now.plane) +
        CollapseBarrier(now.volume(), model.bodyOf(element).material.waveModulus()).slope;
  });
}

}  // namespace yadefrag
