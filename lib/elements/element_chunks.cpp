#include "elements/element_chunks.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>

#include "core/arrays.hpp"
#include "core/csr.hpp"
#include "core/tolerances/dynamics.hpp"

namespace yadefrag {
namespace {

constexpr std::uint32_t kUnseen = 0xffffffff, kOwn = 0xffffffff;
constexpr double kNever = std::numeric_limits<double>::infinity();

Chunk chunkOf(const Component& c) {
  const ElasticMaterial& m = c.material;
  Chunk chunk{};
  chunk.isMixed = c.isMixed();
  if (!chunk.isMixed) {
    chunk.lame = m.lame();
    chunk.shear = m.shearModulus();
    chunk.density = m.density;
    chunk.waveSpeed = std::sqrt(m.waveModulus() / m.density);
  }
  chunk.thickness = c.thickness;
  chunk.element = c.element;
  chunk.yields = c.yields();
  if (chunk.yields && !c.averagesVolume()) chunk.element = ElementKind::kLinear;
  chunk.strength = c.brittle.cracks() ? c.brittle.tensileStrength : 0;
  chunk.shearFactor = c.brittle.cracks() ? c.brittle.shearFactor : 0;
  chunk.friction = c.brittle.cracks() ? c.friction : 0;
  chunk.squaredStressLimit = kNever;
  return chunk;
}

bool sameMaterial(const Chunk& a, const Chunk& b) {
  return a.lame == b.lame && a.shear == b.shear && a.density == b.density &&
         a.thickness == b.thickness && a.element == b.element && a.isMixed == b.isMixed &&
         a.strength == b.strength && a.shearFactor == b.shearFactor && a.friction == b.friction;
}

bool flowAlike(const Component& a, const Component& b) {
  return !(a.yields() || b.yields()) ||
         (a.plastic == b.plastic && a.material.planeStress == b.material.planeStress);
}

/// Divides the elements into chunks. Small bodies of one material share chunks: otherwise a scene
/// of a thousand rings would start a thousand short loops.
std::vector<Chunk> cutElements(const Model& model) {
  std::vector<Chunk> chunks;
  for (std::uint32_t c = 0; c < model.components.size(); ++c) {
    const Component& component = model.components[c];
    const Chunk kind = chunkOf(component);
    for (std::uint32_t e = component.firstTriangle; e < component.lastTriangle; ++e) {
      if (chunks.empty() || !sameMaterial(chunks.back(), kind) ||
          !flowAlike(model.components[chunks.back().firstComponent], component) ||
          e != chunks.back().lastElement ||
          e - chunks.back().firstElement == tolerance::kChunkElements) {
        chunks.push_back(kind);
        chunks.back().firstElement = e;
        chunks.back().firstComponent = c;
      }
      chunks.back().lastElement = e + 1;
      chunks.back().lastComponent = c;
    }
  }
  return chunks;
}

/// By node: true if more than one chunk uses it.
std::vector<std::uint8_t> findShared(const Model& model, const std::vector<Chunk>& chunks) {
  std::vector<std::uint32_t> user(model.nodes.size(), kUnseen);
  std::vector<std::uint8_t> shared(model.nodes.size(), 0);
  for (std::uint32_t c = 0; c < chunks.size(); ++c)
    for (std::uint32_t e = chunks[c].firstElement; e < chunks[c].lastElement; ++e)
      for (const NodeId node : model.triangles.nodes[e]) {
        if (user[node.value] != kUnseen && user[node.value] != c) shared[node.value] = 1;
        user[node.value] = c;
      }
  return shared;
}

/// Appends the chunk's nodes: own ones first, then shared ones, each in ascending order. They are
/// then read and written nearly in sequence.
void appendNodes(const Model& model, const std::vector<std::uint8_t>& shared, Chunk& chunk,
                 std::vector<NodeId>& nodes) {
  chunk.firstNode = static_cast<std::uint32_t>(nodes.size());
  for (std::uint32_t e = chunk.firstElement; e < chunk.lastElement; ++e)
    nodes.insert(nodes.end(), model.triangles.nodes[e].begin(), model.triangles.nodes[e].end());
  const auto first = nodes.begin() + chunk.firstNode;
  std::sort(first, nodes.end(), [&](NodeId a, NodeId b) {
    return shared[a.value] != shared[b.value] ? shared[a.value] < shared[b.value] : a < b;
  });
  nodes.erase(std::unique(first, nodes.end()), nodes.end());
  chunk.lastNode = static_cast<std::uint32_t>(nodes.size());
  chunk.firstShared = static_cast<std::uint32_t>(
      std::partition_point(nodes.begin() + chunk.firstNode, nodes.end(),
                           [&](NodeId n) { return shared[n.value] == 0; }) -
      nodes.begin());
}

void appendLanes(const Model& model, Chunk& chunk, std::vector<ElementLanes>& lanes) {
  const Triangles& triangles = model.triangles;
  chunk.firstLanes = static_cast<std::uint32_t>(lanes.size());
  for (std::uint32_t first = chunk.firstElement; first < chunk.lastElement; first += kLanes) {
    ElementLanes& l = lanes.emplace_back();
    for (std::uint32_t k = 0; k < kLanes; ++k) {
      const std::uint32_t e = std::min(first + k, chunk.lastElement - 1);
      for (int i = 0; i < 4; ++i) l.inverseEdges[i][k] = triangles.inverseEdges[e][i];
      l.volume[k] =
          first + k < chunk.lastElement ? triangles.area[e] * model.depthOf(ElementId(e)) : 0;
    }
  }
  chunk.lastLanes = static_cast<std::uint32_t>(lanes.size());
}

std::vector<ElementHoops> hoopsOf(const Model& model, const std::vector<Chunk>& chunks) {
  std::vector<ElementHoops> hoops;
  if (!model.axisymmetric) return hoops;
  for (const Chunk& chunk : chunks)
    for (std::uint32_t first = chunk.firstElement; first < chunk.lastElement; first += kLanes) {
      ElementHoops& h = hoops.emplace_back();
      for (std::uint32_t k = 0; k < kLanes; ++k) {
        const ElementId e(std::min(first + k, chunk.lastElement - 1));
        h.inverse[k] = 1 / (3 * model.triangles.radius[e.value]);
        for (std::size_t i = 0; i < 3; ++i) h.share[i][k] = model.massShare(e, i) / 3;
      }
    }
  return hoops;
}

void appendLaws(const Model& model, Chunk& chunk, std::vector<ElementLaws>& laws) {
  chunk.firstLaws = static_cast<std::uint32_t>(laws.size());
  for (std::uint32_t first = chunk.firstElement; first < chunk.lastElement; first += kLanes) {
    ElementLaws& l = laws.emplace_back();
    for (std::uint32_t k = 0; k < kLanes; ++k) {
      const ElementId e(std::min(first + k, chunk.lastElement - 1));
      const ElasticMaterial& m = model.materialOf(e).material;
      l.lame[k] = m.lame(), l.shear[k] = m.shearModulus(), l.density[k] = m.density;
    }
  }
}

std::uint32_t chunkOf(const std::vector<Chunk>& chunks, ElementId element) {
  const auto next =
      std::upper_bound(chunks.begin(), chunks.end(), element.value,
                       [](std::uint32_t e, const Chunk& chunk) { return e < chunk.firstElement; });
  return static_cast<std::uint32_t>(next - chunks.begin()) - 1;
}

}  // namespace

void ElementChunks::build(const Model& model) {
  chunks = cutElements(model);
  lanes.clear();
  laws.clear();
  nodes.clear();
  mostNodes = 0;
  const std::vector<std::uint8_t> shared = findShared(model, chunks);
  local_.resize(model.nodes.size());
  for (Chunk& chunk : chunks) {
    appendNodes(model, shared, chunk, nodes);
    chunk.endOfRoom = chunk.lastNode;
    appendLanes(model, chunk, lanes);
    if (chunk.isMixed) appendLaws(model, chunk, laws);
    numberCorners(model, chunk);
    mostNodes = std::max<std::size_t>(mostNodes, chunk.lastNode - chunk.firstNode);
  }
  hoops = hoopsOf(model, chunks);
  placePartials(shared);
}

void ElementChunks::placePartials(const std::vector<std::uint8_t>& shared) {
  std::vector<std::uint32_t>& rowOf = local_;
  sharedNodes.clear();
  for (std::size_t n = 0; n < shared.size(); ++n)
    if (shared[n] != 0) {
      rowOf[n] = static_cast<std::uint32_t>(sharedNodes.size());
      sharedNodes.emplace_back(n);
    }
  std::vector<std::uint32_t> places;  // indices in `nodes`
  for (const Chunk& chunk : chunks)
    for (std::uint32_t i = chunk.firstShared; i < chunk.lastNode; ++i) places.push_back(i);
  Csr<std::uint32_t> rows;
  fillRows(
      rows, sharedNodes.size(), places.size(),
      [&](std::size_t i) { return rowOf[nodes[places[i]].value]; },
      [&](std::size_t i) { return places[i]; });
  partialOf.resize(nodes.size());
  for (std::uint32_t partial = 0; partial < rows.values.size(); ++partial)
    partialOf[rows.values[partial]] = partial;
  firstPartial = std::move(rows.offsets);
}

/// Bodies that share a chunk differ at most by the scatter of their strengths; the lowest strength
/// is used.
bool ElementChunks::watch(const std::vector<double>& leastStrength) {
  bool any = false;
  for (Chunk& chunk : chunks) {
    double least = kNever;
    if (chunk.strength > 0)
      for (std::size_t c = chunk.firstComponent;
           c <= chunk.lastComponent && c < leastStrength.size(); ++c)
        if (leastStrength[c] > 0) least = std::min(least, leastStrength[c]);
    const double limit = tolerance::kStrengthCheck * least;
    chunk.squaredStressLimit = limit * limit;
    any = any || chunk.squaredStressLimit < kNever;
  }
  return any;
}

void ElementChunks::numberCorners(const Model& model, const Chunk& chunk) {
  for (std::uint32_t i = chunk.firstNode; i < chunk.lastNode; ++i)
    local_[nodes[i].value] = i - chunk.firstNode;
  for (std::uint32_t first = chunk.firstElement; first < chunk.lastElement; first += kLanes) {
    ElementLanes& l = lanes[chunk.firstLanes + (first - chunk.firstElement) / kLanes];
    for (std::uint32_t k = 0; k < kLanes; ++k) {
      const auto& corners = model.triangles.nodes[std::min(first + k, chunk.lastElement - 1)];
      for (int i = 0; i < 3; ++i)
        l.corner[i][k] = static_cast<std::uint16_t>(local_[corners[i].value]);
    }
  }
}

// After a split of nodes a chunk gets only new ones, which have the highest numbers: only these are
// sorted, and the partial sums of other chunks keep their indices.

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
  // The chunk's own nodes remain own nodes: for each node that split, some of
  // its elements keep the old number.
  for (std::uint32_t i = chunk.firstNode; i < chunk.firstShared; ++i) list.add(nodes[i], kOwn);
  for (const NewPlace& place : added)
    if (place.partial == kOwn) list.add(place.node, kOwn);
  list.shared = list.nodes.size();
  for (std::uint32_t i = chunk.firstShared; i < chunk.lastNode; ++i)
    local_[nodes[i].value] = kUnseen;
  for (std::uint32_t e = chunk.firstElement; e < chunk.lastElement; ++e)
    for (const NodeId node : model.triangles.nodes[e]) local_[node.value] = 0;
  for (std::uint32_t i = chunk.firstShared; i < chunk.lastNode; ++i)
    if (local_[nodes[i].value] != kUnseen)
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
