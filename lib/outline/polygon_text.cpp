#include "outline/polygon.hpp"

#include <fmt/core.h>

#include <charconv>
#include <cmath>
#include <string>
#include <vector>

#include "core/errors.hpp"

namespace yadefrag {
namespace {

constexpr std::string_view kSpace = " \t\r\f\v";

[[noreturn]] void refuse(std::size_t line, std::string_view found) {
  // Only the beginning of the line is shown: a file that is not text may be one long line.
  constexpr std::size_t kShown = 40;
  std::string shown;
  for (const char c : found.substr(0, kShown)) shown += c >= ' ' && c <= '~' ? c : '?';
  if (found.size() > kShown) shown += "...";
  throw InputError(
      fmt::format("line {}: '{}' must be two finite numbers, x and y in metres.", line, shown));
}

std::string_view trimmed(std::string_view text) {
  const std::size_t begin = text.find_first_not_of(kSpace);
  if (begin == std::string_view::npos) return {};
  return text.substr(begin, text.find_last_not_of(kSpace) - begin + 1);
}

/// Reads a number from the front of `text`; returns false if there is none.
bool takeNumber(std::string_view& text, double& value) {
  if (text.starts_with('+')) text.remove_prefix(1);
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || !std::isfinite(value)) return false;
  text.remove_prefix(static_cast<std::size_t>(end - text.data()));
  return text.empty() || kSpace.find(text.front()) != std::string_view::npos;
}

Vec2 pointOf(std::string_view line, std::size_t number) {
  Vec2 point;
  std::string_view rest = line;
  if (!takeNumber(rest, point.x)) refuse(number, line);
  rest = trimmed(rest);
  if (!takeNumber(rest, point.y) || !trimmed(rest).empty()) refuse(number, line);
  return point;
}

}  // namespace

Polygon polygonFromText(std::string_view text) {
  constexpr std::string_view kByteOrderMark = "\xef\xbb\xbf";
  if (text.starts_with(kByteOrderMark)) text.remove_prefix(kByteOrderMark.size());
  std::vector<std::vector<Vec2>> loops(1);
  for (std::size_t number = 1; !text.empty(); ++number) {
    const std::size_t end = text.find('\n');
    const std::string_view line = text.substr(0, end);
    text.remove_prefix(end == std::string_view::npos ? text.size() : end + 1);
    const std::string_view words = trimmed(line.substr(0, line.find('#')));
    if (!words.empty())
      loops.back().push_back(pointOf(words, number));
    else if (line.find('#') == std::string_view::npos && !loops.back().empty())
      loops.emplace_back();
  }
  if (loops.back().empty()) loops.pop_back();
  if (loops.empty()) throw InputError("line 1: no points, a line must hold x and y in metres.");
  Polygon polygon{std::move(loops.front()), {}};
  for (std::size_t i = 1; i < loops.size(); ++i) polygon.holes.push_back(std::move(loops[i]));
  return polygon;
}

}  // namespace yadefrag
