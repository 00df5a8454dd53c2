#pragma once
// Random numbers with the same bits on every machine; the distributions of <random> do not
// guarantee that.

#include <cstddef>
#include <cstdint>
#include <cstring>

namespace yadefrag {

/// The odd number next to 2⁶⁴ divided by the golden ratio.
inline constexpr std::uint64_t kRandomStride = 0x9e3779b97f4a7c15;

/// The finaliser of SplitMix64 (Steele, Lea and Flood 2014, OOPSLA, "Fast splittable pseudorandom
/// number generators", fig. 14): every bit of the result depends on every bit of x.
constexpr std::uint64_t mixBits(std::uint64_t x) {
  x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9;
  x = (x ^ (x >> 27)) * 0x94d049bb133111eb;
  return x ^ (x >> 31);
}

/// The sequence of SplitMix64.
class RandomSequence {
 public:
  explicit RandomSequence(std::uint64_t seed) : state_(mixBits(seed + kRandomStride)) {}

  /// Uniform in [−1, 1), without rounding.
  double symmetric() { return static_cast<double>(next() >> 11) * 0x1p-52 - 1; }

 private:
  std::uint64_t next() { return mixBits(state_ += kRandomStride); }

  std::uint64_t state_;
};

/// A 64-bit checksum that depends on every bit of the data and on their order. `mixBits` is
/// one-to-one, so that a single changed word is always detected.
class Checksum {
 public:
  void add(std::uint64_t word) { sum_ = mixBits((sum_ ^ word) + kRandomStride); }
  void add(const void* data, std::size_t bytes) {
    add(std::uint64_t{bytes});
    const auto* at = static_cast<const unsigned char*>(data);
    for (std::size_t i = 0; i < bytes; i += sizeof(std::uint64_t)) {
      std::uint64_t word = 0;
      std::memcpy(&word, at + i, bytes - i < sizeof word ? bytes - i : sizeof word);
      add(word);
    }
  }
  [[nodiscard]] std::uint64_t value() const { return sum_; }

 private:
  std::uint64_t sum_ = 0;
};

}  // namespace yadefrag
