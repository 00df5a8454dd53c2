#include "dynamics/plastic_damage.hpp"

#include <algorithm>
#include <cstddef>
#include <limits>

namespace yadefrag {

double damageAfter(const PlasticMaterial& m, double damage, const FlowStep& step, double dt) {
  if (step.mean > step.resistance * m.failure.spallStress * step.volume) return 1;
  if (!(step.strain > 0) || !m.failure.hasDamage()) return damage;
  const double least = std::numeric_limits<double>::min();
  const FlowState at{step.mean / std::max(step.mises, least),
                     dt > 0 ? step.strain / (m.referenceRate * dt) : 0,
                     relativeHeat(m, step.temperature)};
  return std::min(1., damage + step.strain / (step.resistance * failureStrain(m.failure, at)));
}

void PlasticDamage::rebuild(const Model& model) {
  failed_.clear();
  threads_.clear();
  const PlasticState& state = model.triangles.plastic;
  for (std::size_t e = 0; e < state.damage.size(); ++e)
    if (state.hasFailed(e)) failed_.push_back(static_cast<std::uint32_t>(e));
}

void PlasticDamage::begin(std::size_t threads) {
  if (threads_.size() < threads) threads_.resize(threads);
  const std::size_t before = failed_.size();
  for (Thread& one : threads_) {
    failed_.insert(failed_.end(), one.failed.begin(), one.failed.end());
    one.former.clear(), one.failed.clear();
  }
  if (failed_.size() != before) std::ranges::sort(failed_);
}

void PlasticDamage::add(Model& model, const PlasticMaterial& m, std::uint32_t element,
                        const FlowStep& step, double dt, std::size_t thread) {
  double& damage = model.triangles.plastic.damage[element];
  const double after = damage < 1 ? damageAfter(m, damage, step, dt) : damage;
  if (after == damage) return;
  threads_[thread].former.push_back({element, damage});
  if (after >= 1) threads_[thread].failed.push_back(element);
  damage = after;
}

void PlasticDamage::takeBack(Model& model) {
  for (Thread& one : threads_) {
    for (const Former& former : one.former)
      model.triangles.plastic.damage[former.element] = former.damage;
    one.former.clear(), one.failed.clear();
  }
}

void PlasticDamage::appendFailed(std::vector<ElementRange>& ranges) const {
  const auto append = [&](const std::vector<std::uint32_t>& elements) {
    for (const std::uint32_t e : elements) ranges.push_back({e, e + 1});
  };
  append(failed_);
  for (const Thread& one : threads_) append(one.failed);
}

}  // namespace yadefrag
