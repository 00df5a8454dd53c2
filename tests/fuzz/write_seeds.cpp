// Writes what the fuzzers begin with: FOLDER/polygon/plate and FOLDER/state/world.

#include <filesystem>
#include <fstream>

#include "extremes/saved_world.hpp"

namespace {

void write(const std::filesystem::path& file, const std::string& bytes) {
  std::filesystem::create_directories(file.parent_path());
  std::ofstream(file, std::ios::binary) << bytes;
}

}  // namespace

int main(int count, char** arguments) {
  if (count != 2) return 2;
  const std::filesystem::path folder = arguments[1];
  write(folder / "polygon" / "plate",
        "# a plate\n\n0 0  # corner\n4 0\n4 3\r\n\n\n1 1\n1 2\n2e0 +1\n");
  yadefrag::World world = yadefrag::test::eventfulWorld(true);
  write(folder / "state" / "world", yadefrag::test::saved(world, boost::archive::no_header));
  return 0;
}
