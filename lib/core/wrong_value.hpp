#pragma once

#include <fmt/core.h>

#include <string>
#include <string_view>

namespace yadefrag {

/// A sentence about a value that is refused; `unit` with a leading space, or empty; `right`: what
/// it must be.
inline std::string wrongValue(std::string_view name, double value, std::string_view unit,
                              std::string_view right) {
  return fmt::format("{} is {:g}{}; it must be {}.", name, value, unit, right);
}

}  // namespace yadefrag
