#include "step/energy_watch.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "core/tolerances/step.hpp"
#include "step/overlap_check.hpp"
#include "step/stages.hpp"
#include "time/critical_time_step.hpp"

namespace yadefrag {

namespace {

/// 152 of 298 random scenes no longer give the message at a sixteenth of the step (November 2026).
const char* const kShorterStep = "take a shorter step, which helps in about half of such scenes";

std::string begin(const WatchedStep& step) {
  return fmt::format("Step {}, time {:.3g} s: ", step.step, step.time);
}

/// `most` (J): 0 for bodies that were always at rest.
std::string amountText(double amount, double most) {
  std::string text = fmt::format("{:.3g} J", amount);
  if (!(most > 0)) return text;
  return fmt::format("{}, {:.3g} % of the bodies' energy", text, 100 * amount / most);
}

/// Sums over all bodies are computed only for an amount that has grown since the last ones.
bool mustEvaluate(double amount, double tolerated, double& looked) {
  if (!(amount > tolerated && amount > tolerance::kEvaluateAgain * looked)) return false;
  looked = amount;
  return true;
}

/// (m) The deepest overlap of straight boundaries, at any point; arcs deviate from the triangles.
/// All points of bodies that can crack are slaves: only the other bodies, if two or more, are
/// checked.
double overlapOfBoundaries(const WorldState& state, int threads) {
  const Model& model = state.model;
  const ContactSurfaces& surfaces = state.surfaces;
  const auto isChecked = [&](const Component& body) {
    return !body.rigid && !body.brittle.cracks();
  };
  if (std::ranges::count_if(model.components, isChecked) < 2) return 0;
  std::vector<std::uint8_t> straight(model.nodes.size());
  // Interior nodes may come last; nodeSegment ends before them.
  for (std::size_t n = 0; n < surfaces.nodeSegment.size(); ++n) {
    const SegmentId segment = surfaces.nodeSegment[n];
    straight[n] = segment != SegmentId::none() && !surfaces.isSmooth(segment) &&
                          isChecked(model.components[model.nodes.component[n].value])
                      ? 1
                      : 0;
  }
  return deepestOverlap(model, straight, threads);
}

}  // namespace

void EnergyWatch::begin(double energy, const EnergyLedger& ledger) {
  expected = energy + ledger.total(0, 0);
  gone = expected + ledger.external - energy;
  most = energy;
  dissipated = ledger.contact + ledger.friction;
  contact = ledger.contact, friction = ledger.friction;
  evaluatedCreated = evaluatedGrown = reportedCreated = reportedGrown = 0;
  knownGrowth = ofChanges = 0;
}

void EnergyWatch::count(const WatchedStep& step) {
  if (lastStep > 0 && step.dt != lastStep) ++changes;
  lastStep = step.dt;
  leastStep = leastStep > 0 ? std::min(leastStep, step.dt) : step.dt;
  mostStep = std::max(mostStep, step.dt);
  // Includes energy that the bodies had or received, even if it has been dissipated since.
  most = std::max(most, expected + step.ledger.external - gone);
  dissipated = std::max(dissipated, step.ledger.contact + step.ledger.friction);
  contact = std::max(contact, step.ledger.contact);
  friction = std::max(friction, step.ledger.friction);
}

/// (J) Energy created. A quantity that can only be dissipated has created as much as its sum has
/// decreased. Contact and friction are one such quantity: a force of friction may reverse the
/// motion of a body, and then receives what the normal force gives, and the other way round; only
/// what exceeds that is counted of one alone. A cohesive crack releases stored energy: it has
/// created energy only if the sum is below zero.
double EnergyWatch::created(const EnergyLedger& ledger) const {
  const double usual = (tolerance::kExchanged - tolerance::kGivenEnergy) * most;
  return std::max(createdByBoth(ledger), exchanged(ledger) - usual) +
         std::max(0., -ledger.fracture);
}

/// (J) By contact and friction together; not below zero by rounding. The sum is that of `count`:
/// without bodies each rounding error would be much.
double EnergyWatch::createdByBoth(const EnergyLedger& ledger) const {
  return std::max(0., dissipated - (ledger.contact + ledger.friction));
}

/// (J) What contact or friction alone has given to the other.
double EnergyWatch::exchanged(const EnergyLedger& ledger) const {
  return std::max(contact - ledger.contact, friction - ledger.friction);
}

double EnergyWatch::tolerated(double reported) const {
  return std::max(tolerance::kGivenEnergy * most, 2 * reported);
}

bool EnergyWatch::mayHaveCreated(const WatchedStep& step) {
  return mustEvaluate(created(step.ledger), tolerated(reportedCreated), evaluatedCreated);
}

std::string EnergyWatch::contactMessage(const WatchedStep& step, double noise) {
  const double amount = created(step.ledger);
  if (!(amount > std::max(tolerated(reportedCreated), noise))) return {};
  reportedCreated = amount;
  if (createdByBoth(step.ledger) + std::max(0., -step.ledger.fracture) < amount) {
    const bool byContact = contact - step.ledger.contact > friction - step.ledger.friction;
    return fmt::format(
        "{}{} has given {} to {}, where corners jam: only the sum of both in fe.energy is right; "
        "{}.",
        yadefrag::begin(step), byContact ? "contact" : "friction",
        amountText(exchanged(step.ledger), most), byContact ? "friction" : "contact", kShorterStep);
  }
  const bool byCracks = -step.ledger.fracture > amount / 2;
  const bool bySplits = byCracks && split > amount / 2;
  const char* const cause = bySplits   ? "cracks in bodies with element='smoothed' have"
                            : byCracks ? "cohesive cracks have"
                                       : "contact has";
  const std::string advice =
      bySplits   ? "the strains of elements that a crack separates are no longer averaged; "
                   "element='linear' avoids this."
      : byCracks ? "a shorter step or smaller elements may help."
                 : fmt::format("{}, or smaller elements where bodies touch.", kShorterStep);
  return fmt::format("{}{} created {}; {}", yadefrag::begin(step), cause, amountText(amount, most),
                     advice);
}

bool EnergyWatch::isDue(std::uint64_t step) {
  return step == 1 || step % tolerance::kStepsToCheck == 0;
}

bool EnergyWatch::mayHaveGrown(const WatchedStep& step, double kinetic) {
  if (step.step % tolerance::kStepsToSumUp == 0) return true;
  if (ofChanges > 0 && knownGrowth + ofChanges > tolerated(reportedGrown)) return true;
  const double over = kinetic - (expected - step.ledger.total(0, 0));
  return mustEvaluate(over, tolerated(reportedGrown), evaluatedGrown);
}

std::string EnergyWatch::growthMessage(const WatchedStep& step, double energy, double noise) {
  const double over = step.ledger.total(energy, 0) - expected;
  knownGrowth = over, ofChanges = 0;
  if (!(over > std::max(tolerated(reportedGrown), noise))) return {};
  reportedGrown = over;
  return fmt::format("{}the time integration has created {}; {}", yadefrag::begin(step),
                     amountText(over, most), stepAdvice(step));
}

std::string EnergyWatch::stepAdvice(const WatchedStep& step) const {
  if (changes > std::max(tolerance::kFewChanges, step.step / tolerance::kStepsPerChange))
    return fmt::format(
        "keep the time step constant, or below a third of the critical one: changing often between "
        "{:.3g} and {:.3g} s, it excites vibrations.",
        leastStep, mostStep);
  return fmt::format(
      "take a shorter step: in one of {:.3g} s the bodies rotate or deform too much.", step.dt);
}

bool EnergyWatch::mayHaveSpun(const WatchedStep& step) const {
  return std::abs(step.ledger.spin) > std::max(tolerance::kGivenSpin * mostSpin, 2 * reportedSpin);
}

std::string EnergyWatch::spinMessage(const WatchedStep& step, double sum) {
  mostSpin = std::max(mostSpin, sum);
  if (!mayHaveSpun(step)) return {};
  reportedSpin = std::abs(step.ledger.spin);
  return fmt::format(
      "{}contact at cracks has created an angular momentum of {:.3g} kg m²/s, {:.3g} % of the sum "
      "of m r v; {}.",
      yadefrag::begin(step), reportedSpin, 100 * reportedSpin / mostSpin, kShorterStep);
}

std::string EnergyWatch::depthMessage(const WatchedStep& step) {
  const double deep = std::min(tolerance::kDeep * step.shortest, step.halo / 2);
  if (step.depth <= std::max(deep, 2 * reportedDepth)) return {};
  reportedDepth = step.depth;
  return fmt::format("{}bodies overlap by {:.3g} m, {:.3g} of the shortest segment; {}.",
                     yadefrag::begin(step), step.depth, step.depth / step.shortest, kShorterStep);
}

bool EnergyWatch::isOverlapDue(std::uint64_t step) {
  return step % tolerance::kStepsToOverlap == 0;
}

std::string EnergyWatch::overlapMessage(const WatchedStep& step, double overlap) {
  if (overlap <= std::max(tolerance::kDeep * step.shortest, 2 * reportedDepth)) return {};
  reportedDepth = overlap;
  return fmt::format(
      "{}bodies overlap by {:.3g} m, {:.3g} of the shortest segment, at points that are not "
      "checked: with passes=1 only those of the finer boundary are; take passes=2.",
      yadefrag::begin(step), overlap, overlap / step.shortest);
}

double roundingEnergy(const WorldState& state, int threads) {
  const Model& model = state.model;
  double moment = 0;  // kg m²
  for (std::size_t n = 0; n < model.nodes.size(); ++n)
    moment += model.nodes.mass[n] * dot(model.nodes.position[n], model.nodes.position[n]);
  const double rate = 2 * tolerance::kRounding / criticalTimeStep(model, {}, threads);
  return static_cast<double>(state.steps) * moment / 2 * rate * rate;
}

void watchEnergy(const StepData& data) {
  WorldState& state = data.state;
  const Settings& settings = data.settings;
  EnergyWatch& watch = state.watch;
  const WatchedStep now{
      state.steps,         state.time,        state.lastDt, state.contact.maxPenetration(),
      data.scratch.finest, state.search.halo, state.ledger};
  const auto report = [&state](std::string sentence) {
    if (!sentence.empty()) state.warnings.push_back(std::move(sentence));
  };
  const auto rounding = [&] { return roundingEnergy(state, settings.threads); };
  watch.count(now);
  if (watch.mayHaveCreated(now)) report(watch.contactMessage(now, rounding()));
  if (EnergyWatch::isDue(state.steps)) {
    if (watch.mayHaveSpun(now)) report(watch.spinMessage(now, sumOfSpins(state.model.nodes)));
    const double kinetic = state.kineticEnergy();
    if (watch.mayHaveGrown(now, kinetic)) {
      const double energy = kinetic + state.strainEnergy() + state.pendingPlastic();
      const double grown = state.ledger.total(energy, 0) - watch.expected;
      // The energy of rounding takes long to compute; it is needed only if the excess is large.
      const bool isMuch = grown > tolerance::kGivenEnergy * watch.most;
      report(watch.growthMessage(now, energy, isMuch ? rounding() : 0));
    }
  }
  report(watch.depthMessage(now));
  if (settings.contactSettings.passes == 1 && EnergyWatch::isOverlapDue(state.steps) &&
      !state.contact.rows().empty())
    report(watch.overlapMessage(now, overlapOfBoundaries(state, settings.threads)));
}

}  // namespace yadefrag
