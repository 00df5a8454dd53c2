// libFuzzer: any bytes as the saved state of an FESolver. scripts/fuzz state.
//
// Compiled so that the checksum, which no mutation would pass, is not required: what is
// behind it has to stand damage by itself.

#include <cstddef>
#include <cstdint>
#include <string>

#include "core/errors.hpp"
#include "extremes/saved_world.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  yadefrag::World world;
  try {
    yadefrag::test::load(std::string(reinterpret_cast<const char*>(data), size), world,
                         boost::archive::no_header);
  } catch (const yadefrag::InputError&) {
    // Refused, with a sentence.
  }
  return 0;
}
