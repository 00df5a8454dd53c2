// The world's part in the watch over energy and depth.

#include <sstream>
#include <string>
#include <utility>

#include "core/tolerances.hpp"
#include "step/world.hpp"

namespace yadefrag {

namespace {

/// (J) Of nodes that move by what rounding of their coordinates makes in a step.
double roundingEnergy(const Nodes& nodes, double dt) {
  double sum = 0;
  for (std::size_t n = 0; n < nodes.size(); ++n)
    sum += nodes.mass[n] * dot(nodes.position[n], nodes.position[n]);
  const double speed = tolerance::kSeenMotion / dt;
  return sum * speed * speed / 2;
}

}  // namespace

/// To be told, not to be stopped: the user knows what the run is for.
void World::watchEnergy() {
  const WatchedStep now{steps,
                        time,
                        contactSettings.correction == Correction::kPenalty,
                        contact.maxPenetration(),
                        finest_,
                        search.halo,
                        ledger};
  const auto tell = [this](std::string sentence) {
    if (!sentence.empty()) complaints.push_back(std::move(sentence));
  };
  if (watch.isSuspicious(now))
    tell(watch.complain(now, kineticEnergy(), strainEnergy(), roundingEnergy(model.nodes, lastDt)));
  tell(watch.complainOfDepth(now));
  tell(complainOfMotion());
}

/// Where the step changes all the time, the sum is begun anew as seldom as it is looked at.
std::string World::complainOfMotion() {
  if (!KineticWatch::isDue(steps) && steps > 1) return {};
  const double spent = ledger.total(0, 0);
  if (kinetic_.isNew(lastDt)) {
    const double energy = kineticEnergy() + strainEnergy();
    kinetic_.begin(lastDt, energy + spent, energy);
  }
  const double kinetic = kineticEnergy();
  if (!kinetic_.isSuspicious(kinetic, spent)) return {};
  const double noise = roundingEnergy(model.nodes, lastDt);
  const double excess = kinetic_.excess(kinetic + strainEnergy(), spent, noise);
  if (excess == 0) return {};
  std::ostringstream text;
  text.precision(3);
  text << "Step " << steps << ", time " << time << " s: the bodies' energy has grown by "
       << 100 * kinetic_.tell(excess) << " % out of nothing; take a shorter step: in one of "
       << lastDt << " s they turn or deform too much.";
  return text.str();
}

}  // namespace yadefrag
