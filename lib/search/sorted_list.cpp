#include "search/sorted_list.hpp"
#include "core/tolerances/search.hpp"

#include <array>
#include <bit>
#include <utility>

namespace yadefrag {
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
