// Updates the chunks after nodes were split. A chunk gets only new nodes, which have the highest
// numbers: only these are sorted, and the partial sums of other chunks keep their indices.
#include <algorithm>
#include <tuple>

#include "core/arrays.hpp"

#include "dynamics/element_chunks.hpp"

namespace yadefrag {
namespace {

constexpr std::uint32_t kOwn = 0xffffffff;
constexpr std::uint32_t kGone = 0xffffffff;

std::uint32_t chunkOf(const std::vector<Chunk>& chunks, ElementId element) {
  const auto next =
      std::upper_bound(chunks.begin(), chunks.end(), element.value,
                       [](std::uint32_t e, const Chunk& chunk) { return e < chunk.firstElement; });
  return static_cast<std::uint32_t>(next - chunks.begin()) - 1;
}

}  // namespace

/// A new node in one of its chunks.
struct ElementChunks::NewPlace {
  NodeId node;
  std::uint32_t chunk;
  std::uint32_t partial = kOwn;

  friend auto operator<=>(const NewPlace&, const NewPlace&) = default;
};

/// The nodes of a chunk that is rebuilt.
struct ElementChunks::NodeList {
  std::vector<NodeId> nodes;
  std::vector<std::uint32_t> partials;
  std::size_t shared = 0;  // index of the first shared node

  void add(NodeId node, std::uint32_t partial) {
    nodes.push_back(node);
    partials.push_back(partial);
  }
};

/// Assigns partial sums to new nodes in several chunks; `places` is sorted by node, then chunk.
void ElementChunks::shareNewNodes(std::span<NewPlace> places) {
  for (std::size_t first = 0; first < places.size();) {
    std::size_t last = first + 1;
    while (last < places.size() && places[last].node == places[first].node) ++last;
    if (last - first > 1) {
      std::uint32_t partial = firstPartial.back();
      sharedNodes.push_back(places[first].node);
      for (std::size_t i = first; i < last; ++i) places[i].partial = partial++;
      firstPartial.push_back(partial);
    }
    first = last;
  }
}

void ElementChunks::listNodes(const Model& model, const Chunk& chunk,
                              std::span<const NewPlace> added, NodeList& list,
                              std::vector<std::uint32_t>& abandoned) {
  list.nodes.clear();
  list.partials.clear();
  // The chunk's own nodes remain own nodes: for each node that split, some of its elements keep the
  // old number.
  for (std::uint32_t i = chunk.firstNode; i < chunk.firstShared; ++i) list.add(nodes[i], kOwn);
  for (const NewPlace& place : added)
    if (place.partial == kOwn) list.add(place.node, kOwn);
  list.shared = list.nodes.size();
  for (std::uint32_t i = chunk.firstShared; i < chunk.lastNode; ++i) local_[nodes[i].value] = kGone;
  for (std::uint32_t e = chunk.firstElement; e < chunk.lastElement; ++e)
    for (const NodeId node : model.triangles.nodes[e]) local_[node.value] = 0;
  for (std::uint32_t i = chunk.firstShared; i < chunk.lastNode; ++i)
    if (local_[nodes[i].value] != kGone)
      list.add(nodes[i], partialOf[i]);
    else
      abandoned.push_back(partialOf[i]);
  for (const NewPlace& place : added)
    if (place.partial != kOwn) list.add(place.node, place.partial);
}

/// A list that exceeds its reserve is moved to the end, with a reserve of half its length. The
/// unused memory left behind is never more than a few times the used memory.
void ElementChunks::replaceNodes(Chunk& chunk, const NodeList& list) {
  const auto count = static_cast<std::uint32_t>(list.nodes.size());
  if (count > chunk.endOfRoom - chunk.firstNode) {
    chunk.firstNode = static_cast<std::uint32_t>(nodes.size());
    chunk.endOfRoom = chunk.firstNode + count + count / 2;
    nodes.resize(chunk.endOfRoom);
    partialOf.resize(chunk.endOfRoom);
  }
  std::copy(list.nodes.begin(), list.nodes.end(), nodes.begin() + chunk.firstNode);
  std::copy(list.partials.begin(), list.partials.end(), partialOf.begin() + chunk.firstNode);
  chunk.firstShared = chunk.firstNode + static_cast<std::uint32_t>(list.shared);
  chunk.lastNode = chunk.firstNode + count;
  mostNodes = std::max<std::size_t>(mostNodes, count);
}

std::size_t ElementChunks::follow(const Model& model, std::span<const ElementId> changed,
                                  NodeId firstNew, std::vector<std::uint32_t>& abandoned) {
  std::vector<std::uint32_t> touched;
  std::vector<NewPlace> places;
  for (const ElementId element : changed) {
    touched.push_back(chunkOf(chunks, element));
    for (const NodeId node : model.triangles.nodes[element.value])
      if (node >= firstNew) places.push_back({node, touched.back()});
  }
  sortUnique(touched);
  sortUnique(places);
  shareNewNodes(places);
  std::sort(places.begin(), places.end(), [](const NewPlace& a, const NewPlace& b) {
    return std::tie(a.chunk, a.node) < std::tie(b.chunk, b.node);
  });
  local_.resize(model.nodes.size());
  NodeList list;
  std::size_t first = 0;
  for (const std::uint32_t c : touched) {
    std::size_t last = first;
    while (last < places.size() && places[last].chunk == c) ++last;
    listNodes(model, chunks[c], std::span(places).subspan(first, last - first), list, abandoned);
    replaceNodes(chunks[c], list);
    numberCorners(model, chunks[c]);
    first = last;
  }
  return touched.size();
}

}  // namespace yadefrag
