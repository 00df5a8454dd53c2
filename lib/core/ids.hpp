#pragma once
// Typed 32-bit ids: the compiler refuses an index into one array where that of another is due.

#include <compare>
#include <cstdint>

namespace yadefrag {

template <class Tag>
struct Id {
  std::uint32_t value;

  constexpr Id() : value(0) {}
  constexpr explicit Id(std::size_t index) : value(static_cast<std::uint32_t>(index)) {}
  friend constexpr auto operator<=>(Id, Id) = default;

  static constexpr Id none() { return Id(std::size_t{0xffffffff}); }
};

using NodeId = Id<struct NodeTag>;            ///< a node of a mesh
using ElementId = Id<struct ElementTag>;      ///< a triangle
using ComponentId = Id<struct ComponentTag>;  ///< a finite-element body
using EdgeId = Id<struct EdgeTag>;            ///< an edge between two triangles, which may crack
using SegmentId = Id<struct SegmentTag>;      ///< a segment of a mesh's boundary
using EntryId = Id<struct EntryTag>;  ///< of a contact surface: a sampling point and a piece

/// A slot in the array of boxes given to a search.
using BoxId = Id<struct BoxTag>;

/// Two boxes that overlap; `first < second`.
struct BoxPair {
  BoxId first;
  BoxId second;
  friend constexpr auto operator<=>(const BoxPair&, const BoxPair&) = default;
};

inline constexpr BoxPair orderedPair(BoxId a, BoxId b) {
  return a < b ? BoxPair{a, b} : BoxPair{b, a};
}

}  // namespace yadefrag
