#include "contact/friction_sweeps.hpp"

#include <algorithm>
#include <cmath>

#include "core/tolerances.hpp"

namespace yadefrag {
namespace {

struct Sweep {
  const BoxProblem& problem;
  std::vector<double>& lambda;
  double change = 0;  // m

  /// Sets one unknown so that its own gap or slip vanishes, as far as the bounds allow.
  void set(std::uint32_t row, double lower, double upper) {
    double rest = problem.constant[row], diagonal = 0;
    for (std::uint32_t k = problem.offsets[row]; k < problem.offsets[row + 1]; ++k) {
      rest += problem.values[k] * lambda[problem.columns[k]];
      if (problem.columns[k] == row) diagonal = problem.values[k];
    }
    if (!(diagonal > 0)) return;  // all its nodes are held
    const double next = std::clamp(lambda[row] - rest / diagonal, lower, upper);
    change = std::max(change, std::abs(next - lambda[row]) * diagonal);
    lambda[row] = next;
  }
};

}  // namespace

double sweepFriction(const BoxProblem& problem, std::span<const ContactUnknowns> contacts,
                     double mostForce, double tolerance, std::vector<double>& lambda) {
  double change = 0;
  for (int i = 0; i < tolerance::kFrictionSweeps; ++i) {
    Sweep sweep{problem, lambda};
    for (const ContactUnknowns& contact : contacts) {
      sweep.set(contact.normal, 0, kNoBound);
      if (contact.tangent == kNoTangent) continue;
      const double bound = contact.friction * std::min(lambda[contact.normal], mostForce);
      sweep.set(contact.tangent, -bound, bound);
    }
    change = sweep.change;
    if (!(change > tolerance) || !std::isfinite(change)) break;
  }
  return change;
}

}  // namespace yadefrag
