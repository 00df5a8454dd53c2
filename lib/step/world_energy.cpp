// The world's part in the watch over energy and depth.

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
}

}  // namespace yadefrag
