#pragma once
// Sizes and member offsets, in bytes, of YADE's classes in the Debian package (double precision,
// OPENMP, MPI, no VECTORIZE). The build makes the table from pkg/yade/versions.

#include <cstddef>
#include <string_view>

#include "yade/layout_table.hpp"

namespace yadefrag {

struct LayoutEntry {
  std::string_view type;
  std::string_view member;  // empty: the size of the type
  std::size_t bytes;
};

#define YADEFRAG_SIZE_ROW(Type, bytes) {#Type, "", bytes},
#define YADEFRAG_MEMBER_ROW(Type, member, bytes) {#Type, #member, bytes},
inline constexpr LayoutEntry kLayout[] = {YADEFRAG_LAYOUT(YADEFRAG_SIZE_ROW, YADEFRAG_MEMBER_ROW)};

// A member that is not in the table causes a compile error.
consteval std::size_t layoutBytes(std::string_view type, std::string_view member) {
  for (const LayoutEntry& entry : kLayout) {
    if (entry.type == type && entry.member == member) return entry.bytes;
  }
  throw "not in the layout table";
}

}  // namespace yadefrag
