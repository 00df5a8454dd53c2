#pragma once
// A quantity that changes linearly between given times, and is constant before and after them.

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

namespace yadefrag {

class TimeTable {
 public:
  TimeTable() = default;
  explicit TimeTable(double constant) : TimeTable({0}, {constant}) {}
  /// `times`: s, ascending; a value for each.
  TimeTable(std::vector<double> times, std::vector<double> values)
      : times_(std::move(times)), values_(std::move(values)), sums_(times_.size()) {
    for (std::size_t i = 1; i < times_.size(); ++i)
      sums_[i] = sums_[i - 1] + (times_[i] - times_[i - 1]) * (values_[i - 1] + values_[i]) / 2;
  }

  /// As many values as times, one at least, all finite, and times that ascend.
  [[nodiscard]] static bool isRight(const std::vector<double>& times,
                                    const std::vector<double>& values) {
    const auto isFinite = [](double v) { return std::isfinite(v); };
    return !times.empty() && times.size() == values.size() &&
           std::ranges::all_of(times, isFinite) && std::ranges::all_of(values, isFinite) &&
           std::ranges::adjacent_find(times, std::greater_equal<>()) == times.end();
  }

  [[nodiscard]] const std::vector<double>& times() const { return times_; }
  [[nodiscard]] const std::vector<double>& values() const { return values_; }

  /// 0 without any value.
  [[nodiscard]] double at(double time) const {
    if (times_.empty()) return 0;
    const std::size_t i = after(time);
    if (i == 0) return values_.front();
    if (i == times_.size()) return values_.back();
    const double part = (time - times_[i - 1]) / (times_[i] - times_[i - 1]);
    return values_[i - 1] + part * (values_[i] - values_[i - 1]);
  }

  /// Exact, but for rounding.
  [[nodiscard]] double integral(double from, double to) const {
    return times_.empty() ? 0 : sumUpTo(to) - sumUpTo(from);
  }

 private:
  [[nodiscard]] std::size_t after(double time) const {
    return std::ranges::upper_bound(times_, time) - times_.begin();
  }
  /// From the first time on.
  [[nodiscard]] double sumUpTo(double time) const {
    const std::size_t i = after(time);
    if (i == 0) return (time - times_.front()) * values_.front();
    return sums_[i - 1] + (time - times_[i - 1]) * (values_[i - 1] + at(time)) / 2;
  }

  std::vector<double> times_, values_;
  std::vector<double> sums_;  // the integral from the first time to each
};

}  // namespace yadefrag
