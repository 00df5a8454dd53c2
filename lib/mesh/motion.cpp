#include "mesh/motion.hpp"

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

namespace {

/// Numbers before a motion's tables: its function, the lengths of the tables.
constexpr std::size_t kCounts = 4;

void append(FlatMotions& flat, const TimeTable& table) {
  flat.counts.push_back(static_cast<std::uint32_t>(table.times().size()));
  flat.numbers.insert(flat.numbers.end(), table.times().begin(), table.times().end());
  flat.numbers.insert(flat.numbers.end(), table.values().begin(), table.values().end());
}

/// Reads numbers in sequence; returns false at the end of the data.
class Reader {
 public:
  explicit Reader(const std::vector<double>& numbers) : numbers_(numbers) {}

  bool take(std::size_t count, std::vector<double>& part) {
    if (count > numbers_.size() - next_) return false;
    const auto begin = numbers_.begin() + static_cast<std::ptrdiff_t>(next_);
    part.assign(begin, begin + static_cast<std::ptrdiff_t>(count));
    next_ += count;
    return true;
  }
  bool take(std::size_t count, TimeTable& table) {
    std::vector<double> times, values;
    if (!take(count, times) || !take(count, values)) return false;
    if (count > 0 && !TimeTable::isValid(times, values)) return false;
    table = TimeTable(std::move(times), std::move(values));
    return true;
  }
  [[nodiscard]] bool isAtEnd() const { return next_ == numbers_.size(); }

 private:
  const std::vector<double>& numbers_;
  std::size_t next_ = 0;
};

}  // namespace

MovedFrame::MovedFrame(const Motion& motion, double time) {
  const double angle = motion.turn.integral(motion.begin, time);
  cosine = std::cos(angle), sine = std::sin(angle);
  centre = motion.centre + Vec2{motion.speedX.integral(motion.begin, time),
                                motion.speedY.integral(motion.begin, time)};
}

FlatMotions flatten(const std::vector<Motion>& motions) {
  FlatMotions flat;
  for (const Motion& motion : motions) {
    flat.counts.push_back(motion.function);
    flat.numbers.insert(flat.numbers.end(), {motion.centre.x, motion.centre.y, motion.begin});
    for (const TimeTable* table : {&motion.speedX, &motion.speedY, &motion.turn})
      append(flat, *table);
  }
  return flat;
}

bool unflatten(const FlatMotions& flat, std::vector<Motion>& motions) {
  if (flat.counts.size() % kCounts != 0) return false;
  motions.assign(flat.counts.size() / kCounts, {});
  Reader reader(flat.numbers);
  const std::uint32_t* count = flat.counts.data();
  for (Motion& motion : motions) {
    motion.function = *count++;
    std::vector<double> start;
    if (!reader.take(3, start)) return false;
    motion.centre = {start[0], start[1]};
    motion.begin = start[2];
    if (!isFinite(motion.centre) || !std::isfinite(motion.begin)) return false;
    for (TimeTable* table : {&motion.speedX, &motion.speedY, &motion.turn})
      if (!reader.take(*count++, *table)) return false;
  }
  return reader.isAtEnd();
}

}  // namespace yadefrag
