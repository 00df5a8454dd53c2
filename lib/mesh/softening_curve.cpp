#include "mesh/softening_curve.hpp"

#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "core/errors.hpp"

namespace yadefrag {
namespace {

constexpr std::array<std::string_view, 6> kNames = {"linear",       "bilinear",    "petersson",
                                                    "ceb-fip-2010", "exponential", "reinhardt"};
/// Lines of a polygon in place of a smooth curve.
constexpr int kLines = 48;

/// The polygon of a curve that falls about as exp(−αu). Equal steps of exp(−αu/2) make the error
/// about the same everywhere.
template <class Curve>
SofteningCurve polygonOf(double alpha, Curve curve) {
  std::vector<SofteningPoint> points{{0, 1}};
  const double end = std::exp(-alpha / 2);
  for (int i = 1; i < kLines; ++i) {
    const double u = -2 / alpha * std::log(1 - (1 - end) * i / kLines);
    points.push_back({u, curve(u)});
  }
  points.push_back({1, 0});
  return SofteningCurve(std::move(points));
}

double exponential(double u) { return std::exp(-7 * u); }

double reinhardt(double u) {
  return (1 + 27 * u * u * u) * std::exp(-6.93 * u) - 28 * std::exp(-6.93) * u;
}

/// What is wrong with the points; empty if nothing is.
std::string faultOf(std::span<const SofteningPoint> points) {
  if (points.size() < 2)
    return fmt::format("has {} points; it must have at least two", points.size());
  if (points.front() != SofteningPoint{0, 1})
    return fmt::format(
        "begins at ({:.4g}, {:.4g}); it must begin at (0, 1), the strength without "
        "an opening",
        points.front().opening, points.front().traction);
  for (std::size_t i = 1; i < points.size(); ++i) {
    const auto& [opening, traction] = points[i];
    if (!(opening > points[i - 1].opening && std::isfinite(opening)))
      return fmt::format("has the opening {:.4g} after {:.4g}; openings must increase", opening,
                         points[i - 1].opening);
    if (!(traction >= 0 && traction <= points[i - 1].traction))
      return fmt::format(
          "has the traction {:.4g} after {:.4g}; tractions must not increase, nor be "
          "negative",
          traction, points[i - 1].traction);
  }
  if (points.back() != SofteningPoint{1, 0})
    return fmt::format("ends at ({:.4g}, {:.4g}); it must end at (1, 0), the critical opening",
                       points.back().opening, points.back().traction);
  return {};
}

}  // namespace

SofteningCurve::SofteningCurve(std::vector<SofteningPoint> points) : points_(std::move(points)) {
  const std::string fault = faultOf(points_);
  if (!fault.empty()) throw InputError(fmt::format("softening {}.", fault));
  for (std::size_t i = 1; i < points_.size(); ++i) {
    const double width = points_[i].opening - points_[i - 1].opening;
    area_ += width * (points_[i - 1].traction + points_[i].traction) / 2;
    steepest_ = std::max(steepest_, (points_[i - 1].traction - points_[i].traction) / width);
  }
  steepPart_ = std::min(1., 1 / (2 * area_ * steepest_));
}

bool SofteningCurve::isValid(std::span<const SofteningPoint> points) {
  return faultOf(points).empty();
}

std::span<const std::string_view> softeningNames() { return kNames; }

SofteningCurve softeningNamed(std::string_view name) {
  if (name == "linear") return {};
  if (name == "bilinear" || name == "petersson")
    return SofteningCurve({{0, 1}, {2. / 9, 1. / 3}, {1, 0}});
  if (name == "ceb-fip-2010") return SofteningCurve({{0, 1}, {.2, .2}, {1, 0}});
  if (name == "exponential") return polygonOf(7, exponential);
  if (name == "reinhardt") return polygonOf(6.93, reinhardt);
  throw InputError(
      fmt::format("softening is '{:.60}'; it must be one of '{}', or points (opening over "
                  "critical opening, traction over strength).",
                  name, fmt::join(kNames, "', '")));
}

}  // namespace yadefrag
