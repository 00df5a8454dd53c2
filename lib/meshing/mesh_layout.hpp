#pragma once
// Arrangement of the nodes inside a body.

#include <cstdint>

namespace yadefrag {

enum class NodeLayout : std::uint8_t {
  kRows,       ///< rows along the boundary: nearly equilateral triangles, edges in few directions
  kScattered,  ///< random with a minimum distance: edges in all directions
};

struct MeshLayout {
  NodeLayout nodes = NodeLayout::kRows;
  std::uint64_t seed = 0;  ///< of the random positions
};

}  // namespace yadefrag
