#include "time/explicit_dynamics.hpp"

#include <omp.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <utility>

#include "core/parallel.hpp"
#include "core/tolerances/dynamics.hpp"

namespace yadefrag {

namespace {

/// (m) Least height of all triangles, stress-free: 1/|∇Nᵢ| is the height on corner i.
double leastHeight(const Triangles& triangles) {
  double steepest = 0;  // 1/m²
  for (std::size_t e = 0; e < triangles.size(); ++e) {
    if (triangles.isDropped(e)) continue;
    const auto& i = triangles.inverseEdges[e];
    const Vec2 second{i[0], i[1]}, third{i[2], i[3]}, first = -(second + third);
    steepest = std::max({steepest, dot(first, first), dot(second, second), dot(third, third)});
  }
  return 1 / std::sqrt(steepest);
}

}  // namespace

void ExplicitDynamics::rebuild(const Model& model) {
  elements_.build(model);
  watching_ = elements_.watch(leastStrength_);
  smoothing_.rebuild(elements_);
  flow_.rebuild(model, elements_);
  stressed_.clear();
  force_.assign(model.nodes.size(), {});
  partialForce_.resize(elements_.partials());
  viscousForce_.clear();
  partialViscous_.clear();
  previousPosition_ = model.nodes.position;
  previousVelocity_ = model.nodes.velocity;
  leastHeight_ = leastHeight(model.triangles);
  heldVelocity_.clear();
  heldNodes_.clear();
  bool holds = false;
  for (std::size_t n = 0; n < model.nodes.size(); ++n) {
    if (model.nodes.held[n] == kFree) continue;
    holds = true;
    if (model.nodes.mass[n] != 0) heldNodes_.emplace_back(n);
  }
  if (holds) heldVelocity_ = model.nodes.velocity;
  scratch_.clear();
}

void ExplicitDynamics::reserve(std::size_t nodes) {
  force_.reserve(nodes);
  previousPosition_.reserve(nodes);
  previousVelocity_.reserve(nodes);
  if (!heldVelocity_.empty()) heldVelocity_.reserve(nodes);
  elements_.reserve(nodes);
}

std::size_t ExplicitDynamics::follow(const Model& model, std::span<const ElementId> changed,
                                     std::span<const NodeId> originals) {
  const NodeId firstNew(force_.size());
  assert(firstNew.value + originals.size() == model.nodes.size());
  std::vector<std::uint32_t> abandoned;
  const std::size_t chunks = elements_.follow(model, changed, firstNew, abandoned);
  for (std::vector<Vec2>* partial : {&partialForce_, &partialViscous_})
    if (!partial->empty()) {
      partial->resize(elements_.partials());
      for (const std::uint32_t i : abandoned) (*partial)[i] = {};
    }
  smoothing_.follow(elements_, abandoned);
  flow_.follow(elements_, abandoned);
  force_.resize(model.nodes.size());
  if (!viscousForce_.empty()) viscousForce_.resize(model.nodes.size());
  for (const NodeId original : originals) {
    previousPosition_.push_back(Vec2(previousPosition_[original.value]));
    previousVelocity_.push_back(Vec2(previousVelocity_[original.value]));
    if (model.nodes.held[original.value] != kFree)
      heldNodes_.emplace_back(previousPosition_.size() - 1);
    if (!heldVelocity_.empty()) heldVelocity_.push_back(Vec2(heldVelocity_[original.value]));
  }
  return chunks;
}

void ExplicitDynamics::drop(const Model& model, std::span<const NodeId> nodes) {
  if (heldVelocity_.empty()) return;
  for (const NodeId node : nodes) heldVelocity_[node.value] = {};
  std::erase_if(heldNodes_, [&](NodeId node) { return model.nodes.mass[node.value] == 0; });
}

void ExplicitDynamics::setStressLimits(std::vector<double> leastStrengthByComponent) {
  leastStrength_ = std::move(leastStrengthByComponent);
  watching_ = elements_.watch(leastStrength_);
}

/// v ← kept·v + (rate/m)·f + fall, x ← x + Δt v
struct ExplicitDynamics::Update {
  double dt, kept, rate;
  double largeSpeed;  // m/s
  Vec2 fall;          // m/s
  double outerPart;   // of Δv: duration of external forces
  double lastDt;      // s, step before this one
  std::span<const Vec2> outer, load;
  int threads;
};

void ExplicitDynamics::smoothStrains(Model& model, std::size_t part, std::size_t parts,
                                     PartErrors& errors) {
  Scratch& scratch = scratch_[part];
  const std::size_t chunks = elements_.chunks.size();
  errors.run(static_cast<int>(part), [&] {
    for (std::size_t c = chunks * part / parts; c < chunks * (part + 1) / parts; ++c) {
      const Chunk& chunk = elements_.chunks[c];
      if (chunk.element != ElementKind::kSmoothed) continue;
      fetchNodes(elements_, chunk, model.nodes.position, scratch.values.data());
      if (chunk.yields)
        flow_.sum(set_, model, elements_, chunk, scratch.values.data(), part);
      else if (!smoothing_.sum(set_, elements_, chunk, scratch.values.data(), scratch.stressed))
        handleFlat(model, chunk, scratch);
    }
  });
#pragma omp barrier
  const std::size_t rows = elements_.sharedNodes.size();
  const std::size_t begin = rows * part / parts, end = rows * (part + 1) / parts;
  if (smoothing_.isOn())
    for (std::size_t row = begin; row < end; ++row) smoothing_.sumShared(elements_, row);
  if (flow_.isSmoothing())
    for (std::size_t row = begin; row < end; ++row) flow_.sumShared(elements_, row);
#pragma omp barrier
  if (!flow_.isOpening()) return;
  errors.run(static_cast<int>(part), [&] {
    for (std::size_t c = chunks * part / parts; c < chunks * (part + 1) / parts; ++c) {
      fetchNodes(elements_, elements_.chunks[c], model.nodes.position, scratch.values.data());
      flow_.open(set_, model, elements_, c, scratch.values.data());
    }
  });
#pragma omp barrier
  for (std::size_t row = begin; row < end; ++row) flow_.sumShared(elements_, row);
#pragma omp barrier
}

void ExplicitDynamics::sumForces(Model& model, std::size_t index, std::size_t part,
                                 const Vec2* position, Vec2* force) {
  const Chunk& chunk = elements_.chunks[index];
  Scratch& scratch = scratch_[part];
  const ElementLanes* lanes = elements_.lanes.data();
  const ElementLaws* laws = elements_.lawsOf(chunk);
  if (chunk.yields) {
    if (!flow_.addForces(set_, model, elements_, index, position, force, part))
      handleFlat(model, chunk, scratch);
  } else if (chunk.element == ElementKind::kSmoothed) {
    smoothing_.addForces(set_, elements_, chunk, model.nodes.mass, scratch.room, force);
  } else {
    if (!addElasticForces(set_, chunk, lanes, laws, elements_.hoopsIfAny(), position, force,
                          scratch.stressed))
      handleFlat(model, chunk, scratch);
  }
}

void ExplicitDynamics::sumChunk(Model& model, std::size_t index, const BulkViscosity& viscosity,
                                std::size_t part) {
  const Chunk& chunk = elements_.chunks[index];
  Scratch& scratch = scratch_[part];
  const std::size_t count = chunk.lastNode - chunk.firstNode;
  Vec2* position = scratch.values.data();
  Vec2* force = position + elements_.mostNodes;
  const ElementLanes* lanes = elements_.lanes.data();
  const ElementLaws* laws = elements_.lawsOf(chunk);
  const bool fromNodes = chunk.element == ElementKind::kSmoothed && !chunk.yields;
  if (!fromNodes || viscosity.isOn()) fetchNodes(elements_, chunk, model.nodes.position, position);
  std::fill_n(force, count, Vec2{});
  sumForces(model, index, part, position, force);
  if (std::ranges::find(scratch.flat, chunk.firstElement, &ElementRange::firstElement) !=
      scratch.flat.end())
    addBarrierForces(model, chunk, force);
  if (viscosity.isOn()) {
    Vec2* velocity = force + elements_.mostNodes;
    Vec2* viscous = velocity + elements_.mostNodes;
    fetchNodes(elements_, chunk, model.nodes.velocity, velocity);
    std::fill_n(viscous, count, Vec2{});
    addViscousForces(viscosity, chunk, lanes, laws, model.axisymmetric, position, velocity,
                     viscous);
    for (std::size_t i = 0; i < count; ++i) force[i] += viscous[i];
    scatter(elements_, chunk, viscous, viscousForce_, partialViscous_);
  }
  scatter(elements_, chunk, force, force_, partialForce_);
}

void ExplicitDynamics::sumShared(const BulkViscosity& viscosity, NodeId begin, NodeId end) {
  const auto& shared = elements_.sharedNodes;
  const auto first = std::lower_bound(shared.begin(), shared.end(), begin);
  const auto last = std::lower_bound(first, shared.end(), end);
  for (auto row = first - shared.begin(); row < last - shared.begin(); ++row) {
    const std::uint32_t node = shared[row].value;
    force_[node] = reduce(elements_, partialForce_, row);
    if (viscosity.isOn()) viscousForce_[node] = reduce(elements_, partialViscous_, row);
  }
}

/// Moves held directions at their prescribed velocity. Returns the node's previous velocity, which
/// may differ from the prescribed one: that change is work of the prescribed motion, too.
Vec2 ExplicitDynamics::applyHeld(const Nodes& nodes, std::size_t node, Vec2& velocity) {
  Vec2 before = nodes.velocity[node];
  for (const auto& [axis, flag] : {std::pair{&Vec2::x, kHeldX}, std::pair{&Vec2::y, kHeldY}})
    if ((nodes.held[node] & flag) != 0) {
      velocity.*axis = before.*axis;
      if (!heldVelocity_.empty())
        before.*axis = std::exchange(heldVelocity_[node].*axis, velocity.*axis);
    }
  return before;
}

/// `kForced`: there are loads or external forces.
template <bool kForced>
void ExplicitDynamics::move(Nodes& nodes, const Update& update, std::size_t begin,
                            std::size_t end) {
  const double slow = std::min(speedLimit_, update.largeSpeed);
  const double squaredSlow = slow * slow, squaredLimit = speedLimit_ * speedLimit_;
  const double squaredSwift = update.largeSpeed * update.largeSpeed;
  bool good = true, faster = false, largeSpeed = false;
  for (std::size_t n = begin; n < end; ++n) {
    Vec2 force = force_[n];
    if constexpr (kForced) {
      if (!update.load.empty()) force += update.load[n];
      if (!update.outer.empty()) force += update.outerPart * update.outer[n];
    }
    Vec2 v = update.kept * nodes.velocity[n] + update.rate / nodes.mass[n] * force + update.fall;
    if (nodes.held[n] != kFree) nodes.velocity[n] = applyHeld(nodes, n, v);
    const Vec2 x = nodes.position[n] + update.dt * v;
    previousVelocity_[n] = v;
    previousPosition_[n] = x;
    // The displacement of a slow node is finite, and too small for an overflow.
    const double squared = dot(v, v);
    if (squared <= squaredSlow) [[likely]]
      continue;
    faster = faster || !(squared <= squaredLimit);
    largeSpeed = largeSpeed || !(squared <= squaredSwift);
    good = good && isFinite(x);
  }
  if (faster)
#pragma omp atomic write
    anyAboveSpeedLimit_ = true;
  if (largeSpeed)
#pragma omp atomic write
    anyLargeMove_ = true;
  if (!good)
#pragma omp atomic write
    badNode_ = true;
}

void ExplicitDynamics::step(Model& model, const Update& update, const BulkViscosity& viscosity) {
  const std::size_t count = model.nodes.size();
  const int most = static_cast<int>(model.triangles.size() / elementsPerThread());
  const int threads = std::max(1, std::min(update.threads, most));
  if (scratch_.size() < static_cast<std::size_t>(threads)) scratch_.resize(threads);
  for (Scratch& scratch : scratch_) {
    scratch.stressed.clear(), scratch.flat.clear();
    scratch.values.resize((viscosity.isOn() ? 4 : 2) * elements_.mostNodes);
    if (smoothing_.isOn()) scratch.room.resize(elements_.mostNodes);
  }
  flow_.begin(elements_, threads, update.lastDt);
  PartErrors errors;  // the list of stressed elements may exceed the memory
  // One parallel region for both loops: starting the threads twice would be visible in small
  // scenes.
#pragma omp parallel num_threads(threads) if (threads > 1)
  {
    const std::size_t part = omp_get_thread_num();
    const std::size_t parts = omp_get_num_threads();
    if (smoothing_.isOn() || flow_.isSmoothing()) smoothStrains(model, part, parts, errors);
    const std::size_t chunks = elements_.chunks.size();
    errors.run(static_cast<int>(part), [&] {
      for (std::size_t c = chunks * part / parts; c < chunks * (part + 1) / parts; ++c)
        sumChunk(model, c, viscosity, part);
    });
#pragma omp barrier
    const std::size_t begin = count * part / parts;
    const std::size_t end = count * (part + 1) / parts;
    sumShared(viscosity, NodeId(begin), NodeId(end));
    const bool forced = !update.load.empty() || !update.outer.empty();
    const auto moveAll = forced ? &ExplicitDynamics::move<true> : &ExplicitDynamics::move<false>;
    if (!badElement_ && !errors.any()) (this->*moveAll)(model.nodes, update, begin, end);
  }
  if (errors.any()) flow_.undo(model);
  errors.rethrow();
}

void ExplicitDynamics::collectStressed() {
  // Each thread has successive chunks, so that the joined list is ascending.
  stressed_.clear();
  for (const Scratch& scratch : scratch_)
    stressed_.insert(stressed_.end(), scratch.stressed.begin(), scratch.stressed.end());
  const std::size_t elastic = stressed_.size();
  flow_.appendFailed(stressed_);
  // Bodies with smoothed strains were checked before all others: sort.
  if (smoothing_.isOn() || stressed_.size() != elastic)
    std::sort(stressed_.begin(), stressed_.end());
}

void ExplicitDynamics::predict(Model& model, const StepLength& length, const StepSettings& settings,
                               std::span<const Vec2> outerForces, int threads) {
  assert(force_.size() == model.nodes.size());
  assert(outerForces.empty() || outerForces.size() == model.nodes.size());
  const double dt = length.position;
  const double d = settings.drag(length);
  const double rate = length.velocity / (1 + d);
  badElement_ = badNode_ = anyAboveSpeedLimit_ = anyLargeMove_ = false;
  viscousForce_.resize(settings.viscosity.isOn() ? force_.size() : 0);
  partialViscous_.resize(settings.viscosity.isOn() ? elements_.partials() : 0);
  step(model,
       {dt, (1 - d) / (1 + d), rate, tolerance::kLargeMove * leastHeight_ / dt,
        rate * settings.gravity, dt / length.velocity, 2 * length.velocity - length.position,
        outerForces, model.nodes.load, threads},
       settings.viscosity);
  try {
    collectStressed();
  } catch (...) {  // no memory
    flow_.undo(model);
    throw;
  }
  if (badElement_ || badNode_) flow_.undo(model);
  if (badElement_) refuseElement(model);
  if (badNode_) refuseNode(model);
  model.nodes.position.swap(previousPosition_);
  model.nodes.velocity.swap(previousVelocity_);
}

}  // namespace yadefrag
