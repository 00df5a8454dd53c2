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

/// State of a triangle before it flowed.
YieldPoint pointOf(const FormerLanes& former, std::uint32_t k) {
  YieldPoint point;
  for (std::size_t i = 0; i < 4; ++i) point.edges[i] = former.edges[i][k];
  point.thickness = former.thickness[k], point.strain = former.strain[k];
  point.temperature = former.temperature[k];
  return point;
}

bool isSmoothed(const Chunk& chunk) {
  return chunk.yields && chunk.element == ElementKind::kSmoothed;
}

/// True if volumes are averaged again after the flow.
bool opensVolume(const Model& model, const Chunk& chunk) {
  return isSmoothed(chunk) && model.components[chunk.firstComponent].plastic.isFrictional();
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
  now_.rebuild(elements, std::ranges::any_of(elements.chunks, isSmoothed));
  const bool opens = std::ranges::any_of(
      elements.chunks, [&](const Chunk& chunk) { return opensVolume(model, chunk); });
  before_.rebuild(elements, opens);
  opened_.rebuild(elements, opens);
  opening_.assign(opens ? model.triangles.size() : 0, 0);
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
  now_.follow(elements, abandoned);
  before_.follow(elements, abandoned);
  opened_.follow(elements, abandoned);
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
  PlasticChunk in{.edges = {state.edges[0].data(), state.edges[1].data(), state.edges[2].data(),
                            state.edges[3].data()},
                  .thickness = state.thickness.data(),
                  .strain = state.strain.data(),
                  .temperature = state.temperature.data(),
                  .yield = yield_.data(),
                  .thermal = thermal_.data(),
                  .cone = constants.cone,
                  .moduli = constants.moduli,
                  .planeStress = body.material.planeStress,
                  .pressure = isSmoothed(chunk) ? now_.of(chunk) : nullptr,
                  .formerPressure = nullptr,
                  .opening = nullptr,
                  .curve = {body.plastic, constants.moduli.shear, constants.heating, dt_}};
  if (opensVolume(model, chunk))
    in.formerPressure = before_.of(chunk), in.opening = opening_.data();
  return in;
}

/// (m) By local number.
const Vec2* PlasticFlow::formerPositions(const Model& model, const ElementChunks& elements,
                                         const Chunk& chunk, const Vec2* position,
                                         Thread& thread) const {
  std::vector<Vec2>& before = thread.before;
  before.resize(chunk.lastNode - chunk.firstNode);
  fetchNodes(elements, chunk, model.nodes.velocity, before.data());
  for (std::size_t i = 0; i < before.size(); ++i) before[i] = position[i] - dt_ * before[i];
  return before.data();
}

void PlasticFlow::sum(InstructionSet set, Model& model, const ElementChunks& elements,
                      const Chunk& chunk, const Vec2* position, std::size_t thread) {
  const PlasticChunk in = inputOf(model, chunk);
  sumVolumes(set, chunk, elements.lanes.data(), in, position, now_.begin(chunk));
  now_.end(elements, chunk);
  if (!opensVolume(model, chunk)) return;
  const Vec2* former = formerPositions(model, elements, chunk, position, threads_[thread]);
  sumVolumes(set, chunk, elements.lanes.data(), in, former, before_.begin(chunk));
  before_.end(elements, chunk);
}

