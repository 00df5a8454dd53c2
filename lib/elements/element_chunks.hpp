#pragma once
// The elements in the layout of the vector loops. Chunks of successive elements of one material
// have local node numbers. Forces are summed in a small buffer: complete sums for nodes of one
// chunk only, partial sums for the others, which are added in a fixed order. The result therefore
// has the same bits for any number of threads, and the node arrays are read and written about once.
// When nodes split, only the chunks of their elements change.

#include <cstdint>
#include <span>
#include <vector>

#include "mesh/model.hpp"

namespace yadefrag {

inline constexpr std::size_t kLanes = 8;

/// kLanes successive elements, component by component. Lanes after a chunk's last element repeat
/// that element with volume 0.
struct alignas(64) ElementLanes {
  double inverseEdges[4][kLanes];   ///< 1/m
  double volume[kLanes];            ///< m³, stress-free
  std::uint16_t corner[3][kLanes];  ///< local number of the corner's node
};

/// The elastic laws of kLanes elements of a chunk with several laws.
struct alignas(64) ElementLaws {
  double lame[kLanes], shear[kLanes];  ///< Pa
  double density[kLanes];              ///< kg/m³
};

/// Of kLanes elements of an axisymmetric scene.
struct alignas(64) ElementHoops {
  double inverse[kLanes];   ///< 1/(3R) (1/m); times the sum of the corners' x the hoop stretch
  double share[3][kLanes];  ///< corners' parts of the mass, their sum is 1
};

/// Successive elements; `lastElement` is one past the last.
struct ElementRange {
  std::uint32_t firstElement, lastElement;
  friend auto operator<=>(const ElementRange&, const ElementRange&) = default;
};

struct Chunk {
  double lame, shear;         ///< Pa
  double density, waveSpeed;  ///< kg/m³, m/s; for the bulk viscosity
  double thickness;           ///< m
  ElementKind element;
  bool yields;              ///< elements/plastic_flow.hpp
  bool isMixed;             ///< elements have individual laws, which replace the first four values
  std::uint32_t firstLaws;  ///< first index of its lanes in `ElementChunks::laws`
  /// Pa, β and μ of a brittle material; the least of each for several materials; 0 otherwise.
  double strength, shearFactor, friction;
  /// (Pa²) Elements whose squared stress measure reaches this value are reported as stressed;
  /// infinite: no check.
  double squaredStressLimit;
  std::uint32_t firstComponent, lastComponent;  ///< `lastComponent` is included
  std::uint32_t firstElement, lastElement;
  std::uint32_t firstLanes, lastLanes;
  /// The chunk's nodes in `ElementChunks::nodes`: first the own ones, then those shared with other
  /// chunks, each ascending. The reserve for new nodes extends to `endOfRoom`.
  std::uint32_t firstNode, firstShared, lastNode, endOfRoom;
};

struct ElementChunks {
  std::vector<Chunk> chunks;  ///< in the order of their elements
  std::vector<ElementLanes> lanes;
  std::vector<ElementLaws> laws;    ///< laws of mixed chunks
  std::vector<ElementHoops> hoops;  ///< parallel to `lanes`; empty in a plane scene
  std::vector<NodeId> nodes;        ///< by chunk and local number
  /// Parallel to `nodes`: index of the partial sum of a shared node.
  std::vector<std::uint32_t> partialOf;
  std::vector<NodeId> sharedNodes;  ///< ascending
  /// Index of the first partial sum of `sharedNodes[i]`. There is one sum for each of its chunks,
  /// in ascending order; those of the next shared node follow.
  std::vector<std::uint32_t> firstPartial;
  std::size_t mostNodes = 0;  ///< largest number of nodes of a chunk

  void build(const Model& model);
  /// Rebuilds the chunks of the `changed` elements, some of whose corners became nodes from
  /// `firstNew` on; returns the number of these chunks. Sums have the same bits as after `build`:
  /// old nodes stay shared although only one chunk may still use them. Partial sums that are no
  /// longer written are appended to `abandoned`; the caller must set them to zero.
  std::size_t follow(const Model& model, std::span<const ElementId> changed, NodeId firstNew,
                     std::vector<std::uint32_t>& abandoned);

  /// Reserves memory for this number of nodes of the model, in chunks that grow.
  void reserve(std::size_t modelNodes) {
    local_.reserve(modelNodes);
    nodes.reserve(nodes.size() + nodes.size() / 2);
    partialOf.reserve(nodes.capacity());
  }

  /// Sets the stress limits; `leastStrength` by component. Returns true if any element is checked.
  bool watch(const std::vector<double>& leastStrength);

  /// Laws of the chunk's lanes; null if the chunk has one law.
  [[nodiscard]] const ElementLaws* lawsOf(const Chunk& chunk) const {
    return chunk.isMixed ? laws.data() + chunk.firstLaws : nullptr;
  }

  /// By index of the lanes; null in a plane scene.
  [[nodiscard]] const ElementHoops* hoopsIfAny() const {
    return hoops.empty() ? nullptr : hoops.data();
  }

  [[nodiscard]] std::size_t partials() const {
    return firstPartial.empty() ? 0 : firstPartial.back();
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

  std::vector<std::uint32_t> local_;  // by node; valid only directly after it was written
};

}  // namespace yadefrag
