#pragma once
// Sizes and member offsets, in bytes, of YADE's classes as the Debian package was compiled (double
// precision, OPENMP, MPI, no VECTORIZE). The build makes the table from pkg/abi/versions.

#include "abi/layout_entry.hpp"
#include "abi/layout_table.hpp"

namespace yadefrag {

// A member missing from the table fails to compile.
consteval std::size_t layoutBytes(std::string_view type, std::string_view member) {
  for (const LayoutEntry& entry : kLayout) {
    if (entry.type == type && entry.member == member) return entry.bytes;
  }
  throw "not in the layout table";
}

}  // namespace yadefrag
