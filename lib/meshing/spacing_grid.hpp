#pragma once
// Search by position for items of very different size: hash tables of square boxes on levels of
// size.

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include "core/vec2.hpp"

namespace yadefrag {

/// One hash table for the boxes of all levels; each item is in one box of its level.
class LevelledHash {
 public:
  explicit LevelledHash(double largest) : largest_(largest) { heads_.assign(1024, kNone); }

  void insert(Vec2 p, int level, std::uint32_t item) {
    if (entries_.size() >= heads_.size()) grow();
    counts_.resize(std::max(counts_.size(), static_cast<std::size_t>(level) + 1));
    ++counts_[level];
    entries_.push_back({hash(level, box(p.x, level), box(p.y, level)), item, kNone});
    link(static_cast<std::uint32_t>(entries_.size() - 1));
  }

  /// True if `test(item)` is true for one of a level's items within `radius` of p. More distant
  /// items may be tested, too.
  template <class Test>
  [[nodiscard]] bool any(Vec2 p, int level, double radius, Test test) const {
    if (static_cast<std::size_t>(level) >= counts_.size() || counts_[level] == 0) return false;
    const std::int64_t right = box(p.x + radius, level);
    const std::int64_t top = box(p.y + radius, level);
    for (std::int64_t x = box(p.x - radius, level); x <= right; ++x)
      for (std::int64_t y = box(p.y - radius, level); y <= top; ++y) {
        const std::uint64_t h = hash(level, x, y);
        for (std::uint32_t e = heads_[h & (heads_.size() - 1)]; e != kNone; e = entries_[e].next)
          if (entries_[e].hash == h && test(entries_[e].item)) return true;
      }
    return false;
  }

 private:
  static constexpr std::uint32_t kNone = 0xffffffff;
  struct Entry {
    std::uint64_t hash;
    std::uint32_t item;
    std::uint32_t next;
  };

  [[nodiscard]] std::int64_t box(double x, int level) const {
    return static_cast<std::int64_t>(std::floor(std::ldexp(x / largest_, level)));
  }
  static std::uint64_t hash(int level, std::int64_t x, std::int64_t y) {
    std::uint64_t h = static_cast<std::uint64_t>(x) * 0x9e3779b97f4a7c15ULL;
    h ^= static_cast<std::uint64_t>(y) * 0xc2b2ae3d27d4eb4fULL;
    h += static_cast<std::uint64_t>(level) * 0x165667b19e3779f9ULL;
    return h ^ (h >> 29);
  }
  void link(std::uint32_t e) {
    std::uint32_t& head = heads_[entries_[e].hash & (heads_.size() - 1)];
    entries_[e].next = head;
    head = e;
  }
  void grow() {
    heads_.assign(2 * heads_.size(), kNone);
    for (std::uint32_t e = 0; e < entries_.size(); ++e) link(e);
  }

  double largest_;
  std::vector<std::uint32_t> heads_;
  std::vector<Entry> entries_;
  std::vector<std::uint32_t> counts_;  // number of items on each level
};

/// A query searches its own level, which also contains all finer items, and each coarser level,
/// where a few boxes contain all near items.
class SpacingGrid {
 public:
  explicit SpacingGrid(double largest) : largest_(largest), own_(largest), finer_(largest) {}

  /// `size` may be up to 3/2 of the largest size.
  void insert(Vec2 p, double size, std::uint32_t item) {
    const int level = levelOf(size);
    own_.insert(p, level, item);
    for (int l = level; l >= 0; --l) finer_.insert(p, l, item);
  }

  /// True if `test(item)` is true for an item whose centre is within `radius`, or within `radius`
  /// plus `extent` times its size.
  template <class Test>
  [[nodiscard]] bool any(Vec2 p, double size, double radius, double extent, Test test) const {
    int level = levelOf(size);
    const auto reach = [&](int l) { return radius + std::ldexp(1.5 * extent * largest_, -l); };
    if (finer_.any(p, level, reach(level), test)) return true;
    while (--level >= 0)
      if (own_.any(p, level, reach(level), test)) return true;
    return false;
  }

 private:
  [[nodiscard]] int levelOf(double size) const {
    return std::max(0, static_cast<int>(std::lround(std::log2(largest_ / size))));
  }

  double largest_;
  LevelledHash own_;
  LevelledHash finer_;
};

}  // namespace yadefrag
