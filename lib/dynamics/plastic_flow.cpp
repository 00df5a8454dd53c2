#include "dynamics/plastic_flow.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "core/tolerances/plasticity.hpp"
#include "dynamics/chunk_nodes.hpp"

namespace yadefrag {
namespace {

/// (1/m²) Largest |∇N|² of a stress-free shape.
double squaredGradient(const std::array<double, 4>& e) {
  const Vec2 second{e[0], e[1]}, third{e[2], e[3]}, first = second + third;
  return std::max({dot(first, first), dot(second, second), dot(third, third)});
}

bool isSmoothed(const Chunk& chunk) {
  return chunk.yields && chunk.element == ElementKind::kSmoothed;
}

}  // namespace

void PlasticFlow::rebuild(const Model& model, const ElementChunks& elements) {
  const bool on = model.triangles.plastic.isUsed();
  yield_.resize(on ? model.triangles.size() : 0);
  for (const Component& body : model.components)
    if (body.yields())
      for (std::size_t e = body.firstTriangle; e < body.lastTriangle; ++e)
        yield_[e] = yieldStress(body.plastic, model.triangles.plastic.strain[e],
                                model.triangles.plastic.temperature[e]);
  const bool smooths = std::ranges::any_of(elements.chunks, isSmoothed);
  volume_.resize(smooths ? elements.nodes.size() : 0);
  partial_.assign(smooths ? elements.partials() : 0, 0);
  whole_.resize(partial_.size());
  dissipated_.assign(on ? elements.chunks.size() : 0, 0);
  threads_.clear();
  squaredSteepest_ = 0;
  if (on) noteSteepest(model);
}

void PlasticFlow::follow(const ElementChunks& elements, std::span<const std::uint32_t> abandoned) {
  if (volume_.empty()) return;
  volume_.resize(elements.nodes.size());
  partial_.resize(elements.partials());
  whole_.resize(elements.partials());
  for (const std::uint32_t i : abandoned) partial_[i] = 0;
}

void PlasticFlow::begin(const ElementChunks& elements, int threads, double dt) {
  if (!isOn()) return;
  if (threads_.size() < static_cast<std::size_t>(threads)) threads_.resize(threads);
  for (Thread& one : threads_) one.former.clear(), one.squaredSteepest = 0;
  dissipated_.assign(elements.chunks.size(), 0);
  dt_ = dt;
}

PlasticChunk PlasticFlow::inputOf(const Model& model, const Chunk& chunk) const {
  const Component& body = model.components[chunk.firstComponent];
  const PlasticState& state = model.triangles.plastic;
  const double* pressure = volume_.data() + chunk.firstNode;
  PlasticChunk in{.edges = {state.edges[0].data(), state.edges[1].data(), state.edges[2].data(),
                            state.edges[3].data()},
                  .thickness = state.thickness.data(),
                  .yield = yield_.data(),
                  .slope = 0,
                  .tensionLimit = std::numeric_limits<double>::infinity(),
                  .moduli = SolidModuli(body.material),
                  .planeStress = body.material.planeStress,
                  .pressure = isSmoothed(chunk) ? pressure : nullptr};
  if (body.plastic.isFrictional()) {
    const Cone cone(body.plastic);
    in.slope = std::numbers::sqrt3 * cone.slope, in.tensionLimit = cone.limit;
  }
  return in;
}

void PlasticFlow::sum(InstructionSet set, const Model& model, const ElementChunks& elements,
                      const Chunk& chunk, const Vec2* position) {
  double* nodes = volume_.data() + chunk.firstNode;
  std::fill_n(nodes, chunk.lastNode - chunk.firstNode, 0.);
  sumVolumes(set, chunk, elements.lanes.data(), inputOf(model, chunk), position, nodes);
  for (std::uint32_t i = chunk.firstShared; i < chunk.lastNode; ++i)
    partial_[elements.partialOf[i]] = volume_[i];
}

void PlasticFlow::sumShared(const ElementChunks& elements, std::size_t row) {
  const std::uint32_t begin = elements.firstPartial[row], end = elements.firstPartial[row + 1];
  double sum = 0;
  for (std::uint32_t i = begin; i < end; ++i) sum += partial_[i];
  std::fill(whole_.begin() + begin, whole_.begin() + end, sum);
}

/// Returns the elements of a chunk.
class PlasticFlow::Lanes final : public LaneReturn {
 public:
  Lanes(PlasticFlow& flow, Model& model, const Chunk& chunk, const NodeId* nodes,
        const Vec2* position, Thread& thread, bool isNodal)
      : flow_(flow),
        model_(model),
        constants_(model.components[chunk.firstComponent]),
        body_(model.components[chunk.firstComponent]),
        nodes_(nodes),
        position_(position),
        thread_(thread),
        isNodal_(isNodal) {}

