#pragma once
// Requests of data from memory before they are used, so that several are on their way at once.

#include <cstddef>
#include <cstdint>

namespace yadefrag {

/// Requests the cache line that contains an address, which may be invalid.
[[gnu::always_inline]] inline void requestLine(const void* address) {
  __builtin_prefetch(address);
  // Without a side effect GCC leaves out calls of functions that do nothing but request.
  asm volatile("" : : "r"(address));
}

/// Requests bytes [from, to) of an object, which may be null.
template <class Object>
[[gnu::always_inline]] inline void request(const Object* object, std::size_t from, std::size_t to) {
  constexpr std::uintptr_t kLine = 64;
  const auto begin = reinterpret_cast<std::uintptr_t>(object);
  for (std::uintptr_t line = (begin + from) / kLine * kLine; line < begin + to; line += kLine) {
    requestLine(reinterpret_cast<const void*>(line));
  }
}

}  // namespace yadefrag
