// scripts/fuzz, two programs by YADEFRAG_FUZZED. 1: libFuzzer with any bytes as the saved state of
// an FESolver, compiled so that the checksum, which no mutation would pass, is not required: what
// is behind it has to stand damage by itself. 0: writes what it begins with, FOLDER/state/world.

#include <boost/archive/basic_archive.hpp>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <string>

#include "core/errors.hpp"
#include "step/eventful_scenes.hpp"

using namespace yadefrag;

#if YADEFRAG_FUZZED == 0
namespace {

void write(const std::filesystem::path& file, const std::string& bytes) {
  std::filesystem::create_directories(file.parent_path());
  std::ofstream(file, std::ios::binary) << bytes;
}

}  // namespace

int main(int count, char** arguments) {
  if (count != 2) return 2;
  const std::filesystem::path folder = arguments[1];
  World world = test::eventfulWorld(true);
  write(folder / "state" / "world", test::saved(world, boost::archive::no_header));
  return 0;
}
#else
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string input(reinterpret_cast<const char*>(data), size);
  try {
    World world;
    test::load(input, world, boost::archive::no_header);
  } catch (const InputError&) {
    // Refused, with a sentence.
  }
  return 0;
}
#endif
