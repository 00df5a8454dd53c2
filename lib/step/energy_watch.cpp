#include "step/energy_watch.hpp"

#include <algorithm>
#include <sstream>

#include "core/tolerances.hpp"

namespace yadefrag {

namespace {

std::ostringstream begin(const WatchedStep& step) {
  std::ostringstream text;
  text.precision(3);
  text << "Step " << step.step << ", time " << step.time << " s: ";
  return text;
}

}  // namespace

/// (J) What only ever takes has given what its sum has fallen by. A penalty and a crack that still
/// holds give back what they took: they have given what is below zero.
double EnergyWatch::given(const EnergyLedger& ledger) const {
  return std::max(0., contact - ledger.contact) + std::max(0., friction - ledger.friction) +
         std::max(0., -ledger.fracture);
}

double EnergyWatch::tolerated() const { return std::max(tolerance::kGivenEnergy, 2 * told) * most; }

/// What is given is compared with energies that were looked at before, which may be out of date:
/// they are looked at again only when it has grown.
bool EnergyWatch::isSuspicious(const WatchedStep& step) {
  const EnergyLedger& ledger = step.ledger;
  if (!step.isPenalty) contact = std::max(contact, ledger.contact);
  friction = std::max(friction, ledger.friction);
  const double now = given(ledger);
  return now > tolerated() && now > tolerance::kLookAgain * looked;
}

std::string EnergyWatch::complain(const WatchedStep& step, double kinetic, double strain,
                                  double noise) {
  const EnergyLedger& ledger = step.ledger;
  looked = given(ledger);
  // What they had and got from outside counts, too, where it has been spent since.
  const double had = ledger.total(kinetic, strain) + ledger.external;
  most = std::max({most, kinetic + strain, had});
  if (!(looked > std::max(tolerated(), noise))) return {};
  told = most > 0 ? looked / most : 1;
  const bool byCracks = -ledger.fracture > looked / 2;
  std::ostringstream text = begin(step);
  text << (byCracks ? "cracks that still hold have" : "contact has") << " created " << looked
       << " J, " << 100 * told << " % of the bodies' energy; ";
  if (byCracks)
    text << "take a shorter step, or smaller elements.";
  else if (step.isPenalty)
    text << "take the Lagrangian correction, or a shorter step.";
  else
    text << "take a shorter step, or smaller elements where bodies touch.";
  return text.str();
}

std::string EnergyWatch::complainOfDepth(const WatchedStep& step) {
  const double deep = std::min(tolerance::kDeep * step.shortest, step.halo / 2);
  if (step.depth <= std::max(deep, 2 * toldDepth)) return {};
  toldDepth = step.depth;
  std::ostringstream text = begin(step);
  text << "bodies are in one another by " << step.depth << " m, " << step.depth / step.shortest
       << " of the shortest segment; "
       << (step.isPenalty ? "take the Lagrangian correction, or a larger penalty factor."
                          : "take a shorter step.");
  return text.str();
}

void EnergyWatch::forget(const EnergyLedger& ledger) {
  contact = std::min(contact, ledger.contact);
  friction = std::min(friction, ledger.friction);
  most = looked = told = 0;
}

}  // namespace yadefrag
