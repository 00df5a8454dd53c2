#include "step/energy_watch.hpp"

#include <algorithm>
#include <sstream>

#include "core/tolerances/step.hpp"

namespace yadefrag {

namespace {

std::ostringstream begin(const WatchedStep& step) {
  std::ostringstream text;
  text.precision(3);
  text << "Step " << step.step << ", time " << step.time << " s: ";
  return text;
}

/// `most` (J): 0 for bodies that were always at rest.
std::string amountText(double amount, double most) {
  std::ostringstream text;
  text.precision(3);
  text << amount << " J";
  if (most > 0) text << ", " << 100 * amount / most << " % of the bodies' energy";
  return text.str();
}

/// Sums over all bodies are computed only for an amount that has grown since the last ones.
bool mustEvaluate(double amount, double tolerated, double& looked) {
  if (!(amount > tolerated && amount > tolerance::kEvaluateAgain * looked)) return false;
  looked = amount;
  return true;
}

}  // namespace

void EnergyWatch::begin(double energy, const EnergyLedger& ledger) {
  expected = energy + ledger.total(0, 0);
  gone = expected + ledger.external - energy;
  most = energy;
  contact = ledger.contact, friction = ledger.friction;
  evaluatedCreated = evaluatedGrown = reportedCreated = reportedGrown = 0;
}

void EnergyWatch::count(const WatchedStep& step) {
  if (lastStep > 0 && step.dt != lastStep) ++changes;
  lastStep = step.dt;
  leastStep = leastStep > 0 ? std::min(leastStep, step.dt) : step.dt;
  mostStep = std::max(mostStep, step.dt);
  // Includes energy that the bodies had or received, even if it has been dissipated since.
  most = std::max(most, expected + step.ledger.external - gone);
  if (!step.isPenalty) contact = std::max(contact, step.ledger.contact);
  friction = std::max(friction, step.ledger.friction);
}

/// (J) Energy created. A quantity that can only be dissipated has created as much as its sum has
/// decreased. A penalty and a cohesive crack release stored energy: they have created energy only
/// if the sum is below zero.
double EnergyWatch::created(const EnergyLedger& ledger) const {
  return std::max(0., contact - ledger.contact) + std::max(0., friction - ledger.friction) +
         std::max(0., -ledger.fracture);
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
  const bool byCracks = -step.ledger.fracture > amount / 2;
  std::ostringstream text = yadefrag::begin(step);
  const bool bySplits = byCracks && split > amount / 2;
  const char* const cause = bySplits   ? "cracks in bodies with element='smoothed' have"
                            : byCracks ? "cohesive cracks have"
                                       : "contact has";
  text << cause << " created " << amountText(amount, most) << "; ";
  if (bySplits)
    text << "the strains of elements that a crack separates are no longer averaged; "
            "element='linear' avoids this.";
  else if (byCracks)
    text << "take a shorter step, or smaller elements.";
  else if (step.isPenalty)
    text << "take the Lagrangian correction, or a shorter step.";
  else
    text << "take a shorter step, or smaller elements where bodies touch.";
  return text.str();
}

bool EnergyWatch::isDue(std::uint64_t step) {
  return step == 1 || step % tolerance::kStepsToCheck == 0;
}

bool EnergyWatch::mayHaveGrown(const WatchedStep& step, double kinetic) {
  if (step.step % tolerance::kStepsToSumUp == 0) return true;
  const double over = kinetic - (expected - step.ledger.total(0, 0));
  return mustEvaluate(over, tolerated(reportedGrown), evaluatedGrown);
}

std::string EnergyWatch::growthMessage(const WatchedStep& step, double energy, double noise) {
  const double over = step.ledger.total(energy, 0) - expected;
  if (!(over > std::max(tolerated(reportedGrown), noise))) return {};
  reportedGrown = over;
  std::ostringstream text = yadefrag::begin(step);
  text << "the time integration has created " << amountText(over, most) << "; " << stepAdvice(step);
  return text.str();
}

std::string EnergyWatch::stepAdvice(const WatchedStep& step) const {
  std::ostringstream text;
  text.precision(3);
  if (changes > std::max(tolerance::kFewChanges, step.step / tolerance::kStepsPerChange))
    text << "keep the time step constant, or below a third of the critical one: changing often "
            "between "
         << leastStep << " and " << mostStep << " s, it excites vibrations.";
  else
    text << "take a shorter step: in one of " << step.dt
         << " s the bodies rotate or deform too much.";
  return text.str();
}

std::string EnergyWatch::depthMessage(const WatchedStep& step) {
  const double deep = std::min(tolerance::kDeep * step.shortest, step.halo / 2);
  if (step.depth <= std::max(deep, 2 * reportedDepth)) return {};
  reportedDepth = step.depth;
  std::ostringstream text = yadefrag::begin(step);
  text << "bodies overlap by " << step.depth << " m, " << step.depth / step.shortest
       << " of the shortest segment; "
       << (step.isPenalty ? "take the Lagrangian correction, or a larger penalty factor."
                          : "take a shorter step.");
  return text.str();
}

}  // namespace yadefrag
