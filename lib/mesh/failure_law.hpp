#pragma once
// When a material that yields fails: by damage, or by a tensile mean stress (spall).
//   Damage is the sum of Δp/p_f over the plastic strain (Johnson and Cook 1985, Eng. Fract. Mech.
//   21, 31), with the failure strain
//     p_f = (D₁ + D₂ exp(D₃ σ*)) (1 + D₄ ln(ṗ/ṗ₀)) (1 + D₅ T*),
//   where σ* is the mean stress over von Mises' stress, at most 1.5 as in their paper, and ṗ/ṗ₀ at
//   least 1; or with a constant. A triangle has failed at a damage of 1. A frictional material has
//   a constant, and fails where its tension limit is exceeded before the return.

#include <limits>
#include <string>

namespace yadefrag {

struct FailureLaw {
  static constexpr double kNone = std::numeric_limits<double>::infinity();
  /// Constant failure strain, or the least one of Johnson and Cook's; infinite: none.
  double strain = kNone;
  double d1 = 0, d2 = 0, d3 = 0, d4 = 0, d5 = 0;  ///< D₁ to D₅; all 0: none
  double spallStress = kNone;  ///< Pa, tensile mean stress; infinite: none; of a cone its limit
  double energy = 0;           ///< J/m², that opens a crack; 0: it opens at once

  [[nodiscard]] bool hasFormula() const { return d1 != 0 || d2 != 0; }
  [[nodiscard]] bool hasDamage() const { return hasFormula() || strain < kNone; }
  [[nodiscard]] bool isOn() const { return hasDamage() || spallStress < kNone; }
  bool operator==(const FailureLaw&) const = default;

  /// Empty, or a sentence on the first wrong constant. `heats`: the material has a melting
  /// temperature.
  [[nodiscard]] std::string wrong(bool heats) const;
};

/// State on which the failure strain depends.
struct FlowState {
  double triaxiality;   ///< σ*
  double relativeRate;  ///< ṗ/ṗ₀
  double heat;          ///< T*, from 0 to 1
};

/// p_f; infinite without a law of damage.
[[nodiscard]] double failureStrain(const FailureLaw& law, const FlowState& at);

}  // namespace yadefrag
