#pragma once
// How the nodes inside a body are laid.

#include <cstdint>

namespace yadefrag {

enum class NodeLayout : std::uint8_t {
  kRows,       ///< rows along the boundary: nearly equilateral triangles, edges in few directions
  kScattered,  ///< random, no two nearer than a radius: edges in all directions
};

struct MeshLayout {
  NodeLayout nodes = NodeLayout::kRows;
  std::uint64_t seed = 0;  ///< of scattered nodes
};

}  // namespace yadefrag
