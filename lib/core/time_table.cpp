#include "core/time_table.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <utility>

namespace yadefrag {

TimeTable::TimeTable(std::vector<double> times, std::vector<double> values)
    : times_(std::move(times)), values_(std::move(values)), sums_(times_.size()) {
  for (std::size_t i = 1; i < times_.size(); ++i)
    sums_[i] = sums_[i - 1] + (times_[i] - times_[i - 1]) * (values_[i - 1] + values_[i]) / 2;
}

bool TimeTable::isValid(const std::vector<double>& times, const std::vector<double>& values) {
  const auto isFinite = [](double v) { return std::isfinite(v); };
  return !times.empty() && times.size() == values.size() && std::ranges::all_of(times, isFinite) &&
         std::ranges::all_of(values, isFinite) &&
         std::ranges::adjacent_find(times, std::greater_equal<>()) == times.end();
}

/// Index of the first time after `time`.
std::size_t TimeTable::after(double time) const {
  return static_cast<std::size_t>(std::ranges::upper_bound(times_, time) - times_.begin());
}

double TimeTable::at(double time) const {
  if (times_.empty()) return 0;
  const std::size_t i = after(time);
  if (i == 0) return values_.front();
  if (i == times_.size()) return values_.back();
  const double part = (time - times_[i - 1]) / (times_[i] - times_[i - 1]);
  return values_[i - 1] + part * (values_[i] - values_[i - 1]);
}

double TimeTable::integral(double from, double to) const {
  return times_.empty() ? 0 : sumUpTo(to) - sumUpTo(from);
}

/// Integral from the first time to `time`.
double TimeTable::sumUpTo(double time) const {
  const std::size_t i = after(time);
  if (i == 0) return (time - times_.front()) * values_.front();
  return sums_[i - 1] + (time - times_[i - 1]) * (values_[i - 1] + at(time)) / 2;
}

}  // namespace yadefrag
