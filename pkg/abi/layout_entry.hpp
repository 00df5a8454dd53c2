#pragma once
// One row of the table of sizes and offsets.

#include <cstddef>
#include <string_view>

namespace yadefrag {

struct LayoutEntry {
  std::string_view type;
  std::string_view member;  // empty: the size of the type
  std::size_t bytes;
};

}  // namespace yadefrag
