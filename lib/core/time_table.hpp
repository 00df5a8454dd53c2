#pragma once
// A piecewise linear function of time, constant before its first time and after its last.

#include <cstddef>
#include <vector>

namespace yadefrag {

class TimeTable {
 public:
  TimeTable() = default;
  explicit TimeTable(double constant) : TimeTable({0}, {constant}) {}
  /// `times` (s), ascending; one value for each.
  TimeTable(std::vector<double> times, std::vector<double> values);

  /// True if there is at least one value, as many values as times, all are finite, and the times
  /// ascend.
  [[nodiscard]] static bool isValid(const std::vector<double>& times,
                                    const std::vector<double>& values);

  [[nodiscard]] const std::vector<double>& times() const { return times_; }
  [[nodiscard]] const std::vector<double>& values() const { return values_; }

  /// 0 for a table without values.
  [[nodiscard]] double at(double time) const;
  /// Exact, except for rounding.
  [[nodiscard]] double integral(double from, double to) const;

 private:
  [[nodiscard]] std::size_t after(double time) const;
  [[nodiscard]] double sumUpTo(double time) const;

  std::vector<double> times_, values_;
  std::vector<double> sums_;  // integral from the first time to each time
};

}  // namespace yadefrag
