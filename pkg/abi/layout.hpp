#pragma once
// Sizes and member offsets, in bytes, of YADE's classes in the Debian package (double precision,
// OPENMP, MPI, no VECTORIZE). The build makes the table from pkg/abi/versions.

#include "abi/layout_entry.hpp"
#include "abi/layout_table.hpp"

namespace yadefrag {

// A member that is not in the table causes a compile error.
consteval std::size_t layoutBytes(std::string_view type, std::string_view member) {
  for (const LayoutEntry& entry : kLayout) {
    if (entry.type == type && entry.member == member) return entry.bytes;
  }
  throw "not in the layout table";
}

}  // namespace yadefrag
