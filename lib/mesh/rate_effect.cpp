#include "mesh/rate_effect.hpp"

#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <utility>

#include "core/errors.hpp"

namespace yadefrag {
namespace {

constexpr std::array<std::string_view, 2> kNames = {"none", "ceb-fip-2010"};
/// Far above any measured one; powers of it are finite.
constexpr double kMostFactor = 1000;

/// What is wrong with the points; empty if nothing is.
std::string faultOf(std::span<const RatePoint> points, const RateWords& words) {
  if (points.empty()) return {};
  if (points.size() == 1) return "has one point; it must have at least two";
  for (std::size_t i = 0; i < points.size(); ++i) {
    const auto& [rate, factor] = points[i];
    if (!(rate > 0 && std::isfinite(rate)))
      return fmt::format("has the {} {:.4g} {}; these must be positive and finite", words.quantity,
                         rate, words.unit);
    if (i > 0 && !(rate > points[i - 1].rate))
      return fmt::format("has the {} {:.4g} {} after {:.4g} {}; these must increase",
                         words.quantity, rate, words.unit, points[i - 1].rate, words.unit);
    if (!(factor >= 1 && factor <= kMostFactor))
      return fmt::format("has the factor {:.4g}; factors must be from 1, {}, to {:.4g}", factor,
                         words.slow, kMostFactor);
  }
  return {};
}

}  // namespace

RateEffect::RateEffect(std::vector<RatePoint> points, const RateWords& words)
    : points_(std::move(points)) {
  const std::string fault = faultOf(points_, words);
  if (!fault.empty()) throw InputError(fmt::format("{} {}.", words.attribute, fault));
}

bool RateEffect::isValid(std::span<const RatePoint> points) {
  return faultOf(points, kStrainRate).empty();
}

double RateEffect::factor(double rate) const {
  if (points_.empty()) return 1;
  if (!(rate > points_.front().rate)) return points_.front().factor;
  if (rate >= points_.back().rate) return points_.back().factor;
  const auto end = std::ranges::upper_bound(points_, rate, {}, &RatePoint::rate);
  const RatePoint &low = *(end - 1), &high = *end;
  const double power = std::log(high.factor / low.factor) / std::log(high.rate / low.rate);
  return low.factor * std::pow(rate / low.rate, power);
}

double RateEffect::least() const {
  return points_.empty() ? 1 : std::ranges::min_element(points_, {}, &RatePoint::factor)->factor;
}

double RateEffect::largest() const {
  return points_.empty() ? 1 : std::ranges::max_element(points_, {}, &RatePoint::factor)->factor;
}

RateEffect rateEffectNamed(std::string_view name) {
  if (name == "none") return {};
  if (name == "ceb-fip-2010")
    return RateEffect({{1e-6, 1}, {10, std::pow(1e7, .018)}, {300, .0062 * std::cbrt(3e8)}});
  throw InputError(
      fmt::format("rateEffect is '{:.60}'; it must be one of '{}', or points (strain rate in 1/s, "
                  "factor of the strength).",
                  name, fmt::join(kNames, "', '")));
}

}  // namespace yadefrag