  void operator()(std::uint32_t firstElement, const std::uint16_t (&corner)[3][kLanes],
                  const std::array<bool, kLanes>& yields, TrialLanes& lanes) override {
    for (std::uint32_t k = 0; k < kLanes; ++k)
      if (yields[k]) turn(firstElement + k, {corner[0][k], corner[1][k], corner[2][k]}, k, lanes);
  }

  double dissipated = 0;  // J

 private:
  void turn(std::uint32_t element, const std::array<std::uint16_t, 3>& corner, std::uint32_t k,
            TrialLanes& lanes) {
    std::array<Vec2, 3> x, moved;
    for (std::size_t i = 0; i < 3; ++i) {
      x[i] = position_[corner[i]];
      moved[i] = flow_.dt_ * model_.nodes.velocity[nodes_[corner[i]].value];
    }
    const TriangleEdges now{x[1] - x[0], x[2] - x[0]};
    const TriangleEdges before{now.first - (moved[1] - moved[0]),
                               now.second - (moved[2] - moved[0])};
    PlasticState& state = model_.triangles.plastic;
    const YieldPoint point(state, element);
    const double pressure = lanes.mean[k] / lanes.volume[k];
    const Returned back =
        returnToYield(constants_, point, now, before, flow_.dt_, isNodal_ ? &pressure : nullptr);
    thread_.former.push_back({element, point});
    back.point.put(state, element);
    flow_.yield_[element] =
        yieldStress(constants_.plastic, back.point.strain, back.point.temperature);
    thread_.squaredSteepest = std::max(thread_.squaredSteepest, squaredGradient(back.point.edges));
    dissipated += back.dissipation * model_.triangles.area[element] * body_.thickness;
    lanes.set(k, back.trial, back.kept);
    lanes.mean[k] = back.mean;
  }

  PlasticFlow& flow_;
  Model& model_;
  YieldConstants constants_;
  const Component& body_;
  const NodeId* nodes_;
  const Vec2* position_;
  Thread& thread_;
  bool isNodal_;
};

bool PlasticFlow::addForces(InstructionSet set, Model& model, const ElementChunks& elements,
                            std::size_t chunk, const Vec2* position, Vec2* force,
                            std::size_t thread) {
  const Chunk& own = elements.chunks[chunk];
  const bool smoothed = isSmoothed(own);
  if (smoothed) {
    for (std::uint32_t i = own.firstShared; i < own.lastNode; ++i)
      volume_[i] = whole_[elements.partialOf[i]];
    const double halfBulk = SolidModuli(model.components[own.firstComponent].material).bulk / 2;
    for (std::uint32_t i = own.firstNode; i < own.lastNode; ++i) {
      const double mass = model.nodes.mass[elements.nodes[i].value];
      const double ratio = volume_[i] * own.density / mass;
      volume_[i] = mass > 0 ? halfBulk * (ratio - 1 / ratio) : 0;
    }
  }
  Lanes flow(*this, model, own, elements.nodes.data() + own.firstNode, position, threads_[thread],
             smoothed);
  const bool good =
      addPlasticForces(set, own, elements.lanes.data(), inputOf(model, own), position, flow, force);
  dissipated_[chunk] = flow.dissipated;
  return good;
}

double PlasticFlow::dissipation() const {
  double sum = 0;
  for (const double one : dissipated_) sum += one;
  return sum;
}

void PlasticFlow::takeBack(Model& model) {
  for (Thread& one : threads_) {
    for (const Former& former : one.former) {
      former.point.put(model.triangles.plastic, former.element);
      const PlasticMaterial& material =
          model.components[model.triangles.component[former.element].value].plastic;
      yield_[former.element] = yieldStress(material, former.point.strain, former.point.temperature);
    }
    one.former.clear(), one.squaredSteepest = 0;
  }
  std::ranges::fill(dissipated_, 0);
}

bool PlasticFlow::isSteeper() const {
  constexpr double kLimit = (1 + tolerance::kSteeper) * (1 + tolerance::kSteeper);
  return std::ranges::any_of(
      threads_, [&](const Thread& one) { return one.squaredSteepest > kLimit * squaredSteepest_; });
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

void PlasticFlow::addTo(Footprint& footprint) const {
  footprint.add(Use::kPlasticity, yield_, volume_, partial_, whole_, dissipated_, threads_);
  for (const Thread& one : threads_) footprint.add(Use::kPlasticity, one.former);
}

}  // namespace yadefrag
