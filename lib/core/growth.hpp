#pragma once
// Arrays whose length changes little: they grow by a sixteenth instead of doubling.

#include <cstddef>
#include <vector>

namespace yadefrag {

template <class T>
void growTo(std::vector<T>& array, std::size_t size) {
  if (size > array.capacity()) array.reserve(size + size / 16);
  array.resize(size);
}

}  // namespace yadefrag
