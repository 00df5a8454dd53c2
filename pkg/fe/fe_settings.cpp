// The settings of FESolver: their limits, and their way into the world.

#include <fmt/format.h>

#include <omp.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "core/tolerances/dynamics.hpp"
#include "core/tolerances/step.hpp"
#include "fe/fe_solver.hpp"

namespace yadefrag {

/// One sentence for each setting of earlier versions that a script has changed.
std::vector<std::string> FESolver::unusedSettings() const {
  std::vector<std::string> found;
  const auto add = [&](const std::string& setting, const char* reason) {
    found.push_back(fmt::format("{} has no effect: {} (docs/contact.md).", setting, reason));
  };
  const char* const noPenalty = "forces of contact just prevent interpenetration";
  if (correction != "lagrange") add(fmt::format("correction='{}'", correction), noPenalty);
  if (penaltyFactor != kPenaltyFactor)
    add(fmt::format("penaltyFactor={:g}", penaltyFactor), noPenalty);
  if (entry != "path") add(fmt::format("entry='{}'", entry), "points enter by their path");
  return found;
}

void FESolver::checkSettings() const {
  const auto refuse = [](const char* name, const std::string& value, const char* right) {
    throw std::invalid_argument(
        fmt::format("FESolver.{} is {}, it must be {}.", name, value, right));
  };
  const auto refuseNumber = [&](const char* name, double value, const char* right) {
    refuse(name, fmt::format("{:g}", value), right);
  };
  const auto shown = [](const std::string& text) {
    return text.size() <= 40 ? fmt::format("'{}'", text)
                             : fmt::format("a text of {} bytes", text.size());
  };
  if (correction != "lagrange" && correction != "penalty")
    refuse("correction", shown(correction), "'lagrange' or 'penalty'");
  if (entry != "path" && entry != "flags") refuse("entry", shown(entry), "'path' or 'flags'");
  if (view != "component" && view != "fragment" && view != "mises")
    refuse("view", shown(view), "'component', 'fragment' or 'mises'");
  if (passes != 1 && passes != 2) refuseNumber("passes", passes, "1 or 2");
  if (!(penaltyFactor > 0 && penaltyFactor <= 1))
    refuseNumber("penaltyFactor", penaltyFactor, "above 0 and at most 1");
  if (!(halo >= 0 && halo <= tolerance::kWidestHalo))
    refuseNumber("halo", halo,
                 "positive and at most 0.5, or 0 for a width that depends on the speed");
  if (!(damping >= 0 && std::isfinite(damping))) refuseNumber("damping", damping, "0 or positive");
  if (maxCracks < -1) refuseNumber("maxCracks", maxCracks, "0 or positive, or -1 for no limit");
  if (!(minFragmentArea >= 0 && std::isfinite(minFragmentArea)))
    refuseNumber("minFragmentArea", minFragmentArea, "positive (m²), or 0 to keep all fragments");
  if (!gravity.allFinite() || gravity[2] != 0)
    refuse("gravity", fmt::format("({:g}, {:g}, {:g})", gravity[0], gravity[1], gravity[2]),
           "finite, and z must be 0: bodies move in the plane z = 0 only");
  const auto isViscosity = [](double v) { return v >= 0 && v <= tolerance::kMostViscosity; };
  const char* viscosity = "0 or positive, and at most 1e6";
  if (!isViscosity(linearViscosity)) refuseNumber("linearViscosity", linearViscosity, viscosity);
  if (!isViscosity(quadraticViscosity))
    refuseNumber("quadraticViscosity", quadraticViscosity, viscosity);
}

void FESolver::postLoad(FESolver& /*self*/) {
  try {
    checkSettings();
  } catch (const std::invalid_argument&) {
    // The world still has the previous values.
    const StepSettings& step = world_.dynamicsSettings;
    correction = formerCorrection_;
    entry = formerEntry_;
    view = formerView_;
    passes = world_.contactSettings.passes;
    penaltyFactor = formerPenaltyFactor_;
    halo = world_.contactSettings.halo;
    damping = step.damping;
    gravity = formerGravity_;
    const std::uint64_t most = world_.fracture.maxCracks;
    maxCracks = most > std::numeric_limits<int>::max() ? -1 : static_cast<int>(most);
    minFragmentArea = world_.fracture.minFragmentArea;
    linearViscosity = step.viscosity.linear, quadraticViscosity = step.viscosity.quadratic;
    throw;
  }
  giveSettings();
}

void FESolver::giveSettings() {
  world_.contactSettings.passes = passes;
  world_.contactSettings.halo = halo;
  world_.dynamicsSettings.damping = damping;
  formerGravity_ = gravity;
  formerView_ = view;
  formerCorrection_ = correction, formerEntry_ = entry, formerPenaltyFactor_ = penaltyFactor;
  // Gravity that was taken over is kept until the next step takes it over again.
  if (!takesOver()) world_.dynamicsSettings.gravity = {gravity[0], gravity[1]};
  world_.dynamicsSettings.viscosity = {linearViscosity, quadraticViscosity};
  world_.fracture.maxCracks =
      maxCracks < 0 ? ~std::uint64_t{0} : static_cast<std::uint64_t>(maxCracks);
  world_.fracture.minFragmentArea = minFragmentArea;
  world_.threads = threadsToUse();
}

int FESolver::threadsToUse() const {
  const int most = omp_get_max_threads();
  return ompThreads > 0 ? std::min(ompThreads, most) : most;
}

}  // namespace yadefrag
