#include "search/code_directory.hpp"
#include "search/sorted_list.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cassert>
#include <utility>

#include "core/tolerances/search.hpp"

namespace yadefrag {

void CodeDirectory::build(std::span<const std::uint64_t> codes) {
  assert(codes.size() < kChild);
  assert(std::ranges::is_sorted(codes));
  codes_ = codes;
  nodes_.clear();
  table_.clear();
  const auto count = static_cast<std::uint32_t>(codes.size());
  // For an empty list every query returns 0, because no code is ≤ first = max.
  nodes_.push_back(
      {count ? codes.front() : ~std::uint64_t{0}, count ? codes.back() : 0, 0, count, 0, 0});
  // Children are appended at the end, so that this loop visits them, too.
  for (std::uint32_t at = 0; at < nodes_.size(); ++at) buildNode(at);
}

void CodeDirectory::buildNode(std::uint32_t at) {
  Node& node = nodes_[at];
  const std::uint32_t count = node.end - node.begin;
  const std::uint64_t width = count ? node.last - node.first : 0;
  const int slotBits = static_cast<int>(std::bit_width(count));
  node.shift = std::max(0, static_cast<int>(std::bit_width(width)) - slotBits);
  node.table = static_cast<std::uint32_t>(table_.size());
  const auto slots = static_cast<std::uint32_t>(width >> node.shift) + 1;
  table_.resize(node.table + slots + 1);
  std::uint32_t filled = 0;
  for (std::uint32_t i = node.begin; i < node.end; ++i) {
    const auto slot = static_cast<std::uint32_t>((codes_[i] - node.first) >> node.shift);
    while (filled <= slot) table_[node.table + filled++] = i;
  }
  while (filled <= slots) table_[node.table + filled++] = node.end;
  splitOverfullSlots(at, slots);
}

void CodeDirectory::splitOverfullSlots(std::uint32_t at, std::uint32_t slots) {
  const std::uint32_t table = nodes_[at].table;
  for (std::uint32_t slot = 0; slot < slots; ++slot) {
    const std::uint32_t begin = table_[table + slot];
    const std::uint32_t end = table_[table + slot + 1];
    if (end - begin <= tolerance::kBucketCodes || codes_[begin] == codes_[end - 1]) continue;
    table_[table + slot] = kChild | static_cast<std::uint32_t>(nodes_.size());
    nodes_.push_back({codes_[begin], codes_[end - 1], begin, end, 0, 0});
  }
}

namespace {

constexpr int kDigitBits = 11;  // 2048 counters fit into the first-level cache
constexpr std::size_t kDigits = std::size_t{1} << kDigitBits;

}  // namespace

void sortByCode(std::vector<CodedSlot>& list) {
  if (list.size() < tolerance::kRadixLength) {
    std::sort(list.begin(), list.end());
    return;
  }
  std::uint64_t differing = 0;
  for (const CodedSlot& c : list) differing |= c.code ^ list.front().code;
  std::vector<CodedSlot> other(list.size());
  const int bits = static_cast<int>(std::bit_width(differing));
  for (int shift = 0; shift < bits; shift += kDigitBits) {
    if (((differing >> shift) & (kDigits - 1)) == 0) continue;
    std::array<std::uint32_t, kDigits> place{};
    for (const CodedSlot& c : list) ++place[(c.code >> shift) & (kDigits - 1)];
    std::uint32_t sum = 0;
    for (std::uint32_t& p : place) sum += std::exchange(p, sum);
    for (const CodedSlot& c : list) other[place[(c.code >> shift) & (kDigits - 1)]++] = c;
    list.swap(other);
  }
}

}  // namespace yadefrag
