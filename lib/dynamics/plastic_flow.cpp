#include "dynamics/plastic_flow.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "core/tolerances/plasticity.hpp"
#include "dynamics/chunk_nodes.hpp"
#include "dynamics/plastic_return.hpp"

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
  thermal_.resize(yield_.size());
  for (const Component& body : model.components)
    if (body.yields())
      for (std::size_t e = body.firstTriangle; e < body.lastTriangle; ++e)
        setYield(body, model.triangles.plastic, e);
  const bool smooths = std::ranges::any_of(elements.chunks, isSmoothed);
  volume_.resize(smooths ? elements.nodes.size() : 0);
  partial_.assign(smooths ? elements.partials() : 0, 0);
  whole_.resize(partial_.size());
  dissipated_.assign(on ? elements.chunks.size() : 0, 0);
  threads_.clear();
  damage_.rebuild(model);
  squaredSteepest_ = restored_ = 0;
  if (on) noteSteepest(model);
}

void PlasticFlow::setYield(const Component& body, const PlasticState& state, std::size_t element) {
  const double temperature = state.temperature[element];
  yield_[element] = yieldStress(body.plastic, state.strain[element], temperature);
  thermal_[element] = thermalFactor(body.plastic, temperature);
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
  restored_ = 0;
  damage_.begin(threads_.size());
  dissipated_.assign(elements.chunks.size(), 0);
  dt_ = dt;
}

PlasticChunk PlasticFlow::inputOf(Model& model, const Chunk& chunk) {
  const Component& body = model.components[chunk.firstComponent];
  PlasticState& state = model.triangles.plastic;
  const YieldConstants constants(body);
  const double* pressure = volume_.data() + chunk.firstNode;
  PlasticChunk in{.edges = {state.edges[0].data(), state.edges[1].data(), state.edges[2].data(),
                            state.edges[3].data()},
                  .thickness = state.thickness.data(),
                  .strain = state.strain.data(),
                  .temperature = state.temperature.data(),
                  .yield = yield_.data(),
                  .thermal = thermal_.data(),
                  .slope = 0,
                  .tensionLimit = std::numeric_limits<double>::infinity(),
                  .moduli = constants.moduli,
                  .planeStress = body.material.planeStress,
                  .pressure = isSmoothed(chunk) ? pressure : nullptr,
                  .curve = {body.plastic, constants.moduli.shear, constants.heating, dt_}};
  if (body.plastic.isFrictional())
    in.slope = std::numbers::sqrt3 * constants.cone.slope, in.tensionLimit = constants.cone.limit;
  return in;
}

