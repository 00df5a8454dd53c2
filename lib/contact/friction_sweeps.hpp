#pragma once
// Normal forces and friction of a group in rubble by sweeps from contact to contact (nonlinear
// block Gauss–Seidel of Moreau and Jean's contact dynamics). With both faces of every crack, each
// contact shares nodes with a dozen others, many of them say the same, and bounds of friction
// change with every normal force. The exact solves for given bounds then take ten times longer, and
// where pieces jam they grow forces that cancel each other, which friction turns into energy.
// Sweeps from the last step's forces stay near them.

#include <cstdint>
#include <span>
#include <vector>

#include "contact/box_problem.hpp"

namespace yadefrag {

/// The unknowns of one contact.
struct ContactUnknowns {
  std::uint32_t normal, tangent;  ///< tangent = kNoTangent: none
  double friction;
};
inline constexpr std::uint32_t kNoTangent = 0xffffffff;

/// Improves `lambda` (N) until no gap or slip changes by more than `tolerance` (m) in a sweep, or
/// for long enough; returns the last change (m). `mostForce` (N): larger normal forces bound
/// friction no further.
double sweepFriction(const BoxProblem& problem, std::span<const ContactUnknowns> contacts,
                     double mostForce, double tolerance, std::vector<double>& lambda);

}  // namespace yadefrag
