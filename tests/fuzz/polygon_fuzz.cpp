// libFuzzer: any text as a polygon file. scripts/fuzz polygon.

#include <cstddef>
#include <cstdint>
#include <string_view>

#include "core/errors.hpp"
#include "outline/polygon_text.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  try {
    (void)yadefrag::polygonFromText({reinterpret_cast<const char*>(data), size});
  } catch (const yadefrag::InputError&) {
    // Refused, with a sentence.
  }
  return 0;
}
