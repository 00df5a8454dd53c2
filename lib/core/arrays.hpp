#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

namespace yadefrag {

/// Ascending, each value once.
template <class T>
void sortUnique(std::vector<T>& values) {
  std::sort(values.begin(), values.end());
  values.erase(std::unique(values.begin(), values.end()), values.end());
}

/// For arrays whose length changes little: they grow by a sixteenth instead of doubling.
template <class T>
void growTo(std::vector<T>& array, std::size_t size) {
  if (size > array.capacity()) array.reserve(size + size / 16);
  array.resize(size);
}

}  // namespace yadefrag
