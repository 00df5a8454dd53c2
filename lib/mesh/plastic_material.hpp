#pragma once
// Materials that yield, and how they fail.

#include <cmath>
#include <limits>
#include <string>
#include <vector>

namespace yadefrag {

// --- When a material that yields fails: by damage, or by a tensile mean stress (spall).
//   Damage is the sum of Δp/p_f over the plastic strain (Johnson and Cook 1985, Eng. Fract. Mech.
//   21, 31), with the failure strain
//     p_f = (D₁ + D₂ exp(D₃ σ*)) (1 + D₄ ln(ṗ/ṗ₀)) (1 + D₅ T*),
//   where σ* is the mean stress over von Mises' stress, at most 1.5 as in their paper, and ṗ/ṗ₀ at
//   least 1; or with a constant. A triangle has failed at a damage of 1. A frictional material has
//   a constant, and fails where its tension limit is exceeded before the return.

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

// --- Material constants of yielding, and the yield stress by plastic strain, its rate and
// temperature.
//   Johnson and Cook 1983 (Proc. 7th Int. Symp. Ballistics, 541):
//     Y = Y₀(p) (1 + C ln(ṗ/ṗ₀)) (1 − T*ᵐ),  T* = (T − T₀)/(Tₘ − T₀),  the second factor ≥ 1,
//   with Y₀ = A + B pⁿ, or A (1 + p/p₀)ⁿ (power law), or a table.
// Or Drucker and Prager's cone: √J₂ + η σₘ = ξ c, with η = 3 tan φ/√(9 + 12 tan²φ) and
//   ξ = 3/√(9 + 12 tan²φ), for which the limit loads in plane strain with associated flow are those
//   of Mohr and Coulomb (de Souza Neto, Perić and Owen 2008, eq. 6.125).

/// A point of a table of hardening.
struct HardeningPoint {
  double strain = 0;  ///< plastic strain
  double stress = 0;  ///< Pa
  bool operator==(const HardeningPoint&) const = default;
};

struct PlasticMaterial {
  double yieldStress = 0;        ///< Pa, A; 0: the material never yields
  double hardening = 0;          ///< Pa, B
  double hardeningExponent = 1;  ///< n
  /// p₀ of the power law; 0: A + B pⁿ.
  double offsetStrain = 0;
  std::vector<HardeningPoint> table{};  ///< replaces both, if it is not empty
  double rateFactor = 0;                ///< C
  double referenceRate = 1;             ///< 1/s, ṗ₀
  double thermalExponent = 0;           ///< m; 0: the temperature has no effect
  double meltTemperature = 0;           ///< K, Tₘ
  double startTemperature = 293;        ///< K, T₀, that of the body at the start
  double heatCapacity = 0;              ///< J/(kg K); 0: the temperature stays the same
  double heatShare = .9;                ///< part of the plastic work that becomes heat

  double cohesion = 0;  ///< Pa, c of a frictional material, for which all above has no effect
  double internalFriction = 0;  ///< tan φ
  double dilation = 0;          ///< tan of the dilation angle
  /// Pa, largest mean stress; above that of the cone's apex it has no effect.
  double tensionLimit = std::numeric_limits<double>::infinity();

  FailureLaw failure{};

  [[nodiscard]] bool yields() const { return yieldStress > 0 || !table.empty() || isFrictional(); }
  [[nodiscard]] bool isFrictional() const { return cohesion > 0 || internalFriction > 0; }
  /// True if the yield stress depends linearly on the plastic strain and on nothing else.
  [[nodiscard]] bool isStraight() const {
    return !isFrictional() && table.empty() && offsetStrain == 0 &&
           (hardening == 0 || hardeningExponent == 1) && rateFactor == 0 && thermalExponent == 0;
  }
  [[nodiscard]] bool isHeated() const { return heatCapacity > 0; }
  [[nodiscard]] bool fails() const { return failure.isOn(); }
  bool operator==(const PlasticMaterial&) const = default;

  /// Empty, or a sentence on the first wrong constant.
  [[nodiscard]] std::string wrong() const;
};

/// (Pa) A stress and its derivative with respect to the plastic strain.
struct Hardening {
  double stress = 0, slope = 0;
};

/// Y₀ and its slope (infinite at p = 0 if n < 1).
[[nodiscard]] Hardening staticStress(const PlasticMaterial& m, double strain);
/// Drucker and Prager's cone: √J₂ + η σₘ ≤ ξc, σₘ ≤ limit.
struct Cone {
  double slope, strength;  ///< η; Pa, ξc
  double dilation;         ///< η of the flow
  double limit;            ///< Pa

  explicit Cone(const PlasticMaterial& m)
      : slope(slopeOf(m.internalFriction)),
        strength(3 * m.cohesion / rootOf(m.internalFriction)),
        dilation(slopeOf(m.dilation)),
        limit(slope * m.tensionLimit < strength ? m.tensionLimit : strength / slope) {}

 private:
  static double rootOf(double tangent) { return std::sqrt(9 + 12 * tangent * tangent); }
  static double slopeOf(double tangent) { return 3 * tangent / rootOf(tangent); }
};
/// T*, from 0 to 1; 0 without a melting temperature.
[[nodiscard]] double relativeHeat(const PlasticMaterial& m, double temperature);
/// Factor of the temperature, from 1 to 0.
[[nodiscard]] double thermalFactor(const PlasticMaterial& m, double temperature);

}  // namespace yadefrag
