#pragma once
// A quantity that changes linearly between given times, and is constant before and after them.

#include <cstddef>
#include <vector>

namespace yadefrag {

class TimeTable {
 public:
  TimeTable() = default;
  explicit TimeTable(double constant) : TimeTable({0}, {constant}) {}
  /// `times`: s, ascending; a value for each.
  TimeTable(std::vector<double> times, std::vector<double> values);

  /// As many values as times, one at least, all finite, and times that ascend.
  [[nodiscard]] static bool isRight(const std::vector<double>& times,
                                    const std::vector<double>& values);

  [[nodiscard]] const std::vector<double>& times() const { return times_; }
  [[nodiscard]] const std::vector<double>& values() const { return values_; }

  /// 0 without any value.
  [[nodiscard]] double at(double time) const;
  /// Exact, but for rounding.
  [[nodiscard]] double integral(double from, double to) const;

 private:
  [[nodiscard]] std::size_t after(double time) const;
  [[nodiscard]] double sumUpTo(double time) const;

  std::vector<double> times_, values_;
  std::vector<double> sums_;  // the integral from the first time to each
};

}  // namespace yadefrag
