#pragma once
// The elements as the vector loops want them. Chunks of successive elements of one material have
// local node numbers: forces are summed in a small buffer, whole for nodes that no other chunk
// touches, the rest as partial sums that are added in a fixed order. So the result has the same
// bits for any number of threads, and the node arrays are read and written about once. Nodes that
// split change only the chunks of their elements.

#include <cstdint>
#include <span>
#include <vector>

#include "core/footprint.hpp"
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

/// The elastic laws of kLanes elements, where those of a chunk differ.
struct alignas(64) ElementLaws {
  double lame[kLanes], shear[kLanes];  ///< Pa
  double density[kLanes];              ///< kg/m³
};

/// Successive elements, `lastElement` one past.
struct ElementRange {
  std::uint32_t firstElement, lastElement;
  friend auto operator<=>(const ElementRange&, const ElementRange&) = default;
};

struct Chunk {
  double lame, shear;         ///< Pa
  double density, waveSpeed;  ///< kg/m³, m/s; for the bulk viscosity
  double thickness;           ///< m
  ElementKind element;
  bool isMixed;             ///< elements have laws of their own, in place of the first four values
  std::uint32_t firstLaws;  ///< of its lanes in `ElementChunks::laws`
  /// Pa, β and μ of a brittle material or, of several, their least; 0 of others.
  double strength, shearFactor, friction;
  /// (Pa²) Squared stress measure from which elements count as stressed; infinite: not watched.
  double squaredLook;
  std::uint32_t firstComponent, lastComponent;  ///< `lastComponent` itself included
  std::uint32_t firstElement, lastElement;
  std::uint32_t firstLanes, lastLanes;
  /// Its nodes in `ElementChunks::nodes`: first the own ones, then those shared with other chunks;
  /// both ascending. There is room for more up to `endOfRoom`.
  std::uint32_t firstNode, firstShared, lastNode, endOfRoom;
};

struct ElementChunks {
  std::vector<Chunk> chunks;  ///< by ascending elements
  std::vector<ElementLanes> lanes;
  std::vector<ElementLaws> laws;         ///< of mixed chunks
  std::vector<NodeId> nodes;             ///< by chunk and local number
  std::vector<std::uint32_t> partialOf;  ///< parallel to `nodes`: where a shared one's sum goes
  std::vector<NodeId> sharedNodes;       ///< ascending
  /// Where the partial sums of `sharedNodes[i]` begin, one for each of its chunks in ascending
  /// order; those of the next shared node follow.
  std::vector<std::uint32_t> firstPartial;
  std::size_t mostNodes = 0;  ///< of a chunk

  void build(const Model& model);
  /// Builds anew the chunks that hold `changed` elements, some of whose corners became nodes from
  /// `firstNew` on, and returns how many these are. Sums have the same bits as after `build`: old
  /// nodes stay shared though only one chunk may be left to them. Partial sums that are not written
  /// any more are appended to `abandoned` and must be set to zero.
  std::size_t follow(const Model& model, std::span<const ElementId> changed, NodeId firstNew,
                     std::vector<std::uint32_t>& abandoned);

  /// Room for so many nodes of the model, in chunks that grow.
  void reserve(std::size_t modelNodes) {
    local_.reserve(modelNodes);
    nodes.reserve(nodes.size() + nodes.size() / 2);
    partialOf.reserve(nodes.capacity());
  }

  /// Sets what is watched; `leastStrength` by component. Returns whether anything is.
  bool watch(const std::vector<double>& leastStrength);

  /// Of the chunk's lanes; null if it has one law.
  [[nodiscard]] const ElementLaws* lawsOf(const Chunk& chunk) const {
    return chunk.isMixed ? laws.data() + chunk.firstLaws : nullptr;
  }

  [[nodiscard]] std::size_t partials() const {
    return firstPartial.empty() ? 0 : firstPartial.back();
  }

  void addTo(Footprint& footprint) const {
    footprint.add(Use::kDynamics, chunks, lanes, nodes, partialOf, sharedNodes, firstPartial,
                  local_);
    footprint.add(Use::kMaterials, laws);
  }

 private:
  struct NewPlace;
  struct NodeList;

  void placePartials(const std::vector<std::uint8_t>& shared);
  void numberCorners(const Model& model, const Chunk& chunk);
  void shareNewNodes(std::span<NewPlace> places);
  void listNodes(const Model& model, const Chunk& chunk, std::span<const NewPlace> added,
                 NodeList& list, std::vector<std::uint32_t>& abandoned);
  void replaceNodes(Chunk& chunk, const NodeList& list);

  std::vector<std::uint32_t> local_;  // by node; only what was just written is ever read
};

}  // namespace yadefrag
