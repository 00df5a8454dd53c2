#include "step/kinetic_watch.hpp"

#include <algorithm>

#include "core/tolerances.hpp"

namespace yadefrag {

void KineticWatch::begin(double dt, double total, double energy) {
  dt_ = dt, total_ = total, most_ = energy, looked_ = told_ = 0;
}

bool KineticWatch::isDue(std::uint64_t step) { return step % tolerance::kStepsToLook == 0; }

bool KineticWatch::isSuspicious(double kinetic, double spent) {
  most_ = std::max(most_, total_ - spent);
  const double over = kinetic - (total_ - spent);
  if (!(over > tolerance::kGivenEnergy * most_ && over > tolerance::kLookAgain * looked_))
    return false;
  looked_ = over;
  return true;
}

double KineticWatch::excess(double energy, double spent, double noise) const {
  const double over = energy - (total_ - spent);
  const double tolerated = std::max(tolerance::kGivenEnergy, 2 * told_) * most_;
  return over > std::max(tolerated, noise) ? over : 0;
}

double KineticWatch::tell(double excess) { return told_ = most_ > 0 ? excess / most_ : 1; }

}  // namespace yadefrag
