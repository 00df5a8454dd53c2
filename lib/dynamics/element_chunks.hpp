#pragma once
// The elements as the vector loops want them. Chunks of successive elements of one material have
// local node numbers: forces are summed in a small buffer, whole for nodes that no other chunk
// touches, the rest as partial sums that are added in a fixed order. So the result has the same
// bits for any number of threads, and the node arrays are read and written about once.

#include <cstdint>
#include <vector>

#include "core/csr.hpp"
#include "mesh/model.hpp"

namespace yadefrag {

inline constexpr std::size_t kLanes = 8;

/// kLanes successive elements, component by component. Lanes after a chunk's last element repeat it
/// without volume.
struct alignas(64) ElementLanes {
  double inverseEdges[4][kLanes];   ///< 1/m
  double volume[kLanes];            ///< m³, stress-free
  std::uint16_t corner[3][kLanes];  ///< local number of the node
};

struct Chunk {
  double lame, shear;         ///< Pa
  double density, waveSpeed;  ///< kg/m³, m/s; for the bulk viscosity
  double thickness;           ///< m
  std::uint32_t firstElement, lastElement;
  std::uint32_t firstLanes, lastLanes;
  /// Its nodes in `ElementChunks::nodes`: first the own ones, then those shared with other chunks.
  std::uint32_t firstNode, firstShared, lastNode;
  std::uint32_t firstPartial;  ///< where its partial sums go, one per shared node
};

struct ElementChunks {
  std::vector<Chunk> chunks;
  std::vector<ElementLanes> lanes;
  std::vector<NodeId> nodes;            ///< by chunk and local number
  std::vector<NodeId> sharedNodes;      ///< ascending
  Csr<std::uint32_t> partialsOfShared;  ///< by place in `sharedNodes`
  std::size_t partials = 0;
  std::size_t mostNodes = 0;  ///< of a chunk

  void build(const Model& model);
};

}  // namespace yadefrag
