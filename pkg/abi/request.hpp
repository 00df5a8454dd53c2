#pragma once
// Requests of data from memory before they are used: objects of YADE are spread over it.

#include <cstddef>
#include <cstdint>

namespace yadefrag {

/// Requests bytes [from, to) of an object, which may be null.
template <class Object>
void request(const Object* object, std::size_t from, std::size_t to) {
  constexpr std::uintptr_t kLine = 64;
  const auto begin = reinterpret_cast<std::uintptr_t>(object);
  for (std::uintptr_t line = (begin + from) / kLine * kLine; line < begin + to; line += kLine) {
    __builtin_prefetch(reinterpret_cast<const void*>(line));
  }
}

}  // namespace yadefrag
