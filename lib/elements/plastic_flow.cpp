#include "elements/plastic_flow.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

#include "core/tolerances/dynamics.hpp"
#include "elements/element_state.hpp"
#include "elements/plastic_return.hpp"

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

void PlasticDamage::undo(Model& model) {
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

namespace {

/// State of a triangle before it flowed.
YieldPoint pointOf(const FormerLanes& former, std::uint32_t k) {
  YieldPoint point;
  for (std::size_t i = 0; i < 4; ++i) point.edges[i] = former.edges[i][k];
  point.thickness = former.thickness[k], point.strain = former.strain[k];
  point.temperature = former.temperature[k];
  return point;
}

/// Replaces a chunk's volumes by U'(J) (Pa); by local number.
const double* toPressures(NodeSums<double>& volumes, const Model& model,
                          const ElementChunks& elements, const Chunk& chunk) {
  double* value = volumes.whole(elements, chunk);
  const double halfBulk = SolidModuli(model.components[chunk.firstComponent].material).bulk / 2;
  for (std::uint32_t i = 0; i < chunk.lastNode - chunk.firstNode; ++i) {
    const double own = model.nodes.mass[elements.nodes[chunk.firstNode + i].value];
    const double ratio = value[i] * chunk.density / own;
    value[i] = own > 0 ? halfBulk * (ratio - 1 / ratio) : 0;
  }
  return value;
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
  for (FlowRoom& one : threads_) one.former.clear(), one.squaredSteepest = 0;
  restored_ = 0;
  damage_.begin(threads_.size());
  dissipated_.assign(elements.chunks.size(), 0);
  dt_ = dt;
}

PlasticChunk PlasticFlow::inputOf(Model& model, const ElementChunks& elements, const Chunk& chunk) {
  PlasticState& state = model.triangles.plastic;
  PlasticChunk in{.edges = {state.edges[0].data(), state.edges[1].data(), state.edges[2].data(),
                            state.edges[3].data()},
                  .thickness = state.thickness.data(),
                  .strain = state.strain.data(),
                  .temperature = state.temperature.data(),
                  .yield = yield_.data(),
                  .thermal = thermal_.data(),
                  .constants = YieldConstants(model.components[chunk.firstComponent]),
                  .dt = dt_,
                  .nodes = elements.nodes.data() + chunk.firstNode,
                  .velocity = model.nodes.velocity.data(),
                  .pressure = isSmoothed(chunk) ? now_.of(chunk) : nullptr,
                  .hoops = elements.hoopsIfAny()};
  if (opensVolume(model, chunk))
    in.formerPressure = before_.of(chunk), in.opening = opening_.data();
  return in;
}

void PlasticFlow::sum(InstructionSet set, Model& model, const ElementChunks& elements,
                      const Chunk& chunk, const Vec2* position, std::size_t thread) {
  const PlasticChunk in = inputOf(model, elements, chunk);
  sumVolumes(set, chunk, elements.lanes.data(), in, position, now_.begin(chunk));
  now_.end(elements, chunk);
  if (!opensVolume(model, chunk)) return;
  std::vector<Vec2>& room = threads_[thread].before;
  room.clear();
  const Vec2* former = in.before(chunk, position, room);
  sumVolumes(set, chunk, elements.lanes.data(), in, former, before_.begin(chunk));
  before_.end(elements, chunk);
}

void PlasticFlow::sumShared(const ElementChunks& elements, std::size_t row) {
  now_.sumShared(elements, row);
  if (!isOpening()) return;
  before_.sumShared(elements, row);
  opened_.sumShared(elements, row);
}

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
      if (isSmoothed(chunk)) sum += now_.of(chunk)[corner] * model.massShare(ElementId(element), i);
    }
    double thickness = 1;
    const TriangleEdges edges{x[1] - x[0], x[2] - x[0], hoopStretch(model, ElementId(element))};
    const ElasticTrial now = trialOf(c, point, edges, thickness);
    const double mean =
        isSmoothed(chunk) ? sum / 3 * now.volume : meanStress(now.volume, c.moduli.bulk);
    const double size = edges.twiceArea() / (2 * model.triangles.area[element]) * edges.hoop;
    return FlowStep{strain,
                    temperature,
                    mean,
                    c.moduli.shear * std::sqrt(now.squaredMises()),
                    c.plastic.isFrictional() ? size : now.volume,
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
  toPressures(now_, model, elements, own);
  toPressures(before_, model, elements, own);
  const PlasticChunk in = inputOf(model, elements, own);
  openVolumes(set, own, elements.lanes.data(), in, position, opened_.begin(own));
  opened_.end(elements, own);
}

bool PlasticFlow::addForces(InstructionSet set, Model& model, const ElementChunks& elements,
                            std::size_t chunk, const Vec2* position, Vec2* force,
                            std::size_t thread) {
  const Chunk& own = elements.chunks[chunk];
  PlasticChunk in = inputOf(model, elements, own);
  if (opensVolume(model, own))
    in.pressure = toPressures(opened_, model, elements, own);
  else if (isSmoothed(own))
    toPressures(now_, model, elements, own);
  FlowRoom& room = threads_[thread];
  const std::size_t first = room.former.size();
  room.before.clear(), room.dissipated = 0;
  const bool good = addPlasticForces(set, own, elements.lanes.data(), in, position, room, force);
  dissipated_[chunk] = room.dissipated;
  if (model.components[own.firstComponent].fails())
    addDamage(model, elements, own, position, thread, first);
  return good;
}

double PlasticFlow::dissipation() const {
  double sum = 0;
  for (const double one : dissipated_) sum += one;
  return sum;
}

void PlasticFlow::undo(Model& model) {
  PlasticState& state = model.triangles.plastic;
  for (FlowRoom& one : threads_) {
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
  damage_.undo(model);
  std::ranges::fill(dissipated_, 0);
}

bool PlasticFlow::isSteeper(const Steepness& steepness) {
  constexpr double kLimit = (1 + tolerance::kSteeper) * (1 + tolerance::kSteeper);
  return steepness.last > kLimit * steepness.known;
}

PlasticFlow::Steepness PlasticFlow::steepness() const {
  double last = restored_;
  for (const FlowRoom& one : threads_) last = std::max(last, one.squaredSteepest);
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
