#include "fracture/cohesive_law.hpp"

#include <algorithm>

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
  const double kink = largestOpening + compliance * held;
  return trial < kink ? held * (trial / kink) : held;
}

}  // namespace yadefrag
