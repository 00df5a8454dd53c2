#include "mesh/failure_law.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "core/lane_math.hpp"
#include "core/tolerances/plasticity.hpp"
#include "mesh/material_constants.hpp"

namespace yadefrag {
namespace {

/// Of a power that is a finite number, far above any strain.
constexpr double kMostExponent = 500;

double ofTriaxiality(const FailureLaw& law, double triaxiality) {
  const double most = std::min(triaxiality, tolerance::kMostTriaxiality);
  return law.d1 + law.d2 * expOf(std::min(law.d3 * most, kMostExponent));
}

/// Of the formula, whose failure strain must be positive at any state.
std::string wrongFormula(const FailureLaw& law, bool heats) {
  using M = FailureLaw;
  const auto refuse = [&](double M::*member, const char* right) {
    return failureConstants().wrong(law, member, right);
  };
  if (!(law.d2 >= 0)) return refuse(&M::d2, "0 or positive");
  if (!(law.d3 <= 0))
    return refuse(&M::d3, "0 or negative, since tension reduces the failure strain");
  const double least = ofTriaxiality(law, tolerance::kMostTriaxiality);
  if (!(least > 0) && !(law.strain < FailureLaw::kNone))
    return fmt::format(
        "failureD1, failureD2 and failureD3 give the failure strain {:g} where the mean stress is "
        "1.5 times von Mises' stress; it must be positive there, or failureStrain given as the "
        "least one.",
        least);
  if (!(1 + law.d4 * std::log(tolerance::kMostRate) > 0))
    return refuse(&M::d4, "at least -0.04, for a positive failure strain at any rate");
  if (!(law.d5 > -1))
    return refuse(&M::d5, "above -1, for a positive failure strain up to melting");
  if (law.d5 != 0 && !heats) return refuse(&M::d5, "0, or meltTemperature above startTemperature");
  return {};
}

}  // namespace

std::string FailureLaw::wrong(bool heats) const {
  using M = FailureLaw;
  const Constants<M> all = failureConstants();
  if (std::string sentence = all.wrong(*this); !sentence.empty()) return sentence;
  if (energy > 0 && !isOn())
    return all.wrong(*this, &M::energy,
                     "0 unless failureStrain, failureD1, failureD2 or spallStress is given");
  if (energy == 0 && spallStress < kNone)
    return all.wrong(*this, &M::energy,
                     "positive if spallStress is given, as a spall must take energy");
  if (hasFormula()) return wrongFormula(*this, heats);
  for (double M::*const d : {&M::d3, &M::d4, &M::d5})
    if (this->*d != 0) return all.wrong(*this, d, "0 unless failureD1 or failureD2 is given");
  return {};
}

double failureStrain(const FailureLaw& law, const FlowState& at) {
  if (!law.hasFormula()) return law.strain;
  double strain = ofTriaxiality(law, at.triaxiality);
  if (at.relativeRate > 1) strain *= 1 + law.d4 * logOf(at.relativeRate);
  strain *= 1 + law.d5 * at.heat;
  const double least = law.strain < FailureLaw::kNone ? law.strain : 0;
  return std::max({strain, least, tolerance::kLeastFailureStrain});
}

}  // namespace yadefrag
