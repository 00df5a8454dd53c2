#pragma once
// How the strength of a material increases with the strain rate.

#include <span>
#include <string_view>
#include <vector>

namespace yadefrag {

struct RatePoint {
  double rate;    ///< 1/s, strain rate
  double factor;  ///< strength over that of a slow test
  friend bool operator==(const RatePoint&, const RatePoint&) = default;
};

/// A polygon through points in the logarithms of rate and factor, since laws of this kind are
/// powers: lines there. Below the first point and above the last one the factor is constant.
class RateEffect {
 public:
  /// None: the factor is 1 at any rate.
  RateEffect() = default;
  /// At least two points, or none; rates are positive and increase, factors are from 1 to 1000.
  /// Throws InputError otherwise.
  explicit RateEffect(std::vector<RatePoint> points);

  [[nodiscard]] static bool isValid(std::span<const RatePoint> points);

  [[nodiscard]] const std::vector<RatePoint>& points() const { return points_; }
  [[nodiscard]] bool isOn() const { return !points_.empty(); }
  /// Strength at this strain rate (1/s) over that of a slow test.
  [[nodiscard]] double factor(double rate) const;
  [[nodiscard]] double least() const;    ///< factor
  [[nodiscard]] double largest() const;  ///< factor

  friend bool operator==(const RateEffect&, const RateEffect&) = default;

 private:
  std::vector<RatePoint> points_;
};

/// The effect of this name; throws InputError for an unknown name.
///   none          the factor is 1
///   ceb-fip-2010  concrete in tension, fib Model Code 2010, 5.1.11.2: (ε̇/ε̇₀)^0.018 up to 10 /s,
///                 0.0062(ε̇/ε̇₀)^⅓ above, ε̇₀ = 10⁻⁶ /s; up to 300 /s, where the range of the code
///                 ends. At 10 /s its two formulas differ by 0.0006 of the factor; here the first
///                 one is valid there.
[[nodiscard]] RateEffect rateEffectNamed(std::string_view name);

}  // namespace yadefrag
