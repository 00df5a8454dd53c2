#pragma once
// Checks whether a world's state can be the result of a run.

#include <string>

namespace yadefrag {

class World;

/// Returns an empty string if every array has its length, every index is in range, every list is
/// consistently linked, and every divisor is positive and finite; otherwise the invalid part. For
/// states from files.
[[nodiscard]] std::string findInvalidPart(const World& world);

}  // namespace yadefrag
