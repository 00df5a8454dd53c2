// PlasticFlow after a step: its work, undoing, and the steepness of triangles.

#include <algorithm>

#include "core/tolerances/plasticity.hpp"
#include "dynamics/plastic_flow.hpp"

namespace yadefrag {

double PlasticFlow::dissipation() const {
  double sum = 0;
  for (const double one : dissipated_) sum += one;
  return sum;
}

void PlasticFlow::takeBack(Model& model) {
  PlasticState& state = model.triangles.plastic;
  for (Thread& one : threads_) {
    for (const FormerLanes& former : one.former) {
      const Component& body = model.components[model.triangles.component[former.first].value];
      for (std::uint32_t k = 0; k < former.count; ++k) {
        const std::size_t e = former.first + k;
        for (std::size_t i = 0; i < 4; ++i) state.edges[i][e] = former.edges[i][k];
        state.thickness[e] = former.thickness[k];
        state.strain[e] = former.strain[k], state.temperature[e] = former.temperature[k];
        setYield(body, state, e);
      }
    }
    one.former.clear(), one.squaredSteepest = 0;
  }
  damage_.takeBack(model);
  std::ranges::fill(dissipated_, 0);
}

bool PlasticFlow::isSteeper(const Steepness& steepness) {
  constexpr double kLimit = (1 + tolerance::kSteeper) * (1 + tolerance::kSteeper);
  return steepness.last > kLimit * steepness.known;
}

PlasticFlow::Steepness PlasticFlow::steepness() const {
  double last = restored_;
  for (const Thread& one : threads_) last = std::max(last, one.squaredSteepest);
  return {squaredSteepest_, last};
}

void PlasticFlow::restore(const Steepness& steepness) {
  squaredSteepest_ = steepness.known, restored_ = steepness.last;
}

void PlasticFlow::noteSteepest(const Model& model) {
  squaredSteepest_ = 0;
  for (const Component& body : model.components)
    if (body.yields())
      for (std::size_t e = body.firstTriangle; e < body.lastTriangle; ++e)
        if (!model.triangles.isDropped(e))
          squaredSteepest_ = std::max(
              squaredSteepest_, squaredGradient(YieldPoint(model.triangles.plastic, e).edges));
}

}  // namespace yadefrag