void PlasticFlow::sumShared(const ElementChunks& elements, std::size_t row) {
  now_.sumShared(elements, row);
  if (!isOpening()) return;
  before_.sumShared(elements, row);
  opened_.sumShared(elements, row);
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
    if (thread_.before.empty())
      flow_.formerPositions(model_, elements_, chunk_, position_, thread_);
    return thread_.before.data();
  }

  FormerLanes& former() override { return thread_.former.emplace_back(); }

  void operator()(std::uint32_t firstElement, const std::uint16_t (&corner)[3][kLanes],
                  const std::array<bool, kLanes>& alone, TrialLanes& lanes) override {
    for (std::uint32_t k = 0; k < kLanes; ++k)
      if (alone[k]) turn(firstElement + k, {corner[0][k], corner[1][k], corner[2][k]}, k, lanes);
  }
  [[nodiscard]] double dissipated() const {
    double sum = 0;
    for (const double one : sums.dissipated) sum += one;
    return sum;
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
    NodalPressure pressure{lanes.mean[k] / lanes.volume[k], 0};
    if (opensVolume(model_, chunk_)) {
      pressure.opening = flow_.opening_[element];
      for (const std::uint16_t node : corner)
        pressure.before += flow_.before_.of(chunk_)[node] * (1. / 3);
    }
    const TriangleMotion motion{
        edges(position_), edges(last),
        edges(position_).twiceArea() / (2 * model_.triangles.area[element])};
    const Returned back = returnToYield(constants_, point, motion, flow_.dt_,
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
  const auto stepOf = [&](std::uint32_t element, const YieldPoint& point, double strain,
                          double temperature) {
    const std::uint32_t place = element - chunk.firstElement;
    const ElementLanes& lanes = elements.lanes[chunk.firstLanes + place / kLanes];
    std::array<Vec2, 3> x;
    double sum = 0;
    for (std::size_t i = 0; i < 3; ++i) {
      const std::uint16_t corner = lanes.corner[i][place % kLanes];
      x[i] = position[corner];
      if (isSmoothed(chunk)) sum += now_.of(chunk)[corner];
    }
    double thickness = 1;
    const ElasticTrial now = trialOf(c, point, {x[1] - x[0], x[2] - x[0]}, thickness);
    const double mean =
        isSmoothed(chunk) ? sum / 3 * now.volume : meanStress(now.volume, c.moduli.bulk);
    const double twice = TriangleEdges{x[1] - x[0], x[2] - x[0]}.twiceArea();
    return FlowStep{
        strain,
        temperature,
        mean,
        c.moduli.shear * std::sqrt(now.squaredMises()),
        c.plastic.isFrictional() ? twice / (2 * model.triangles.area[element]) : now.volume,
        state.resistanceOf(element)};
  };
  for (std::size_t i = first; i < threads_[thread].former.size(); ++i) {
    const FormerLanes& former = threads_[thread].former[i];
    for (std::uint32_t k = 0; k < former.count; ++k) {
      const std::uint32_t e = former.first + k;
      const double flowed = state.strain[e] - former.strain[k];
      if (!(flowed > 0)) continue;
      const double temperature = former.temperature[k];
      const YieldPoint point = c.plastic.isFrictional() ? pointOf(former, k) : YieldPoint(state, e);
      damage_.add(model, c.plastic, e, stepOf(e, point, flowed, temperature), dt_, thread);
    }
  }
  if (c.plastic.failure.spallStress == FailureLaw::kNone) return;
  if (c.plastic.isFrictional()) return;  // a cone flows at its limit
  for (std::uint32_t e = chunk.firstElement; e < chunk.lastElement; ++e)
    damage_.add(model, c.plastic, e, stepOf(e, YieldPoint(state, e), 0, 0), dt_, thread);
}

void PlasticFlow::open(InstructionSet set, Model& model, const ElementChunks& elements,
                       std::size_t chunk, const Vec2* position) {
  const Chunk& own = elements.chunks[chunk];
  if (!opensVolume(model, own)) return;
  const double bulk = SolidModuli(model.components[own.firstComponent].material).bulk;
  now_.toPressures(elements, own, model.nodes.mass, bulk);
  before_.toPressures(elements, own, model.nodes.mass, bulk);
  const PlasticChunk in = inputOf(model, own);
  openVolumes(set, own, elements.lanes.data(), in, position, opened_.begin(own));
  opened_.end(elements, own);
}

bool PlasticFlow::addForces(InstructionSet set, Model& model, const ElementChunks& elements,
                            std::size_t chunk, const Vec2* position, Vec2* force,
                            std::size_t thread) {
  const Chunk& own = elements.chunks[chunk];
  const double bulk = SolidModuli(model.components[own.firstComponent].material).bulk;
  PlasticChunk in = inputOf(model, own);
  if (opensVolume(model, own))
    in.pressure = opened_.toPressures(elements, own, model.nodes.mass, bulk);
  else if (isSmoothed(own))
    now_.toPressures(elements, own, model.nodes.mass, bulk);
  Thread& room = threads_[thread];
  Lanes flow(*this, model, elements, own, position, room);
  const std::size_t first = room.former.size();
  const bool good = addPlasticForces(set, own, elements.lanes.data(), in, position, flow, force);
  dissipated_[chunk] = flow.dissipated();
  for (const double one : flow.sums.steepest)
    room.squaredSteepest = std::max(room.squaredSteepest, one);
  if (model.components[own.firstComponent].fails())
    addDamage(model, elements, own, position, thread, first);
  return good;
}

}  // namespace yadefrag
