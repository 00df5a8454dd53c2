#include "fracture/cohesive_law.hpp"

namespace yadefrag {

double envelope(double strength, double criticalOpening, double opening) {
  if (opening >= criticalOpening) return 0;  // with δc = 0, too
  return strength * (criticalOpening - opening) / criticalOpening;
}

double spentEnergy(double strength, double criticalOpening, double largestOpening) {
  return strength * std::min(largestOpening, criticalOpening) / 2;
}

double recoverableEnergy(double strength, double criticalOpening, double largestOpening,
                         double opening) {
  if (largestOpening <= 0) return 0;
  const double held = envelope(strength, criticalOpening, largestOpening);
  return held * opening / largestOpening * opening / 2;
}

double cohesiveTraction(double strength, double criticalOpening, double largestOpening,
                        double trial, double compliance) {
  const double held = envelope(strength, criticalOpening, largestOpening);
  if (held <= 0 || trial <= 0) return 0;
  // T = T(δmax)·δ/δmax with δ = δ* − kT; for δmax = 0 it is what closes the edge.
  const double kink = largestOpening + compliance * held;
  if (trial <= kink) return held * (trial / kink);
  // T = σc(1 − δ/δc) with δ = δ* − kT.
  const double shallow = criticalOpening - compliance * strength;
  if (shallow <= 0 || trial >= criticalOpening) return 0;
  return std::min(held, strength * (criticalOpening - trial) / shallow);
}

}  // namespace yadefrag
