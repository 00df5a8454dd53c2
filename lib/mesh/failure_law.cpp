#include "mesh/failure_law.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "core/lane_math.hpp"
#include "core/tolerances/plasticity.hpp"
#include "core/wrong_value.hpp"

namespace yadefrag {
namespace {

/// Of a power that is a finite number, far above any strain.
constexpr double kMostExponent = 500;

double ofTriaxiality(const FailureLaw& law, double triaxiality) {
  const double most = std::min(triaxiality, tolerance::kMostTriaxiality);
  return law.d[0] + law.d[1] * expOf(std::min(law.d[2] * most, kMostExponent));
}

/// Of the formula, whose failure strain must be positive at any state.
std::string wrongFormula(const FailureLaw& law, bool heats) {
  const auto& [d1, d2, d3, d4, d5] = law.d;
  if (!(d2 >= 0)) return wrongValue("failureD2", d2, "", "0 or positive");
  if (!(d3 <= 0))
    return wrongValue("failureD3", d3, "",
                      "0 or negative, since tension reduces the failure strain");
  const double least = ofTriaxiality(law, tolerance::kMostTriaxiality);
  if (!(least > 0) && !(law.strain < FailureLaw::kNone))
    return fmt::format(
        "failureD1, failureD2 and failureD3 give the failure strain {:g} where the mean stress is "
        "1.5 times von Mises' stress; it must be positive there, or failureStrain given as the "
        "least one.",
        least);
  if (!(1 + d4 * std::log(tolerance::kMostRate) > 0))
    return wrongValue("failureD4", d4, "",
                      "at least -0.04, for a positive failure strain at any rate");
  if (!(d5 > -1))
    return wrongValue("failureD5", d5, "", "above -1, for a positive failure strain up to melting");
  if (d5 != 0 && !heats)
    return wrongValue("failureD5", d5, "", "0, or meltTemperature above startTemperature");
  return {};
}

}  // namespace

std::string FailureLaw::wrong(bool heats) const {
  for (std::size_t i = 0; i < d.size(); ++i)
    if (!std::isfinite(d[i]))
      return wrongValue(fmt::format("failureD{}", i + 1), d[i], "", "finite");
  if (!(strain > 0))
    return wrongValue("failureStrain", strain, "", "positive, or infinite for none");
  if (!(spallStress > 0))
    return wrongValue("spallStress", spallStress, " Pa", "positive, or infinite for none");
  if (!(energy >= 0 && std::isfinite(energy)))
    return wrongValue("fractureEnergy", energy, " J/m²", "0 or positive, and finite");
  if (energy > 0 && !isOn())
    return wrongValue("fractureEnergy", energy, " J/m²",
                      "0 unless failureStrain, failureD1, failureD2 or spallStress is given");
  if (energy == 0 && spallStress < kNone)
    return wrongValue("fractureEnergy", energy, " J/m²",
                      "positive if spallStress is given, as a spall must take energy");
  if (hasFormula()) return wrongFormula(*this, heats);
  for (std::size_t i = 2; i < d.size(); ++i)
    if (d[i] != 0)
      return wrongValue(fmt::format("failureD{}", i + 1), d[i], "",
                        "0 unless failureD1 or failureD2 is given");
  return {};
}

double failureStrain(const FailureLaw& law, const FlowState& at) {
  if (!law.hasFormula()) return law.strain;
  double strain = ofTriaxiality(law, at.triaxiality);
  if (at.relativeRate > 1) strain *= 1 + law.d[3] * logOf(at.relativeRate);
  strain *= 1 + law.d[4] * at.heat;
  const double least = law.strain < FailureLaw::kNone ? law.strain : 0;
  return std::max({strain, least, tolerance::kLeastFailureStrain});
}

}  // namespace yadefrag
