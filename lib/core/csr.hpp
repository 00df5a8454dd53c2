#pragma once
// Results of varying length, one row per key, in two flat arrays (compressed sparse row format).

#include <cassert>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "core/errors.hpp"

namespace yadefrag {

/// Row r is `values[offsets[r]] … values[offsets[r + 1] - 1]`.
template <class T>
struct Csr {
  std::vector<T> values;
  std::vector<std::uint32_t> offsets;

  [[nodiscard]] std::size_t rows() const { return offsets.empty() ? 0 : offsets.size() - 1; }
  [[nodiscard]] std::span<const T> row(std::size_t r) const {
    assert(r < rows());
    return {values.data() + offsets[r], values.data() + offsets[r + 1]};
  }
};

/// Sorts `count` items into `rows` rows by counting; the order within a row is that of the input.
/// `keyOf(i)` is the row of item i, `valueOf(i)` is the stored value. Throws RunError for more
/// items than a 32-bit offset can count.
template <class T, class KeyOf, class ValueOf>
void fillRows(Csr<T>& csr, std::size_t rows, std::size_t count, KeyOf keyOf, ValueOf valueOf) {
  if (count > std::numeric_limits<std::uint32_t>::max())
    throw RunError("A list has more than 4294967295 entries, which cannot be counted in 32 bits.");
  csr.offsets.assign(rows + 1, 0);
  csr.values.resize(count);
  for (std::size_t i = 0; i < count; ++i) {
    assert(keyOf(i) < rows);
    ++csr.offsets[keyOf(i) + 1];
  }
  for (std::size_t r = 0; r < rows; ++r) csr.offsets[r + 1] += csr.offsets[r];
  // offsets[r] serves as the write position of row r and ends at the start of row r + 1. The loop
  // below shifts the offsets back.
  for (std::size_t i = 0; i < count; ++i) csr.values[csr.offsets[keyOf(i)]++] = valueOf(i);
  for (std::size_t r = rows; r > 0; --r) csr.offsets[r] = csr.offsets[r - 1];
  csr.offsets[0] = 0;
}

}  // namespace yadefrag
