#pragma once
// Detects corrupted data.

#include <cstddef>
#include <cstdint>
#include <cstring>

namespace yadefrag {

/// A 64-bit checksum that depends on every bit of the data and on their order. Each word is mixed
/// by the finaliser of Steele, Lea and Flood 2014 (OOPSLA, "Fast splittable pseudorandom number
/// generators"). The finaliser is one-to-one, so that a single changed word is always detected.
class Checksum {
 public:
  void add(std::uint64_t word) {
    std::uint64_t z = (sum_ ^ word) + 0x9e3779b97f4a7c15;
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9;
    z = (z ^ (z >> 27)) * 0x94d049bb133111eb;
    sum_ = z ^ (z >> 31);
  }
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
