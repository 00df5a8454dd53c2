#pragma once
// Saves and loads the complete state of a world in YADE's archives, as columns of plain numbers.
// The run continues with the same bits from binary files and from XML, which contains all digits of
// a number. Damaged data are refused: a checksum covers all values, and every index is checked
// before use. How a column is stored: column_archive.hpp.

#include <vector>

#include "publish/any_archive.hpp"
#include "step/world.hpp"

namespace yadefrag {

/// `entryBodies`: YADE's body id of each entry; `forces` (N, by node): of contact in the last step.
/// Throws InputError for data that are damaged or of another version, RunError if they cannot be
/// written.
void archiveWorld(AnyArchive& archive, World& world, std::vector<int>& entryBodies,
                  std::vector<Vec2>& forces);

}  // namespace yadefrag