void PlasticFlow::sum(InstructionSet set, Model& model, const ElementChunks& elements,
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

/// Returns the elements of a chunk for which there is no vector loop.
class PlasticFlow::Lanes final : public LaneReturn {
 public:
  Lanes(PlasticFlow& flow, Model& model, const ElementChunks& elements, const Chunk& chunk,
        const Vec2* position, Thread& thread)
      : flow_(flow),
        model_(model),
        elements_(elements),
        chunk_(chunk),
        body_(model.components[chunk.firstComponent]),
        constants_(body_),
        position_(position),
        thread_(thread) {
    thread_.before.clear();
  }

  const Vec2* before() override {
    std::vector<Vec2>& before = thread_.before;
    if (before.empty()) {
      before.resize(chunk_.lastNode - chunk_.firstNode);
      fetchNodes(elements_, chunk_, model_.nodes.velocity, before.data());
      for (std::size_t i = 0; i < before.size(); ++i)
        before[i] = position_[i] - flow_.dt_ * before[i];
    }
    return before.data();
  }

  FormerLanes& former() override { return thread_.former.emplace_back(); }

  void operator()(std::uint32_t firstElement, const std::uint16_t (&corner)[3][kLanes],
                  const std::array<bool, kLanes>& alone, TrialLanes& lanes) override {
    for (std::uint32_t k = 0; k < kLanes; ++k)
      if (alone[k]) turn(firstElement + k, {corner[0][k], corner[1][k], corner[2][k]}, k, lanes);
  }

 private:
  void turn(std::uint32_t element, const std::array<std::uint16_t, 3>& corner, std::uint32_t k,
            TrialLanes& lanes) {
    const Vec2* last = before();
    const auto edges = [&](const Vec2* x) {
      return TriangleEdges{x[corner[1]] - x[corner[0]], x[corner[2]] - x[corner[0]]};
    };
    PlasticState& state = model_.triangles.plastic;
    const YieldPoint point(state, element);
    const double pressure = lanes.mean[k] / lanes.volume[k];
    const Returned back = returnToYield(constants_, point, edges(position_), edges(last), flow_.dt_,
                                        isSmoothed(chunk_) ? &pressure : nullptr);
    back.point.put(state, element);
    flow_.setYield(body_, state, element);
    sums.steepest[k] = std::max(sums.steepest[k], squaredGradient(back.point.edges));
    sums.dissipated[k] += back.dissipation * model_.triangles.area[element] * body_.thickness;
    lanes.set(k, back.trial, back.kept);
    lanes.mean[k] = back.mean;
  }

  PlasticFlow& flow_;
  Model& model_;
  const ElementChunks& elements_;
  const Chunk& chunk_;
  const Component& body_;
  YieldConstants constants_;
  const Vec2* position_;
  Thread& thread_;
};

/// Of the groups of triangles that have flowed, from `first` of the thread's list on, and of those
/// whose mean stress exceeds the spall stress.
void PlasticFlow::addDamage(Model& model, const ElementChunks& elements, const Chunk& chunk,
                            const Vec2* position, std::size_t thread, std::size_t first) {
  const YieldConstants c(model.components[chunk.firstComponent]);
  const PlasticState& state = model.triangles.plastic;
  const auto stepOf = [&](std::uint32_t element, double strain, double temperature) {
    const std::uint32_t place = element - chunk.firstElement;
    const ElementLanes& lanes = elements.lanes[chunk.firstLanes + place / kLanes];
    std::array<Vec2, 3> x;
    double sum = 0;
    for (std::size_t i = 0; i < 3; ++i) {
      const std::uint16_t corner = lanes.corner[i][place % kLanes];
      x[i] = position[corner];
      if (isSmoothed(chunk)) sum += volume_[chunk.firstNode + corner];
    }
    double thickness = 1;
    const ElasticTrial now =
        trialOf(c, YieldPoint(state, element), {x[1] - x[0], x[2] - x[0]}, thickness);
    const double mean =
        isSmoothed(chunk) ? sum / 3 * now.volume : meanStress(now.volume, c.moduli.bulk);
    return FlowStep{strain, temperature, mean, c.moduli.shear * std::sqrt(now.squaredMises()),
                    now.volume};
  };
  for (std::size_t i = first; i < threads_[thread].former.size(); ++i) {
    const FormerLanes& former = threads_[thread].former[i];
    for (std::uint32_t k = 0; k < former.count; ++k) {
      const std::uint32_t e = former.first + k;
      const double flowed = state.strain[e] - former.strain[k];
      if (flowed > 0)
        damage_.add(model, c.plastic, e, stepOf(e, flowed, former.temperature[k]), dt_, thread);
    }
  }
  if (c.plastic.failure.spallStress == FailureLaw::kNone) return;
  for (std::uint32_t e = chunk.firstElement; e < chunk.lastElement; ++e)
    damage_.add(model, c.plastic, e, stepOf(e, 0, 0), dt_, thread);
}

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
  Thread& room = threads_[thread];
  Lanes flow(*this, model, elements, own, position, room);
  const std::size_t first = room.former.size();
  const bool good =
      addPlasticForces(set, own, elements.lanes.data(), inputOf(model, own), position, flow, force);
  double dissipated = 0;
  for (const double one : flow.sums.dissipated) dissipated += one;
  dissipated_[chunk] = dissipated;
  for (const double one : flow.sums.steepest)
    room.squaredSteepest = std::max(room.squaredSteepest, one);
  if (model.components[own.firstComponent].fails())
    addDamage(model, elements, own, position, thread, first);
  return good;
}

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

void PlasticFlow::addTo(Footprint& footprint) const {
  footprint.add(Use::kPlasticity, yield_, thermal_, volume_, partial_, whole_, dissipated_,
                threads_);
  for (const Thread& one : threads_) footprint.add(Use::kPlasticity, one.former, one.before);
  damage_.addTo(footprint);
}

}  // namespace yadefrag
