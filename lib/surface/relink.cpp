#include "surface/contact_surface.hpp"

#include <algorithm>
#include <cassert>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace yadefrag {
namespace {

constexpr std::uint32_t kNoLoop = 0xffffffff;

class Relinking {
 public:
  Relinking(ContactSurfaces& surfaces, std::span<const SurfaceSide> sides)
      : s_(surfaces), sides_(sides) {}

  std::vector<EntryId> run() {
    takeSegments();
    placeSegments();
    makeCorners();
    // The smoothness of both ends of a segment is known only now.
    for (std::size_t i = 0; i < sides_.size(); ++i)
      sides_[i].segment == SegmentId::none() ? appendFace(i) : divide(ends_[i]);
    for (const Ends& ends : ends_)
      link(lastEntry(ends.segment), s_.segmentEntry[s_.segmentNext[ends.segment.value].value]);
    numberLoops();
    return std::move(straightened_);
  }

 private:
  /// A listed segment, and its former ends.
  struct Ends {
    SegmentId segment;
    bool fromSmooth = false;
    bool toSmooth = false;
  };

  /// Stores the data that are about to change, and detaches the listed segments from their nodes.
  void takeSegments() {
    ends_.reserve(sides_.size());
    std::size_t appended = s_.segments();
    for (const SurfaceSide& side : sides_) {
      if (side.segment == SegmentId::none()) {
        ends_.push_back({SegmentId(appended++)});
        corners_.push_back(side.first);
        corners_.push_back(side.last);
        continue;
      }
      const SegmentId following = s_.segmentNext[side.segment.value];
      ends_.push_back({side.segment, s_.isSmooth(side.segment), s_.isSmooth(following)});
      if (s_.segmentNode[side.segment.value] != side.first) corners_.push_back(side.first);
      if (s_.segmentNode[following.value] != side.last) corners_.push_back(side.last);
    }
    for (const SurfaceSide& side : sides_)
      if (side.segment != SegmentId::none())
        s_.nodeSegment[s_.segmentNode[side.segment.value].value] = SegmentId::none();
    appendSegments(appended);
  }

  void appendSegments(std::size_t count) {
    s_.segmentNext.resize(count, SegmentId::none());
    s_.segmentPrev.resize(count, SegmentId::none());
    s_.segmentEntry.resize(count, EntryId::none());
    resizeRows(s_.segmentColumns(), count);
    std::size_t nodes = s_.nodeSegment.size();
    for (const SurfaceSide& side : sides_)
      nodes = std::max<std::size_t>(nodes, std::max(side.first, side.last).value + std::size_t{1});
    s_.nodeSegment.resize(nodes, SegmentId::none());
  }

  void placeSegments() {
    for (std::size_t i = 0; i < sides_.size(); ++i) {
      const SegmentId segment = ends_[i].segment;
      const NodeId first = sides_[i].first;
      assert(s_.nodeSegment[first.value] == SegmentId::none());  // one side begins at a node
      s_.segmentNode[segment.value] = first;
      s_.nodeSegment[first.value] = segment;
    }
    for (std::size_t i = 0; i < sides_.size(); ++i) {
      const SegmentId segment = ends_[i].segment;
      const SegmentId following = s_.nodeSegment[sides_[i].last.value];
      assert(following != SegmentId::none());
      s_.segmentNext[segment.value] = following;
      s_.segmentPrev[following.value] = segment;
    }
  }

  void makeCorners() {
    if (!s_.anySmooth()) return;
    for (const NodeId node : corners_) s_.segmentSmooth[s_.nodeSegment[node.value].value] = 0;
  }

  EntryId append(SegmentId segment, Piece piece, ComponentId component, std::uint32_t loop) {
    const EntryId entry(s_.entries());
    resizeRows(s_.entryColumns(), entry.value + std::size_t{1});
    s_.entrySegment.back() = segment;
    s_.piece.back() = piece;
    s_.next.back() = s_.prev.back() = entry;
    s_.loop.back() = loop;
    s_.component.back() = component;
    s_.segmentEntry[segment.value] = entry;
    return entry;
  }

  void appendFace(std::size_t side) {
    append(ends_[side].segment, Piece::kSegment, sides_[side].component, kNoLoop);
  }

  /// At a node that is no longer smooth the arc around it becomes a half segment with the same
  /// begin, and the piece from the node to the next halfpoint is missing.
  void divide(const Ends& before) {
    const SegmentId segment = before.segment;
    const bool fromSmooth = s_.isSmooth(segment);
    const bool toSmooth = s_.isSmooth(s_.segmentNext[segment.value]);
    if (before.toSmooth && !toSmooth) {
      straightened_.push_back(lastEntry(segment));
      s_.piece[straightened_.back().value] = Piece::kSecondHalf;
    }
    if (before.fromSmooth && !fromSmooth) {
      const EntryId rest = s_.segmentEntry[segment.value];
      link(append(segment, Piece::kFirstHalf, s_.component[rest.value], s_.loop[rest.value]), rest);
    }
  }

  [[nodiscard]] EntryId lastEntry(SegmentId segment) const {
    const EntryId first = s_.segmentEntry[segment.value];
    return s_.piece[first.value] == Piece::kFirstHalf ? s_.next[first.value] : first;
  }

  void link(EntryId entry, EntryId following) {
    s_.next[entry.value] = following;
    s_.prev[following.value] = entry;
  }

  void numberLoops() {
    // The segment before a row of new faces ends at the begin of a listed side, so it is listed,
    // too.
    for (std::size_t i = 0; i < sides_.size(); ++i) {
      const EntryId last = lastEntry(ends_[i].segment);
      if (s_.loop[last.value] != kNoLoop) numberAfter(last, s_.loop[last.value]);
    }
    for (const Ends& ends : ends_) {
      const EntryId entry = s_.segmentEntry[ends.segment.value];
      if (s_.loop[entry.value] == kNoLoop)
        numberAfter(entry, lowestLoop(s_.component[entry.value]));
    }
  }

  void numberAfter(EntryId entry, std::uint32_t number) {
    for (entry = s_.next[entry.value]; s_.loop[entry.value] == kNoLoop;
         entry = s_.next[entry.value])
      s_.loop[entry.value] = number;
  }

  /// The loop of its first entry: addLoop numbers loops in ascending order.
  [[nodiscard]] std::uint32_t lowestLoop(ComponentId component) const {
    const auto first = std::ranges::find(s_.component, component);
    const std::uint32_t number = s_.loop[static_cast<std::size_t>(first - s_.component.begin())];
    assert(number != kNoLoop);  // a crack is inside a body with an outline
    return number == kNoLoop ? 0 : number;
  }

  ContactSurfaces& s_;
  std::span<const SurfaceSide> sides_;
  std::vector<Ends> ends_;       ///< by side
  std::vector<NodeId> corners_;  ///< with repetitions
  std::vector<EntryId> straightened_;
};

}  // namespace

std::vector<EntryId> relink(ContactSurfaces& surfaces, std::span<const SurfaceSide> sides) {
  return Relinking(surfaces, sides).run();
}

}  // namespace yadefrag
