#pragma once
// Can a world's state be one that a run has left?

#include <string>

namespace yadefrag {

class World;

/// Empty if every array has its length, every index something to point to, every list its links
/// back, and every value that a step divides by is positive and finite; else what is not so. For
/// states that come from a file.
[[nodiscard]] std::string whatIsWrong(const World& world);

}  // namespace yadefrag
